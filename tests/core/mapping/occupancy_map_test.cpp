// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/occupancy_map.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/perception/depth_projector.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

using testing::freeColumn;
using testing::occupiedVoxel;
using testing::randomCloud;
using testing::voxelCenter;
using testing::withMisses;

enum class State { kUnknown, kFree, kOccupied };

State stateAt(const octomap::OcTree& tree, double x, double y, double z) {
  const octomap::OcTreeNode* node = tree.search(x, y, z);
  if (node == nullptr) return State::kUnknown;
  return tree.isNodeOccupied(node) ? State::kOccupied : State::kFree;
}

/// Every known voxel by its key, pruned leaves taken apart.
std::map<std::array<int, 3>, State> voxels(const octomap::OcTree& tree) {
  std::map<std::array<int, 3>, State> states;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const octomap::OcTreeKey key = leaf.getIndexKey();
    const int side = 1 << (tree.getTreeDepth() - leaf.getDepth());
    const State state = tree.isNodeOccupied(*leaf) ? State::kOccupied : State::kFree;
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z) states[{key[0] + x, key[1] + y, key[2] + z}] = state;
  }
  return states;
}

/// Columns in which the two differ, in order, by comparing every voxel.
std::vector<Cell> differingColumns(const std::map<std::array<int, 3>, State>& before,
                                   const std::map<std::array<int, 3>, State>& after) {
  std::set<Cell> columns;
  for (const auto& [key, state] : after) {
    const auto old = before.find(key);
    if (old == before.end() || old->second != state)
      columns.insert({key[0] - 32768, key[1] - 32768});
  }
  return {columns.begin(), columns.end()};
}

/// A single ray along +x from the centre of the voxel at the map's origin.
PointCloud rayAlongX(float length_m) {
  PointCloud cloud;
  cloud.origin = voxelCenter(0, 0, 0);
  cloud.points = {{cloud.origin.x + length_m, cloud.origin.y, cloud.origin.z}};
  return cloud;
}

TEST(OccupancyMap, RayClearsUpToEightMetresAndHitsItsEnd) {
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(rayAlongX(7.5F));
  for (int x = 0; x < 150; ++x)
    EXPECT_EQ(stateAt(map.tree(), (x + 0.5) * 0.05, 0.025, 0.025), State::kFree) << x;
  EXPECT_EQ(stateAt(map.tree(), 150.5 * 0.05, 0.025, 0.025), State::kOccupied);
  EXPECT_EQ(voxels(map.tree()).size(), 151U);
}

TEST(OccupancyMap, PointAtNineMetresClearsUpToEightAndHitsNothing) {
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(rayAlongX(9.0F));
  // 8 m along the ray lie in voxel 160, where the ray is cut.
  for (int x = 0; x < 160; ++x)
    EXPECT_EQ(stateAt(map.tree(), (x + 0.5) * 0.05, 0.025, 0.025), State::kFree) << x;
  EXPECT_EQ(voxels(map.tree()).size(), 160U);
}

TEST(OccupancyMap, PointAtElevenMetresIsNoUpdateWhenTheProjectorDropsIt) {
  DepthProjector projector({1, 0.01, 10.0, BeyondMaxDepth::kDrop});
  const DepthImage image{cv::Mat_<float>(2, 2, 11.0F), 1.0};
  OccupancyMap map{OccupancyMapConfig{}};
  const MapChange change =
      map.insert(projector.project(image, {2, 2, 1.0, 1.0, 0.5, 0.5}, Pose::Identity()));
  EXPECT_EQ(map.tree().size(), 0U);
  EXPECT_TRUE(change.columns.empty());
}

TEST(OccupancyMap, PointAtExactlyTheMaximumRangeIsAHit) {
  PointCloud cloud;
  cloud.points = {{8.0F, 0.0F, 0.0F}};
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(cloud);
  EXPECT_EQ(stateAt(map.tree(), 8.025, 0.025, 0.025), State::kOccupied);
}

TEST(OccupancyMap, MissClearsItsLastVoxelToo) {
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(freeColumn({3, -2}, -4, 5));
  for (int z = -4; z < 5; ++z)
    EXPECT_EQ(stateAt(map.tree(), 3.5 * 0.05, -1.5 * 0.05, (z + 0.5) * 0.05), State::kFree) << z;
  EXPECT_EQ(voxels(map.tree()).size(), 9U);
}

TEST(OccupancyMap, MissIsCutAtTheMaximumRange) {
  PointCloud cloud = rayAlongX(9.9F);
  std::swap(cloud.points, cloud.misses);
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(cloud);
  EXPECT_EQ(voxels(map.tree()).size(), 161U);
  EXPECT_EQ(stateAt(map.tree(), 160.5 * 0.05, 0.025, 0.025), State::kFree);
}

TEST(OccupancyMap, HitWinsOverMissesOfTheSameFrame) {
  PointCloud cloud = rayAlongX(2.0F);
  for (int i = 0; i < 20; ++i) cloud.points.push_back(voxelCenter(60, 0, 0));  // pass voxel 40
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(cloud);
  EXPECT_EQ(stateAt(map.tree(), 40.5 * 0.05, 0.025, 0.025), State::kOccupied);
}

TEST(OccupancyMap, ManyRaysThroughAVoxelAreOneMiss) {
  PointCloud cloud = rayAlongX(2.0F);
  cloud.points.insert(cloud.points.end(), 50, cloud.points[0]);
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(cloud);
  EXPECT_FLOAT_EQ(map.tree().search(0.525, 0.025, 0.025)->getLogOdds(),
                  static_cast<float>(std::log(0.4 / 0.6)));
  EXPECT_FLOAT_EQ(map.tree().search(40.5 * 0.05, 0.025, 0.025)->getLogOdds(),
                  static_cast<float>(std::log(0.7 / 0.3)));
}

TEST(OccupancyMap, ChangedColumnsAreExactlyThoseThatDiffer) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    OccupancyMapConfig config;
    config.max_range_m = 1.0;
    OccupancyMap map(config);
    PointCloud cloud;
    auto before = voxels(map.tree());
    for (int frame = 0; frame < 24; ++frame) {
      if (frame % 4 == 0) cloud = withMisses(randomCloud(30, random), 3);
      const MapChange change = map.insert(cloud);
      auto after = voxels(map.tree());
      ASSERT_EQ(change.columns, differingColumns(before, after)) << "frame " << frame;
      before = std::move(after);
    }
  }
}

TEST(OccupancyMap, FrameThatConfirmsTheMapChangesNoColumn) {
  OccupancyMap map{OccupancyMapConfig{}};
  EXPECT_FALSE(map.insert(rayAlongX(2.0F)).columns.empty());
  EXPECT_TRUE(map.insert(rayAlongX(2.0F)).columns.empty());
}

TEST(OccupancyMap, ColumnsAreWorldAlignedCells) {
  OccupancyMap map{OccupancyMapConfig{}};
  const GridFrame frame{0.05};
  for (const Cell cell : {Cell{0, 0}, Cell{-1, -1}, Cell{-8, 7}, Cell{100, -101}}) {
    const PointCloud cloud = occupiedVoxel(cell, 3);
    EXPECT_EQ(frame.cellAt({cloud.origin.x, cloud.origin.y}), cell);
    EXPECT_EQ(map.insert(cloud).columns, std::vector<Cell>{cell});
  }
}

TEST(OccupancyMap, PointsThatAreNoneAreIgnoredAndCounted) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  PointCloud cloud = rayAlongX(2.0F);
  cloud.points.push_back({nan, 0.0F, 0.0F});
  cloud.points.push_back({0.0F, -inf, 0.0F});
  cloud.points.push_back({0.0F, 0.0F, 1e30F});
  cloud.misses.push_back({inf, inf, nan});
  OccupancyMap map{OccupancyMapConfig{}};
  const MapChange change = map.insert(cloud);
  EXPECT_EQ(change.points_outside_map, 4U);
  EXPECT_FALSE(change.origin_outside_map);
  OccupancyMap clean{OccupancyMapConfig{}};
  clean.insert(rayAlongX(2.0F));
  EXPECT_TRUE(map.tree() == clean.tree());
}

TEST(OccupancyMap, RayThatLeavesTheKeysIsIgnoredAndCounted) {
  OccupancyMap map{OccupancyMapConfig{}};
  PointCloud cloud;
  cloud.origin = {1638.0F, 0.0F, 0.0F};  // the keys end at 1638.4 m
  cloud.points = {{1639.0F, 0.0F, 0.0F}, {1900.0F, 0.0F, 0.0F}, {1637.0F, 0.0F, 0.0F}};
  cloud.misses = {{1639.0F, 0.0F, 0.0F}};
  const MapChange change = map.insert(cloud);
  EXPECT_EQ(change.points_outside_map, 3U);
  EXPECT_EQ(stateAt(map.tree(), 1637.0, 0.0, 0.0), State::kOccupied);
}

TEST(OccupancyMap, FrameFromOutsideTheKeysIsIgnored) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  OccupancyMap map{OccupancyMapConfig{}};
  for (const Point3f& origin :
       {Point3f{nan, 0.0F, 0.0F}, Point3f{0.0F, 1639.0F, 0.0F}, Point3f{0.0F, 0.0F, -1e20F}}) {
    PointCloud cloud = rayAlongX(2.0F);
    cloud.origin = origin;
    const MapChange change = map.insert(cloud);
    EXPECT_TRUE(change.origin_outside_map);
    EXPECT_TRUE(change.columns.empty());
  }
  EXPECT_EQ(map.tree().size(), 0U);
}

TEST(OccupancyMap, LowestAndHighestKeysAreUsable) {
  OccupancyMap map{OccupancyMapConfig{}};
  for (const int edge : {-32768, 32767})
    EXPECT_EQ(map.insert(occupiedVoxel({edge, edge}, edge)).columns,
              (std::vector<Cell>{{edge, edge}}));
}

TEST(OccupancyMap, EmptyFrameChangesNothing) {
  OccupancyMap map{OccupancyMapConfig{}};
  EXPECT_TRUE(map.insert(PointCloud{}).columns.empty());
  EXPECT_EQ(map.tree().size(), 0U);
}

TEST(OccupancyMap, LongestAllowedRangeFitsTheRayBuffer) {
  OccupancyMapConfig config;
  config.max_range_m = kMaxRangeVoxels * config.resolution_m;
  OccupancyMap map(config);
  PointCloud cloud;
  cloud.origin = {-700.0F, -700.0F, -700.0F};
  cloud.points = {{150.0F, 160.0F, 170.0F}};
  EXPECT_EQ(map.insert(cloud).points_outside_map, 0U);
  EXPECT_EQ(stateAt(map.tree(), 150.0, 160.0, 170.0), State::kOccupied);
}

TEST(OccupancyMap, ResetForgetsEverything) {
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(rayAlongX(2.0F));
  map.reset();
  EXPECT_EQ(map.tree().size(), 0U);
  EXPECT_FALSE(map.insert(rayAlongX(2.0F)).columns.empty());
}

TEST(OccupancyMap, MayBeMoved) {
  OccupancyMap first{OccupancyMapConfig{}};
  first.insert(rayAlongX(2.0F));
  OccupancyMap second = std::move(first);
  EXPECT_TRUE(second.insert(rayAlongX(2.0F)).columns.empty());
  OccupancyMap third{OccupancyMapConfig{}};
  third = std::move(second);
  EXPECT_TRUE(third.insert(rayAlongX(2.0F)).columns.empty());
}

std::string refusal(const OccupancyMapConfig& config) {
  try {
    const OccupancyMap map(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(OccupancyMap, RefusesAConfigurationOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal({0.0, 8.0, 0.7, 0.4, 0.12, 0.97}),
            "mapping.occupancy.resolution_m: is 0; allowed is [0.001, 10]");
  const std::vector<std::pair<OccupancyMapConfig, std::string>> cases = {
      {{nan, 8.0, 0.7, 0.4, 0.12, 0.97}, "resolution_m"},
      {{10.5, 80.0, 0.7, 0.4, 0.12, 0.97}, "resolution_m"},
      {{0.05, 0.04, 0.7, 0.4, 0.12, 0.97}, "max_range_m"},
      {{0.05, nan, 0.7, 0.4, 0.12, 0.97}, "max_range_m"},
      {{0.05, 1501.0, 0.7, 0.4, 0.12, 0.97}, "max_range_m"},
      {{0.05, 8.0, 0.5, 0.4, 0.12, 0.97}, "hit_probability"},
      {{0.05, 8.0, 1.0, 0.4, 0.12, 0.97}, "hit_probability"},
      {{0.05, 8.0, 0.7, 0.5, 0.12, 0.97}, "miss_probability"},
      {{0.05, 8.0, 0.7, nan, 0.12, 0.97}, "miss_probability"},
      {{0.05, 8.0, 0.7, 0.4, 0.0, 0.97}, "min_probability"},
      {{0.05, 8.0, 0.7, 0.4, 0.6, 0.97}, "min_probability"},
      {{0.05, 8.0, 0.7, 0.4, 0.12, 0.5}, "max_probability"},
      {{0.05, 8.0, 0.7, 0.4, 0.12, 1.1}, "max_probability"},
  };
  for (const auto& [config, field] : cases)
    EXPECT_EQ(refusal(config).rfind("mapping.occupancy." + field + ": is ", 0), 0U)
        << refusal(config);
}

}  // namespace
}  // namespace occusg
