// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mapping/frame_voxels.hpp"

namespace occusg {

/// Which voxels of a map stand at the lower clamp, where one more miss leaves them as they are: a
/// bit a voxel, beside the tree, so that a frame need not visit what it cannot change. A voxel may
/// be at the clamp without being listed, never the other way round.
class SettledVoxels {
 public:
  using Bits = std::array<std::uint64_t, 8>;  ///< As in `VoxelBlock`.

  /// Of the block with this Morton code. Looks into the tree now and then. Different blocks may be
  /// asked for at the same time.
  [[nodiscard]] Bits of(std::uint64_t code, const octomap::OcTree& tree);

  /// Takes note of what is about to be integrated into the tree.
  void update(const std::vector<VoxelBlock>& blocks);

  void clear() { blocks_.clear(); }
  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  struct Block {
    Bits free{};
    unsigned updates = 0;                ///< Since the tree was looked into.
    unsigned patience = kFirstPatience;  ///< Updates after which that is worth while.
  };
  static constexpr unsigned kFirstPatience = 4;
  static constexpr unsigned kLongestPatience = 12;

  std::unordered_map<std::uint64_t, Block> blocks_;
};

}  // namespace occusg
