// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include "occusg/mapping/free_space.hpp"
#include "occusg/mapping/free_space_layer.hpp"

namespace occusg {

/// What space without a voxel counts as.
enum class UnseenSpace { kUnknown, kFree };

/// Whether a tree has a voxel that is known to be free. One made from a point cloud, without rays,
/// has none.
[[nodiscard]] bool hasFreeVoxel(const octomap::OcTree& tree);

/// The 2D layer of a tree that holds occupied voxels only, which leaves `FreeSpaceLayer` nothing to
/// begin with. A column is an obstacle when its occupied voxels leave no gap of `min_free_gap_m`
/// between the lowest and the highest occupied voxel of the whole tree, within the height limits of
/// `config`. The other columns are unknown, or, with `UnseenSpace::kFree`, free where obstacles
/// enclose them: what is connected to the outside stays unknown.
/// @throws Error when the map spans more than kMaxLayerCells.
[[nodiscard]] FreeSpace layerWithoutRays(const octomap::OcTree& tree,
                                         const FreeSpaceLayerConfig& config, UnseenSpace unseen);

}  // namespace occusg
