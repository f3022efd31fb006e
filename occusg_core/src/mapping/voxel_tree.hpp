// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <array>
#include <cstdint>
#include <vector>

#include "mapping/frame_voxels.hpp"
#include "mapping/voxel_columns.hpp"
#include "occusg/geometry/cell.hpp"

namespace occusg {

/// Key of the voxel whose lower corner is the origin of the map frame: cell = key - kZeroKey.
inline constexpr int kZeroKey = 32768;

/// An `octomap::OcTree` that takes a whole frame at once: every node above a marked voxel is
/// visited once, where `updateNode` descends from the root for each voxel. The result is the tree
/// `updateNode` gives, node by node: leaf values go through the same float arithmetic, inner values
/// are the largest of the children, and what can be pruned is pruned.
class VoxelTree final : public octomap::OcTree {
 public:
  using octomap::OcTree::OcTree;

  /// One miss for every free, one hit for every occupied voxel.
  /// @param blocks in Morton order, no voxel marked both ways, no block without a mark.
  /// @return the columns in which a voxel became known, free or occupied; row-major, unique.
  std::vector<Cell> integrate(const std::vector<VoxelBlock>& blocks);

  /// The states of the voxels by column; `integrate` keeps them equal to the tree.
  [[nodiscard]] const VoxelColumns& columns() const { return columns_; }

  /// Needed after the tree changed in any other way than by `integrate` and `clear`.
  /// @throws Error as `VoxelColumns::of`.
  void rebuildColumns();

  void clear() override;

 private:
  using Node = octomap::OcTreeNode;

  enum class Age { kOld, kNew };

  /// A node on the way down, and whether this frame made it.
  struct Place {
    Node* node = nullptr;
    Age age = Age::kOld;
  };

  /// Marks of the voxels below one node, from the lowest bit.
  struct Marks {
    std::uint64_t free = 0;
    std::uint64_t occupied = 0;
  };

  /// Voxels below one node that became free or occupied, from the lowest bit.
  using Change = Marks;

  /// Columns of one block in which something changed.
  struct BlockColumns {
    int x = 0;  ///< Block coordinate, cell / 8.
    int y = 0;
    std::uint64_t columns = 0;  ///< Bit 8 * (cell y % 8) + cell x % 8.
  };

  using BlockIterator = std::vector<VoxelBlock>::const_iterator;

  void updateAbove(const Place& place, unsigned depth, BlockIterator first, BlockIterator last);
  void updateBlock(const Place& place, const VoxelBlock& block);
  Change updateBelow(const Place& place, unsigned voxels, const Marks& marks);
  Change updateVoxels(const Place& place, const Marks& marks);
  Change updateLeaf(const Place& place, std::uint64_t all, float log_odds);

  [[nodiscard]] static Marks allMarks(BlockIterator first, BlockIterator last);
  [[nodiscard]] Place child(const Place& parent, unsigned index);
  [[nodiscard]] bool isLeaf(const Place& place) const;
  [[nodiscard]] bool ignores(const Place& place, const Marks& marks) const;
  void fetch(const Place& place, const VoxelBlock& block) const;
  void fetchVoxels(const Node* word, std::uint64_t marks) const;
  void finish(Node* node);
  void note(const VoxelBlock& block, const BlockChange& change);
  [[nodiscard]] std::vector<Cell> changedColumns();

  VoxelColumns columns_;
  std::vector<BlockColumns> changed_;  ///< Of the frame at hand; reused between frames.
};

}  // namespace occusg
