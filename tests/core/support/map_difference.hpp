// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstddef>

#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/perception/point_cloud.hpp"

namespace occusg::testing {

/// An empty tree with the parameters of a map.
inline octomap::OcTree emptyTreeLike(const OccupancyMapConfig& config) {
  octomap::OcTree tree(config.resolution_m);
  tree.setProbHit(config.hit_probability);
  tree.setProbMiss(config.miss_probability);
  tree.setClampingThresMin(config.min_probability);
  tree.setClampingThresMax(config.max_probability);
  return tree;
}

/// A cloud as OctoMap takes it. Misses become points: they lie beyond the maximum range.
inline octomap::Pointcloud toOctomapCloud(const PointCloud& cloud) {
  octomap::Pointcloud points;
  for (const Point3f& point : cloud.points) points.push_back(point.x, point.y, point.z);
  for (const Point3f& point : cloud.misses) points.push_back(point.x, point.y, point.z);
  return points;
}

/// How a map differs from a reference, voxel by voxel.
struct MapDifference {
  std::size_t known = 0;          ///< Voxels of the reference.
  std::size_t missing = 0;        ///< Known there, unknown here.
  std::size_t extra = 0;          ///< Unknown there, known here.
  std::size_t other_state = 0;    ///< Free in one, occupied in the other.
  std::size_t lost_occupied = 0;  ///< Occupied there, free or unknown here.
  std::size_t occupied_both = 0;
  std::size_t occupied_any = 0;

  [[nodiscard]] double missingShare() const { return share(missing); }
  [[nodiscard]] double extraShare() const { return share(extra); }
  /// Of all voxels known in either.
  [[nodiscard]] double sameShare() const {
    return static_cast<double>(known - missing - other_state) / static_cast<double>(known + extra);
  }
  [[nodiscard]] double occupiedIou() const {
    return static_cast<double>(occupied_both) / static_cast<double>(occupied_any);
  }

 private:
  [[nodiscard]] double share(std::size_t voxels) const {
    return static_cast<double>(voxels) / static_cast<double>(known);
  }
};

/// Calls `visit` with the key of each voxel of the tree's leaves and whether it is occupied.
template <typename Visit>
void forEachVoxel(const octomap::OcTree& tree, Visit&& visit) {
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const octomap::OcTreeKey first = leaf.getIndexKey();
    const int side = 1 << (tree.getTreeDepth() - leaf.getDepth());
    const bool occupied = tree.isNodeOccupied(*leaf);
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z)
          visit(octomap::OcTreeKey(static_cast<octomap::key_type>(first[0] + x),
                                   static_cast<octomap::key_type>(first[1] + y),
                                   static_cast<octomap::key_type>(first[2] + z)),
                occupied);
  }
}

inline MapDifference differenceOf(const octomap::OcTree& map, const octomap::OcTree& reference) {
  MapDifference difference;
  forEachVoxel(reference, [&](const octomap::OcTreeKey& key, bool occupied) {
    const octomap::OcTreeNode* node = map.search(key);
    const bool occupied_here = node != nullptr && map.isNodeOccupied(node);
    ++difference.known;
    difference.missing += node == nullptr ? 1 : 0;
    difference.other_state += node != nullptr && occupied_here != occupied ? 1 : 0;
    difference.lost_occupied += occupied && !occupied_here ? 1 : 0;
    difference.occupied_both += occupied && occupied_here ? 1 : 0;
    difference.occupied_any += occupied || occupied_here ? 1 : 0;
  });
  forEachVoxel(map, [&](const octomap::OcTreeKey& key, bool occupied) {
    if (reference.search(key) != nullptr) return;
    ++difference.extra;
    difference.occupied_any += occupied ? 1 : 0;
  });
  return difference;
}

}  // namespace occusg::testing
