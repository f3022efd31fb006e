// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/layer_without_rays.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace occusg {
namespace {

constexpr double kResolution_m = 0.1;

void wall(octomap::OcTree& tree, double x0, double y0, double x1, double y1, double top_m = 2.4) {
  for (double x = x0 + kResolution_m / 2; x < x1; x += kResolution_m)
    for (double y = y0 + kResolution_m / 2; y < y1; y += kResolution_m)
      for (double z = kResolution_m / 2; z < top_m; z += kResolution_m)
        tree.updateNode(
            octomap::point3d(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)),
            true);
}

/// Walls of 0.1 m around 4 m x 3 m, as pcd2octomap makes them of a point cloud.
octomap::OcTree roomOfAPointCloud() {
  octomap::OcTree tree(kResolution_m);
  wall(tree, 0.0, 0.0, 4.2, 0.1);
  wall(tree, 0.0, 3.1, 4.2, 3.2);
  wall(tree, 0.0, 0.0, 0.1, 3.2);
  wall(tree, 4.1, 0.0, 4.2, 3.2);
  return tree;
}

std::ptrdiff_t cellsOf(const FreeSpace& layer, std::int8_t value) {
  const Grid<std::int8_t> cells = layer.cells.dense();
  return std::count(cells.values().begin(), cells.values().end(), value);
}

TEST(LayerWithoutRays, MapOfAPointCloudHasNoFreeVoxel) {
  octomap::OcTree tree = roomOfAPointCloud();
  EXPECT_FALSE(hasFreeVoxel(tree));
  tree.updateNode(octomap::point3d(1.0F, 1.0F, 1.0F), false);
  EXPECT_TRUE(hasFreeVoxel(tree));
}

TEST(LayerWithoutRays, WallsAreObstaclesAndNothingIsFree) {
  const FreeSpace layer = layerWithoutRays(roomOfAPointCloud(), {}, UnseenSpace::kUnknown);
  EXPECT_EQ(cellsOf(layer, kFullObstacle), 42 * 2 + 30 * 2);
  EXPECT_EQ(cellsOf(layer, kFree), 0);
}

TEST(LayerWithoutRays, UnknownIsFreeInsideTheWallsOnly) {
  octomap::OcTree tree = roomOfAPointCloud();
  wall(tree, 6.0, 0.0, 6.1, 3.2);  // a wall that encloses nothing
  const FreeSpace layer = layerWithoutRays(tree, {}, UnseenSpace::kFree);
  EXPECT_EQ(cellsOf(layer, kFree), 40 * 30);
  EXPECT_EQ(layer.cells.dense().at({50, 15}), kUnknown);
}

TEST(LayerWithoutRays, TableLeavesRoomBelow) {
  octomap::OcTree tree = roomOfAPointCloud();
  for (int x = 10; x < 15; ++x)
    for (int y = 10; y < 15; ++y)
      tree.updateNode(octomap::OcTreeKey(static_cast<octomap::key_type>(32768 + x),
                                         static_cast<octomap::key_type>(32768 + y), 32768 + 7),
                      true);
  const FreeSpace layer = layerWithoutRays(tree, {}, UnseenSpace::kFree);
  EXPECT_EQ(cellsOf(layer, kFree), 40 * 30);
}

}  // namespace
}  // namespace occusg
