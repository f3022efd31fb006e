// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_pockets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace occusg {
namespace {

/// A square of 10 cells with a slot of 2 by 6 cells cut in from the top.
const CornerRing kSlotted{{0, 0}, {10, 0}, {10, 10}, {6, 10}, {6, 4}, {4, 4}, {4, 10}, {0, 10}};

/// A square of 20 cells whose slot from the top widens to a chamber with a step in it.
const CornerRing kChamber{{0, 0},  {20, 0}, {20, 20}, {11, 20}, {11, 15}, {16, 15},
                          {16, 5}, {10, 5}, {10, 9},  {8, 9},   {8, 5},   {4, 5},
                          {4, 15}, {9, 15}, {9, 20},  {0, 20}};

TEST(DudePockets, HullOfARectangleIsItsCorners) {
  EXPECT_EQ(hullPositions({{0, 0}, {4, 0}, {4, 3}, {0, 3}}),
            (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(DudePockets, HullLeavesOutCornersOnStraightEdges) {
  EXPECT_EQ(hullPositions({{0, 0}, {2, 0}, {4, 0}, {4, 3}, {0, 3}}),
            (std::vector<std::size_t>{0, 2, 3, 4}));
}

TEST(DudePockets, SlotIsAPocketBehindOneBridge) {
  const auto tree = pocketTree(kSlotted, 0.5, 32);
  // Level 1: the free space between the slot's sides and the slanted edges of its hull.
  ASSERT_EQ(tree.size(), 3U);
  EXPECT_EQ(tree[1].level, 1);
  EXPECT_EQ(tree[2].level, 1);
  EXPECT_EQ(kSlotted[tree[0].first], (Cell{10, 10}));
  EXPECT_EQ(kSlotted[tree[0].last % kSlotted.size()], (Cell{0, 10}));
  EXPECT_EQ(tree[0].level, 0);
  EXPECT_EQ(tree[0].parent, -1);
}

TEST(DudePockets, DepthIsTheDistanceToTheBridge) {
  const std::vector<double> depths = pocketDepths(kSlotted);
  EXPECT_DOUBLE_EQ(depths[4], 6.0);
  EXPECT_DOUBLE_EQ(depths[5], 6.0);
  EXPECT_DOUBLE_EQ(depths[3], 0.0);
  EXPECT_DOUBLE_EQ(depths[0], 0.0);
}

TEST(DudePockets, ChildrenLieWithinTheirParentOneLevelDown) {
  const auto tree = pocketTree(kChamber, 0.5, 32);
  ASSERT_GT(tree.size(), 1U);
  EXPECT_TRUE(std::any_of(tree.begin(), tree.end(), [](const auto& b) { return b.level == 1; }));
  for (const DudeBridge& bridge : tree) {
    if (bridge.parent < 0) continue;
    const DudeBridge& parent = tree[static_cast<std::size_t>(bridge.parent)];
    EXPECT_EQ(bridge.level, parent.level + 1);
    EXPECT_GE(bridge.first, parent.first);
    EXPECT_LE(bridge.last, parent.last);
  }
}

TEST(DudePockets, TreeStopsAtTheGivenLevelAndDepth) {
  for (const DudeBridge& bridge : pocketTree(kChamber, 0.5, 1)) EXPECT_EQ(bridge.level, 0);
  EXPECT_TRUE(pocketTree(kSlotted, 6.5, 32).empty());
}

TEST(DudePockets, SegmentDistanceIsToTheNearestPointOfTheSegment) {
  EXPECT_DOUBLE_EQ(segmentDistance({0, 0}, {4, 0}, {2, 3}), 3.0);
  EXPECT_DOUBLE_EQ(segmentDistance({0, 0}, {4, 0}, {7, 4}), 5.0);
  EXPECT_DOUBLE_EQ(segmentDistance({0, 0}, {4, 0}, {-3, -4}), 5.0);
  EXPECT_DOUBLE_EQ(segmentDistance({1, 1}, {1, 1}, {4, 5}), 5.0);
}

}  // namespace
}  // namespace occusg
