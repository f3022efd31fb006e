// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxel_columns.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "mapping/voxel_tree.hpp"
#include "occusg/error.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

using testing::freeColumn;
using testing::occupiedVoxel;
using testing::randomCloud;
using testing::scanOfBox;
using testing::withMisses;

ColumnBits columnOf(const OccupancyMap& map, const Cell& cell) {
  ColumnBits bits;
  map.columns().read(cell, bits);
  return bits;
}

/// Asks the tree for every voxel of a cube around the map's origin.
void expectColumnsOfTree(const OccupancyMap& map, int reach) {
  for (int y = -reach; y < reach; ++y) {
    for (int x = -reach; x < reach; ++x) {
      const ColumnBits bits = columnOf(map, {x, y});
      for (int z = -reach; z < reach; ++z) {
        const auto key = [](int cell) { return static_cast<octomap::key_type>(cell + kZeroKey); };
        const octomap::OcTreeNode* node =
            map.tree().search(octomap::OcTreeKey(key(x), key(y), key(z)));
        const bool occupied = node != nullptr && map.tree().isNodeOccupied(node);
        const bool free = node != nullptr && !occupied;
        ASSERT_EQ(bits.freeIn({z, z + 1}), free ? 1 : 0) << x << ", " << y << ", " << z;
        ASSERT_EQ(bits.occupiedIn({z, z + 1}), occupied ? 1 : 0) << x << ", " << y << ", " << z;
      }
    }
  }
}

TEST(VoxelColumns, HoldTheStateOfEveryVoxelOfTheTree) {
  std::mt19937 random(3);
  OccupancyMap map{OccupancyMapConfig{}};
  for (int frame = 0; frame < 6; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    map.insert(withMisses(randomCloud(60, random), 4));
    expectColumnsOfTree(map, 30);
  }
}

TEST(VoxelColumns, EqualThoseRebuiltFromTheTreeAfterEveryFrame) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    OccupancyMapConfig config;
    config.resolution_m = 0.1;
    OccupancyMap map(config);
    for (int frame = 0; frame < 16; ++frame) {
      // The walls move, so voxels change their state and prune into leaves of many sizes.
      const float wall = 1.6F + 0.1F * static_cast<float>(frame % 5);
      map.insert(
          scanOfBox({0.0F, 0.0F, 0.5F}, {{-1.6F, -1.6F, -1.2F}, {wall, 1.6F, 1.6F}}, 4000, random));
      ASSERT_TRUE(map.columns() == VoxelColumns::of(map.tree())) << frame;
    }
    expectColumnsOfTree(map, 24);
  }
}

TEST(VoxelColumns, ReachOverAnyHeightAndBelowZero) {
  OccupancyMapConfig config;
  config.max_range_m = 100.0;
  OccupancyMap map(config);
  map.insert(freeColumn({-3, 5}, -150, 130));
  for (const int z : {-32768, -151, 130, 5000, 32767}) map.insert(occupiedVoxel({-3, 5}, z));
  const ColumnBits bits = columnOf(map, {-3, 5});
  EXPECT_EQ(bits.nextFree(kAllHeights.bottom), (VoxelRun{-150, 130}));
  EXPECT_EQ(bits.nextFree(0), (VoxelRun{0, 130}));
  EXPECT_EQ(bits.nextFree(130), VoxelRun{});
  EXPECT_EQ(bits.freeIn(kAllHeights), 280);
  EXPECT_EQ(bits.occupiedIn(kAllHeights), 5);
  EXPECT_EQ(bits.occupiedIn({130, 5000}), 1);
  EXPECT_TRUE(columnOf(map, {-3, 6}).empty());
  EXPECT_TRUE(map.columns() == VoxelColumns::of(map.tree()));
}

TEST(VoxelColumns, KnownColumnsAreThoseWithAKnownVoxel) {
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(freeColumn({-3, 5}, 0, 3));
  map.insert(occupiedVoxel({-3, 5}, 70));
  map.insert(occupiedVoxel({1000, -1}, 0));
  std::vector<Cell> columns = map.columns().knownColumns();
  std::sort(columns.begin(), columns.end());
  EXPECT_EQ(columns, (std::vector<Cell>{{1000, -1}, {-3, 5}}));
}

TEST(VoxelColumns, AreEmptyAfterTheMapForgotEverything) {
  OccupancyMap map{OccupancyMapConfig{}};
  map.insert(freeColumn({2, 3}, 0, 20));
  map.reset();
  EXPECT_TRUE(columnOf(map, {2, 3}).empty());
  EXPECT_TRUE(map.columns() == VoxelColumns{});
  map.insert(occupiedVoxel({2, 3}, 4));
  EXPECT_EQ(columnOf(map, {2, 3}).occupiedIn(kAllHeights), 1);
  EXPECT_EQ(columnOf(map, {2, 3}).freeIn(kAllHeights), 0);
}

TEST(VoxelColumns, FollowATreeThatWasFilledByOtherMeans) {
  VoxelTree tree(0.05);
  tree.updateNode(octomap::OcTreeKey(kZeroKey, kZeroKey, kZeroKey + 9), true);
  tree.rebuildColumns();
  ColumnBits bits;
  tree.columns().read({0, 0}, bits);
  EXPECT_EQ(bits.occupiedIn({9, 10}), 1);
}

/// A tree of one leaf of 2^15 voxels' edge.
class HugeLeaf : public octomap::OcTree {
 public:
  HugeLeaf() : octomap::OcTree(0.05) {
    root = new octomap::OcTreeNode();  // owned by the base class
    ++tree_size;
    createNodeChild(root, 0);
  }
};

TEST(VoxelColumns, RefuseATreeWhoseLeavesFillMoreBlocksThanSupported) {
  EXPECT_THROW((void)VoxelColumns::of(HugeLeaf()), Error);
}

TEST(ColumnBits, RunsGoOnOverTheBordersOfWords) {
  ColumnBits bits;
  for (int i = 0; i < 20; ++i) bits.addByte(8 * i - 16, 0xFF, 0);
  EXPECT_EQ(bits.nextFree(-100), (VoxelRun{-16, 144}));
  EXPECT_EQ(bits.nextFree(47), (VoxelRun{47, 144}));
  EXPECT_EQ(bits.nextFree(48), (VoxelRun{48, 144}));
  EXPECT_EQ(bits.nextFree(143), (VoxelRun{143, 144}));
  EXPECT_TRUE(bits.nextFree(144).empty());
}

TEST(ColumnBits, UnknownOrOccupiedVoxelEndsARun) {
  ColumnBits bits;
  bits.addByte(0, 0b11001110, 0b00000001);
  bits.addByte(8, 0b00000001, 0b00000010);
  bits.addByte(200, 0b10000000, 0);
  EXPECT_EQ(bits.nextFree(0), (VoxelRun{1, 4}));
  EXPECT_EQ(bits.nextFree(4), (VoxelRun{6, 9}));
  EXPECT_EQ(bits.nextFree(9), (VoxelRun{207, 208}));
  EXPECT_EQ(bits.lowestFree(kAllHeights, 3), (VoxelRun{1, 4}));
  EXPECT_EQ(bits.lowestFree({2, 300}, 3), (VoxelRun{6, 9}));
  EXPECT_EQ(bits.lowestFree({2, 8}, 2), (VoxelRun{2, 4}));
  EXPECT_TRUE(bits.lowestFree(kAllHeights, 4).empty());
  EXPECT_EQ(bits.longestFree({0, 4}, {0, 300}), (VoxelRun{1, 4}));
  EXPECT_EQ(bits.longestFree({2, 300}, {2, 300}), (VoxelRun{6, 9}));
}

TEST(ColumnBits, RunEndsWhereWordsDoNotTouch) {
  ColumnBits bits;
  for (int i = 0; i < 8; ++i) bits.addByte(8 * i, 0xFF, 0);
  for (int i = 0; i < 8; ++i) bits.addByte(72 + 8 * i, 0xFF, 0);
  EXPECT_EQ(bits.nextFree(0), (VoxelRun{0, 64}));
  EXPECT_EQ(bits.nextFree(64), (VoxelRun{72, 136}));
}

TEST(ColumnBits, CountsBetweenHeights) {
  ColumnBits bits;
  for (int i = 0; i < 10; ++i) bits.addByte(8 * i, 0x0F, 0xF0);
  EXPECT_EQ(bits.freeIn(kAllHeights), 40);
  EXPECT_EQ(bits.occupiedIn({0, 64}), 32);
  EXPECT_EQ(bits.occupiedIn({60, 69}), 5);
  EXPECT_EQ(bits.freeIn({60, 69}), 4);
  EXPECT_EQ(bits.freeIn({30, 30}), 0);
  EXPECT_EQ(bits.freeIn({80, 200}), 0);
}

}  // namespace
}  // namespace occusg
