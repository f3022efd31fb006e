// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace occusg {

/// Indices, rising, of the largest set of points in which each is at most `eps_m` from another; of
/// equally large ones the one with the smallest index.
///
/// Points are thinned to one per voxel of side eps / 2.5 first. That never joins sets more than
/// `eps_m` apart. Points in voxels that share a face stay together, so surfaces seen densely do;
/// where voxels hold one point each nothing changes; sets that come near each other in few places
/// may be parted.
/// @pre the points are finite, and at most 2^31 voxels from the origin.
[[nodiscard]] std::vector<std::size_t> largestCluster(const std::vector<Eigen::Vector3d>& points,
                                                      double eps_m);

}  // namespace occusg
