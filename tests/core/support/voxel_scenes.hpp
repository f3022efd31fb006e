// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "occusg/mapping/occupancy_map.hpp"

namespace occusg::testing {

/// Centre of the voxel with the given world-aligned indices.
inline Point3f voxelCenter(int x, int y, int z, double resolution_m = 0.05) {
  return {static_cast<float>((x + 0.5) * resolution_m),
          static_cast<float>((y + 0.5) * resolution_m),
          static_cast<float>((z + 0.5) * resolution_m)};
}

/// One frame that sees the voxels [bottom, top) above `cell` free, by a ray along the column.
inline PointCloud freeColumn(const Cell& cell, int bottom, int top, double resolution_m = 0.05) {
  PointCloud cloud;
  cloud.origin = voxelCenter(cell.x, cell.y, bottom, resolution_m);
  cloud.misses = {voxelCenter(cell.x, cell.y, top - 1, resolution_m)};
  return cloud;
}

/// One frame that sees one voxel occupied and nothing else: the sensor is in it.
inline PointCloud occupiedVoxel(const Cell& cell, int z, double resolution_m = 0.05) {
  PointCloud cloud;
  cloud.origin = voxelCenter(cell.x, cell.y, z, resolution_m);
  cloud.points = {cloud.origin};
  return cloud;
}

/// Inserts a vertical slice along x, the top line being the highest: '.' free, '#' occupied,
/// ' ' unknown. The lower left character is voxel (0, y, bottom).
inline void insertSlice(OccupancyMap& map, const std::vector<std::string>& rows, int y = 0,
                        int bottom = 0) {
  const double resolution_m = map.config().resolution_m;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int z = bottom + static_cast<int>(rows.size() - 1 - i);
    for (std::size_t x = 0; x < rows[i].size(); ++x) {
      const Cell cell{static_cast<int>(x), y};
      if (rows[i][x] == '.') map.insert(freeColumn(cell, z, z + 1, resolution_m));
      if (rows[i][x] == '#') map.insert(occupiedVoxel(cell, z, resolution_m));
    }
  }
}

struct Box3 {
  Point3f min;
  Point3f max;
};

/// What a sensor at `origin`, inside `box`, sees of the box's walls along random rays.
inline PointCloud scanOfBox(const Point3f& origin, const Box3& box, std::size_t rays,
                            std::mt19937& random) {
  std::normal_distribution<float> any(0.0F, 1.0F);
  const auto reach = [](float from, float direction, float low, float high) {
    if (direction == 0.0F) return std::numeric_limits<float>::max();
    return ((direction > 0.0F ? high : low) - from) / direction;
  };
  PointCloud cloud;
  cloud.origin = origin;
  for (std::size_t i = 0; i < rays; ++i) {
    const Point3f d{any(random), any(random), any(random)};
    const float t = std::min({reach(origin.x, d.x, box.min.x, box.max.x),
                              reach(origin.y, d.y, box.min.y, box.max.y),
                              reach(origin.z, d.z, box.min.z, box.max.z)});
    cloud.points.push_back({origin.x + t * d.x, origin.y + t * d.y, origin.z + t * d.z});
  }
  return cloud;
}

/// Random rays from a random place near the map's origin, a third of them longer than 1 m.
inline PointCloud randomCloud(std::size_t rays, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-0.5F, 0.5F);
  std::uniform_real_distribution<float> offset(-0.9F, 0.9F);
  PointCloud cloud;
  cloud.origin = {place(random), place(random), place(random)};
  for (std::size_t i = 0; i < rays; ++i)
    cloud.points.push_back({cloud.origin.x + offset(random), cloud.origin.y + offset(random),
                            cloud.origin.z + offset(random)});
  return cloud;
}

/// The cloud with every n-th point turned into a miss.
inline PointCloud withMisses(PointCloud cloud, std::size_t every) {
  std::vector<Point3f> points;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    (i % every == 0 ? cloud.misses : points).push_back(cloud.points[i]);
  cloud.points = points;
  return cloud;
}

}  // namespace occusg::testing
