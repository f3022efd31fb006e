// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <algorithm>
#include <utility>

#include "mapping/voxel_tree.hpp"
#include "occusg/geometry/cell.hpp"
#include "occusg/mapping/voxel_run.hpp"

namespace occusg {

/// Reads one column of voxels from an octree, from the lowest up, in one descent: only nodes that
/// hold the column are visited, and a pruned leaf is one run.
class Column {
 public:
  Column(const octomap::OcTree& tree, const Cell& cell, const VoxelRun& heights)
      : tree_(tree),
        x_(static_cast<unsigned>(cell.x + kZeroKey)),
        y_(static_cast<unsigned>(cell.y + kZeroKey)),
        heights_(heights) {}

  /// Calls visit(is_occupied, run) for every leaf between the heights, cut at them.
  template <typename Visit>
  void forEachLeaf(Visit&& visit) const {
    if (tree_.getRoot() != nullptr)
      descend(tree_.getRoot(), static_cast<int>(tree_.getTreeDepth()), -kZeroKey, visit);
  }

 private:
  /// `node` covers the heights [bottom, bottom + 2^level).
  template <typename Visit>
  void descend(const octomap::OcTreeNode* node, int level, int bottom, Visit& visit) const {
    const VoxelRun run{std::max(bottom, heights_.bottom),
                       std::min(bottom + (1 << level), heights_.top)};
    if (run.empty()) return;
    if (level == 0 || !tree_.nodeHasChildren(node)) {
      visit(tree_.isNodeOccupied(node), run);
      return;
    }
    const int below = level - 1;
    const unsigned lower = ((x_ >> below) & 1U) | ((y_ >> below) & 1U) << 1;
    const unsigned upper = lower | 4U;
    if (tree_.nodeChildExists(node, lower))
      descend(tree_.getNodeChild(node, lower), below, bottom, visit);
    if (tree_.nodeChildExists(node, upper))
      descend(tree_.getNodeChild(node, upper), below, bottom + (1 << below), visit);
  }

  const octomap::OcTree& tree_;
  unsigned x_;
  unsigned y_;
  VoxelRun heights_;
};

}  // namespace occusg
