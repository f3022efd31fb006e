// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/voxel_run.hpp"

namespace occusg {

/// Heights of the voxels a map can hold.
inline constexpr VoxelRun kAllHeights{-32768, 32768};

/// 64 voxels above each other, a bit each, the lowest bit the lowest voxel.
struct ColumnWord {
  int bottom = 0;  ///< Height of the lowest voxel.
  std::uint64_t free = 0;
  std::uint64_t occupied = 0;
  friend bool operator==(const ColumnWord& a, const ColumnWord& b) {
    return a.bottom == b.bottom && a.free == b.free && a.occupied == b.occupied;
  }
};

/// One column of voxels. What lies in no word is unknown.
class ColumnBits {
 public:
  void clear() { words_.clear(); }
  /// Adds eight voxels from `bottom` up, above all there are.
  void addByte(int bottom, std::uint8_t free, std::uint8_t occupied);

  [[nodiscard]] bool empty() const { return words_.empty(); }
  /// Makes every voxel beyond `heights` unknown.
  void keep(const VoxelRun& heights);

  /// The lowest free voxel at or above `from` and the free ones on top of it; empty when there is
  /// none.
  [[nodiscard]] VoxelRun nextFree(int from) const;
  /// The lowest run of at least `needed` free voxels between the heights; empty when there is none.
  [[nodiscard]] VoxelRun lowestFree(const VoxelRun& heights, int needed) const;
  /// The longest run of free voxels between the heights `within` that begins between those of
  /// `beginning`, the lowest of equals; empty when there is none.
  [[nodiscard]] VoxelRun longestFree(const VoxelRun& beginning, const VoxelRun& within) const;

  [[nodiscard]] int freeIn(const VoxelRun& heights) const;
  [[nodiscard]] int occupiedIn(const VoxelRun& heights) const;

  friend bool operator==(const ColumnBits& a, const ColumnBits& b) { return a.words_ == b.words_; }

 private:
  std::vector<ColumnWord> words_;  ///< From the lowest up.
};

}  // namespace occusg
