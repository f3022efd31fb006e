// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace occusg {

/// Levels below the root of the octree, at which the voxels are.
inline constexpr unsigned kTreeDepth = 16;
/// Levels of the octree a block spans: 8 x 8 x 8 voxels.
inline constexpr unsigned kBlockLevels = 3;
inline constexpr int kBlockSide = 1 << kBlockLevels;
/// Levels below the root at which the nodes of blocks are.
inline constexpr unsigned kBlockDepth = kTreeDepth - kBlockLevels;

/// The marks of one frame in a block of voxels that is a node of the octree. The bits are in the
/// tree's own order: a word is a grandchild of the block's node, a byte of it a node of 2 x 2 x 2
/// voxels, a bit a voxel; child index x + 2 y + 4 z at every level.
struct VoxelBlock {
  std::uint64_t code = 0;  ///< Morton code of the block: its path from the root, 3 bits a level.
  std::array<std::uint64_t, 8> free{};
  std::array<std::uint64_t, 8> occupied{};
};

/// The voxels one frame saw free or occupied, a bit each. Memory follows the space the rays pass,
/// and is reused from frame to frame.
class FrameVoxels {
 public:
  FrameVoxels();

  void clear();
  void markFree(const octomap::OcTreeKey& key);
  void markOccupied(const octomap::OcTreeKey& key);

  /// Ends the frame: a voxel marked both ways is occupied. Only `clear` may follow.
  /// @return the touched blocks in Morton order; valid until `clear`.
  const std::vector<VoxelBlock>& settled();

 private:
  VoxelBlock& blockOf(const octomap::OcTreeKey& key);
  std::size_t find(std::uint64_t code);
  void grow();

  std::vector<VoxelBlock> blocks_;
  std::vector<std::uint32_t> slots_;  ///< Open-addressing table of block number + 1; 0 is empty.
  std::uint64_t last_address_;        ///< Block of the previous mark: most marks stay in it.
  std::size_t last_block_ = 0;
};

}  // namespace occusg
