// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace occusg {

/// Voxels of a block that stand at a clamp; bits as in `VoxelBlock`.
struct SettledBlock {
  std::array<std::uint64_t, 8> free{};      ///< One more miss leaves them as they are.
  std::array<std::uint64_t, 8> occupied{};  ///< So does one more hit.
};

/// Which voxels of a map stand at a clamp, two bits a voxel beside the tree, so that a frame need
/// not visit what it cannot change. A voxel may be at a clamp without being listed, never the other
/// way round.
class SettledVoxels {
 public:
  /// Of the block with this Morton code; all clear where nothing is known.
  [[nodiscard]] const SettledBlock& of(std::uint64_t code) const;

  /// The same to write to, made where there is none; it stays where it is until `clear`.
  [[nodiscard]] SettledBlock& at(std::uint64_t code) { return blocks_[code]; }

  void clear() { blocks_.clear(); }
  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  std::unordered_map<std::uint64_t, SettledBlock> blocks_;
};

}  // namespace occusg
