// SPDX-License-Identifier: BSD-3-Clause
// The map against OctoMap's own insertion, node by node.
#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "map_difference.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

using testing::emptyTreeLike;
using testing::freeColumn;
using testing::occupiedVoxel;
using testing::randomCloud;
using testing::scanOfBox;
using testing::voxelCenter;

void insertAsOctomapDoes(octomap::OcTree& tree, const PointCloud& cloud, double max_range_m) {
  const octomap::point3d origin(cloud.origin.x, cloud.origin.y, cloud.origin.z);
  tree.insertPointCloud(testing::toOctomapCloud(cloud), origin, max_range_m, false, false);
}

TEST(OccupancyMap, EqualsOctomapNodeByNodeOnRandomFrames) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    OccupancyMapConfig config;
    config.max_range_m = 1.0;
    OccupancyMap map(config);
    octomap::OcTree reference = emptyTreeLike(config);
    PointCloud cloud = randomCloud(40, random);
    for (int frame = 0; frame < 40; ++frame) {
      // The same view several times drives voxels into the clamps, where octomap prunes.
      if (frame % 5 == 0) cloud = randomCloud(40, random);
      map.insert(cloud);
      insertAsOctomapDoes(reference, cloud, config.max_range_m);
      ASSERT_TRUE(map.tree() == reference) << "frame " << frame;
    }
    EXPECT_GT(map.tree().size(), 1000U);
  }
}

TEST(OccupancyMap, EqualsOctomapNodeByNodeInARoomThatGetsPruned) {
  std::mt19937 random(7);
  OccupancyMapConfig config;
  config.resolution_m = 0.1;
  config.max_range_m = 3.0;
  OccupancyMap map(config);
  octomap::OcTree reference = emptyTreeLike(config);
  for (int frame = 0; frame < 30; ++frame) {
    // Half-way the room becomes smaller: what was saturated free gets hit.
    const testing::Box3 room = {{-2.1F, -1.3F, 0.0F}, {2.0F, frame < 15 ? 1.7F : 0.9F, 2.4F}};
    const float x = -1.0F + 0.05F * static_cast<float>(frame);
    const PointCloud cloud = scanOfBox({x, 0.1F, 1.2F}, room, 4000, random);
    map.insert(cloud);
    insertAsOctomapDoes(reference, cloud, config.max_range_m);
    ASSERT_TRUE(map.tree() == reference) << "frame " << frame;
  }
  std::size_t pruned = 0;
  for (auto leaf = map.tree().begin_leafs(); leaf != map.tree().end_leafs(); ++leaf)
    if (leaf.getDepth() < 14) ++pruned;
  EXPECT_GT(pruned, 0U) << "the scene is meant to have leaves larger than a block";
}

/// The centres of 16 x 16 x 16 voxels, which make one leaf when they are equal: it is larger than
/// the blocks in which a frame is collected.
std::vector<Point3f> cubeOfVoxels() {
  std::vector<Point3f> voxels;
  for (int x = 0; x < 16; ++x)
    for (int y = 0; y < 16; ++y)
      for (int z = 0; z < 16; ++z) voxels.push_back(voxelCenter(x, y, z));
  return voxels;
}

void updateEach(octomap::OcTree& tree, const std::vector<Point3f>& voxels, bool occupied) {
  for (const Point3f& voxel : voxels)
    tree.updateNode(octomap::point3d(voxel.x, voxel.y, voxel.z), occupied, false);
}

TEST(OccupancyMap, EqualsOctomapWhereAWholeCubeIsOneFreeLeaf) {
  const OccupancyMapConfig config;
  OccupancyMap map(config);
  octomap::OcTree reference = emptyTreeLike(config);
  PointCloud cube;
  cube.origin = voxelCenter(0, 0, 0);
  cube.misses = cubeOfVoxels();
  for (int frame = 0; frame < 7; ++frame) {
    EXPECT_EQ(map.insert(cube).columns.size(), frame == 0 ? 256U : 0U);
    updateEach(reference, cube.misses, false);
  }
  ASSERT_EQ(map.tree().getNumLeafNodes(), 1U) << "the cube is meant to be one saturated leaf";
  EXPECT_TRUE(map.tree() == reference);

  for (int frame = 0; frame < 8; ++frame) {
    map.insert(occupiedVoxel({5, 6}, 7));
    updateEach(reference, {voxelCenter(5, 6, 7)}, true);
    ASSERT_TRUE(map.tree() == reference) << "hit " << frame;
  }
}

TEST(OccupancyMap, EqualsOctomapWhereAWholeCubeIsOneOccupiedLeaf) {
  const OccupancyMapConfig config;
  OccupancyMap map(config);
  octomap::OcTree reference = emptyTreeLike(config);
  PointCloud cube;
  cube.origin = voxelCenter(0, 0, 0);
  cube.points = cubeOfVoxels();
  for (int frame = 0; frame < 7; ++frame) {
    EXPECT_EQ(map.insert(cube).columns.size(), frame == 0 ? 256U : 0U);
    updateEach(reference, cube.points, true);
  }
  ASSERT_EQ(map.tree().getNumLeafNodes(), 1U) << "the cube is meant to be one saturated leaf";

  for (int frame = 0; frame < 16; ++frame) {
    map.insert(freeColumn({5, 6}, 7, 8));
    updateEach(reference, {voxelCenter(5, 6, 7)}, false);
    ASSERT_TRUE(map.tree() == reference) << "miss " << frame;
  }
}

TEST(OccupancyMap, EqualsOctomapWithOtherProbabilities) {
  std::mt19937 random(3);
  const OccupancyMapConfig config = {0.2, 1.5, 0.9, 0.3, 0.4, 0.8};
  OccupancyMap map(config);
  octomap::OcTree reference = emptyTreeLike(config);
  for (int frame = 0; frame < 20; ++frame) {
    const PointCloud cloud = randomCloud(100, random);
    map.insert(cloud);
    insertAsOctomapDoes(reference, cloud, config.max_range_m);
    ASSERT_TRUE(map.tree() == reference) << "frame " << frame;
  }
}

}  // namespace
}  // namespace occusg
