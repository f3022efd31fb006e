// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/frame_voxels.hpp"
#include "mapping/settled_voxels.hpp"
#include "mapping/tree_writer.hpp"
#include "mapping/voxel_columns.hpp"
#include "mapping/workers.hpp"
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
  /// @param settled of this tree; kept up to date.
  /// @param workers share disjoint parts of the tree.
  /// @return the columns in which a voxel became known, free or occupied; row-major, unique.
  std::vector<Cell> integrate(const std::vector<VoxelBlock>& blocks, SettledVoxels& settled,
                              Workers& workers);

  /// The states of the voxels by column; `integrate` keeps them equal to the tree.
  [[nodiscard]] const VoxelColumns& columns() const { return columns_; }

  /// Needed after the tree changed in any other way than by `integrate` and `clear`.
  /// @throws Error as `VoxelColumns::of`.
  void rebuildColumns();

  void clear() override;

 private:
  /// Columns of one block in which something changed.
  struct BlockColumns {
    int x = 0;  ///< Block coordinate, cell / 8.
    int y = 0;
    std::uint64_t columns = 0;  ///< Bit 8 * (cell y % 8) + cell x % 8.
  };

  void openFrame(const std::vector<VoxelBlock>& blocks, SettledVoxels& settled, int threads);
  [[nodiscard]] TreeWriter::Place top();
  void write(Workers& workers);
  void note(const TreeWriter::Update& update);
  [[nodiscard]] std::vector<Cell> changedColumns();

  VoxelColumns columns_;
  std::vector<std::unique_ptr<TreeWriter>> writers_;  ///< One a thread.
  std::vector<TreeWriter::Update>
      updates_;  ///< Of the frame at hand; reused between frames, as the rest.
  std::vector<BlockColumns> changed_;
};

}  // namespace occusg
