// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace octomap {
class OcTree;
}

namespace occusg {

/// True when the map knows the inside of `box` and it is free: whatever was there is not there any
/// more. The outer voxel layer below and around does not count, for floor and walls reach into it;
/// that above does, as a table is all top, and if the top ends just above the surface, the voxel
/// that holds it. A box too thin to have an inside is never seen through; of
/// a large box a lattice of at most 4000 points is looked at.
[[nodiscard]] bool isSeenThrough(const octomap::OcTree& map, const Eigen::AlignedBox3d& box);

}  // namespace occusg
