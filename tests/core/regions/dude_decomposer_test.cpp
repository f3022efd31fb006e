// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/dude_decomposer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "drawn_grid.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

using testing::fill;
using testing::solid;

/// Three rooms of 4 x 6 m side by side; doors of 0.9 m in walls of 0.2 m.
FreeSpace threeRooms() {
  FreeSpace layer = solid(13.0, 7.0);
  for (const double x : {0.4, 4.6, 8.8}) fill(layer, x, 0.4, x + 4.0, 6.4);
  for (const double x : {4.4, 8.6}) fill(layer, x, 3.0, x + 0.2, 3.9);
  return layer;
}

void change(FreeSpace& layer, double x0, double y0, double x1, double y1, std::int8_t value) {
  fill(layer, x0, y0, x1, y1, value);
  const auto cell = [](double metres) { return static_cast<int>(std::lround(metres / 0.05)); };
  layer.changed = {{cell(x0), cell(y0)}, {cell(x1), cell(y1)}};
}

std::int32_t labelAt(const Decomposition& decomposition, double x, double y) {
  return decomposition.labels.valueOr(decomposition.frame.cellAt({x, y}), kNoRegion);
}

bool samePartition(const Decomposition& a, const Decomposition& b) {
  if (!(a.labels.box() == b.labels.box()) || a.regions.size() != b.regions.size()) return false;
  std::vector<std::int32_t> other(a.regions.size() + 1, -1);
  other[0] = 0;
  for (std::size_t i = 0; i < a.labels.values().size(); ++i) {
    std::int32_t& seen = other[static_cast<std::size_t>(a.labels.values()[i])];
    if (seen < 0) seen = b.labels.values()[i];
    if (seen != b.labels.values()[i]) return false;
  }
  return true;
}

TEST(DudeDecomposer, RoomsAreSeparatedAtTheirDoors) {
  DudeDecomposer decomposer({});
  const Decomposition& result = decomposer.update(threeRooms());
  ASSERT_EQ(result.regions.size(), 3U);
  ASSERT_EQ(result.crossings.size(), 2U);
  for (const Crossing& crossing : result.crossings) {
    EXPECT_NEAR(length(crossing.segment), 0.9, 1e-9);
    EXPECT_DOUBLE_EQ(crossing.segment.a.x, crossing.segment.b.x);
  }
  const int middle = labelAt(result, 6.0, 1.0);
  EXPECT_EQ(result.regions[static_cast<std::size_t>(middle - 1)].adjacent.size(), 2U);
}

TEST(DudeDecomposer, ThresholdAboveTheWallsDepthMergesTheRooms) {
  DudeDecomposerConfig config;
  config.depth_threshold_m = 3.0;  // The wall stubs are 2.6 m and 2.5 m long.
  DudeDecomposer decomposer(config);
  EXPECT_EQ(decomposer.update(threeRooms()).regions.size(), 1U);
}

TEST(DudeDecomposer, AllComponentsAndHolesAreKept) {
  FreeSpace layer = threeRooms();
  fill(layer, 5.5, 1.0, 7.7, 2.0, kFullObstacle);  // Longer than furniture.
  fill(layer, 4.4, 3.0, 4.6, 3.9, kFullObstacle);  // The left room is cut off.
  DudeDecomposer decomposer({});
  const Decomposition& result = decomposer.update(layer);
  ASSERT_EQ(result.regions.size(), 3U);
  const Region& middle = result.regions[static_cast<std::size_t>(labelAt(result, 6.0, 5.0) - 1)];
  ASSERT_EQ(middle.polygon.holes.size(), 1U);
  EXPECT_EQ(labelAt(result, 6.5, 1.5), kNoRegion);
}

TEST(DudeDecomposer, FurnitureBelongsToTheRoom) {
  FreeSpace layer = threeRooms();
  fill(layer, 5.5, 1.0, 7.0, 1.8, kFullObstacle);
  DudeDecomposer decomposer({});
  const Decomposition& result = decomposer.update(layer);
  EXPECT_EQ(labelAt(result, 6.2, 1.4), labelAt(result, 6.2, 4.0));
  EXPECT_EQ(decomposer.counters().ignored_holes, 1U);
}

TEST(DudeDecomposer, EmptyAndBlockedLayersHaveNoRegions) {
  DudeDecomposer decomposer({});
  EXPECT_TRUE(decomposer.update(FreeSpace{}).regions.empty());
  EXPECT_TRUE(decomposer.update(solid(3.0, 3.0)).regions.empty());
  EXPECT_TRUE(decomposer.update(FreeSpace{}).regions.empty());
}

TEST(DudeDecomposer, ComponentsBelowTheSmallestAreaAreDropped) {
  FreeSpace layer = solid(5.0, 3.0);
  fill(layer, 0.5, 0.5, 2.5, 2.5);
  fill(layer, 3.5, 0.5, 4.0, 1.0);
  DudeDecomposer decomposer({});
  EXPECT_EQ(decomposer.update(layer).regions.size(), 1U);
}

TEST(DudeDecomposer, UpdateWithoutAChangeKeepsEverything) {
  FreeSpace layer = threeRooms();
  DudeDecomposer decomposer({});
  (void)decomposer.update(layer);
  layer.changed = {{10, 10}, {20, 20}};
  (void)decomposer.update(layer);
  EXPECT_EQ(decomposer.counters().components, 1U);
  EXPECT_EQ(decomposer.counters().updates, 2U);
}

TEST(DudeDecomposer, ChangeInOneRoomLeavesTheOthersAlone) {
  FreeSpace layer = threeRooms();
  DudeDecomposer decomposer({});
  const Decomposition before = decomposer.update(layer);
  change(layer, 9.5, 1.0, 12.0, 1.2, kFullObstacle);
  const Decomposition& after = decomposer.update(layer);
  EXPECT_EQ(decomposer.counters().batch_updates, 1U);
  ASSERT_EQ(after.regions.size(), 3U);
  for (const double x : {1.0, 6.0}) {
    const auto label = static_cast<std::size_t>(labelAt(before, x, 1.0));
    EXPECT_EQ(labelAt(after, x, 1.0), labelAt(before, x, 1.0));
    EXPECT_EQ(after.regions[label - 1].area_m2, before.regions[label - 1].area_m2);
  }
  EXPECT_EQ(after.crossings.size(), 2U);
  EXPECT_EQ(labelAt(after, 10.0, 1.1), kNoRegion);
}

TEST(DudeDecomposer, DoorThatClosesTakesItsCrossingAway) {
  FreeSpace layer = threeRooms();
  DudeDecomposer decomposer({});
  (void)decomposer.update(layer);
  change(layer, 8.6, 3.0, 8.8, 3.9, kFullObstacle);
  const Decomposition& after = decomposer.update(layer);
  EXPECT_EQ(decomposer.counters().batch_updates, 1U);
  EXPECT_EQ(after.regions.size(), 3U);
  EXPECT_EQ(after.crossings.size(), 1U);
}

TEST(DudeDecomposer, WallThatDisappearsMergesTwoRooms) {
  FreeSpace layer = threeRooms();
  DudeDecomposer decomposer({});
  (void)decomposer.update(layer);
  change(layer, 8.6, 0.4, 8.8, 6.4, kFree);
  const Decomposition& after = decomposer.update(layer);
  EXPECT_EQ(decomposer.counters().batch_updates, 1U);
  ASSERT_EQ(after.regions.size(), 2U);
  EXPECT_EQ(labelAt(after, 6.0, 1.0), labelAt(after, 11.0, 1.0));
  ASSERT_EQ(after.crossings.size(), 1U);
  EXPECT_EQ(after.regions[0].adjacent, (std::vector<int>{2}));
  EXPECT_EQ(after.regions[1].adjacent, (std::vector<int>{1}));
}

TEST(DudeDecomposer, WallThatAppearsSplitsOneRoom) {
  FreeSpace layer = threeRooms();
  DudeDecomposer decomposer({});
  (void)decomposer.update(layer);
  change(layer, 8.8, 3.3, 12.8, 3.5, kFullObstacle);
  const Decomposition& after = decomposer.update(layer);
  EXPECT_EQ(after.regions.size(), 4U);
  EXPECT_NE(labelAt(after, 11.0, 1.0), labelAt(after, 11.0, 6.0));
}

TEST(DudeDecomposer, DetachedNewSpaceBecomesARegion) {
  FreeSpace layer = solid(20.0, 7.0);
  for (const double x : {0.4, 4.6}) fill(layer, x, 0.4, x + 4.0, 6.4);
  fill(layer, 4.4, 3.0, 4.6, 3.9);
  DudeDecomposer decomposer({});
  (void)decomposer.update(layer);
  change(layer, 12.0, 1.0, 16.0, 5.0, kFree);
  const Decomposition& after = decomposer.update(layer);
  EXPECT_EQ(decomposer.counters().batch_updates, 1U);
  EXPECT_EQ(after.regions.size(), 3U);
  EXPECT_EQ(labelAt(after, 14.0, 3.0), 3);
}

TEST(DudeDecomposer, RoomThatShrinksToNothingDisappears) {
  FreeSpace layer = threeRooms();
  DudeDecomposer decomposer({});
  const std::int32_t first = labelAt(decomposer.update(layer), 1.0, 1.0);
  change(layer, 0.4, 0.4, 4.4, 6.4, kFullObstacle);
  const Decomposition& after = decomposer.update(layer);
  ASSERT_EQ(after.regions.size(), 2U);
  EXPECT_EQ(labelAt(after, 1.0, 1.0), kNoRegion);
  for (std::size_t i = 0; i < after.regions.size(); ++i)
    EXPECT_EQ(after.regions[i].id, static_cast<int>(i + 1));
  EXPECT_EQ(after.crossings.size(), 1U);
  EXPECT_GT(first, 0);
}

TEST(DudeDecomposer, GrowingLayerKeepsRegionsInPlace) {
  FreeSpace layer = threeRooms();
  DudeDecomposer decomposer({});
  const Decomposition before = decomposer.update(layer);
  layer.cells.cover(CellBox{{-40, -60}, {300, 200}});
  const Decomposition& after = decomposer.update(layer);
  EXPECT_EQ(after.labels.box(), layer.cells.box());
  EXPECT_EQ(after.regions.size(), 3U);
  EXPECT_EQ(labelAt(after, 6.0, 1.0), labelAt(before, 6.0, 1.0));
}

TEST(DudeDecomposer, WhollyDirtyMapGivesTheBatchResult) {
  FreeSpace layer = threeRooms();
  DudeDecomposer updated({});
  (void)updated.update(layer);
  fill(layer, 4.4, 1.0, 4.6, 1.9);
  fill(layer, 8.6, 3.0, 8.8, 3.9, kFullObstacle);
  fill(layer, 1.0, 1.0, 1.2, 4.0, kFullObstacle);
  layer.changed = layer.cells.box();
  const Decomposition& after = updated.update(layer);
  DudeDecomposer fresh({});
  EXPECT_TRUE(samePartition(after, fresh.update(layer)));
  EXPECT_EQ(updated.counters().batch_updates, 2U);
}

TEST(DudeDecomposer, OldCutStaysWhereANewOneWouldNotBeMade) {
  // The opening between the second and third room is 3.0 m, then 3.3 m; the limit lies between.
  FreeSpace layer = threeRooms();
  fill(layer, 8.6, 1.9, 8.8, 4.9);
  DudeDecomposerConfig config;
  config.depth_threshold_m = 1.0;
  config.max_width_ratio = 0.7;
  DudeDecomposer decomposer(config);
  (void)decomposer.update(layer);
  change(layer, 8.6, 1.75, 8.8, 5.05, kFree);
  EXPECT_EQ(decomposer.update(layer).regions.size(), 3U);
  DudeDecomposer fresh(config);
  EXPECT_EQ(fresh.update(layer).regions.size(), 2U);
}

TEST(DudeDecomposer, DifferentMapIsTakenAsItIs) {
  DudeDecomposer decomposer({});
  (void)decomposer.update(threeRooms());
  FreeSpace other = solid(6.0, 6.0);
  fill(other, 1.0, 1.0, 5.0, 5.0);
  EXPECT_EQ(decomposer.update(other).regions.size(), 1U);
  FreeSpace coarse = solid(6.0, 6.0, 0.1);
  fill(coarse, 1.0, 1.0, 5.0, 5.0);
  EXPECT_DOUBLE_EQ(decomposer.update(coarse).frame.resolution_m, 0.1);
}

TEST(DudeDecomposer, ResetForgetsEverything) {
  DudeDecomposer decomposer({});
  (void)decomposer.update(threeRooms());
  decomposer.reset();
  EXPECT_EQ(decomposer.counters().updates, 0U);
  EXPECT_EQ(decomposer.update(threeRooms()).regions.size(), 3U);
  EXPECT_EQ(decomposer.counters().batch_updates, 1U);
}

TEST(DudeDecomposer, PublishedConfigurationInsetsRoomsAndKeepsTheLargestComponent) {
  FreeSpace layer = solid(12.0, 7.0);
  fill(layer, 1.0, 1.0, 5.0, 5.0);
  fill(layer, 7.0, 1.0, 10.0, 4.0);
  DudeDecomposer decomposer(publishedDudeConfig());
  const Decomposition& result = decomposer.update(layer);
  ASSERT_EQ(result.regions.size(), 1U);
  EXPECT_NEAR(result.regions[0].area_m2, 3.55 * 3.55, 1e-9);
  EXPECT_DOUBLE_EQ(publishedDudeConfig().depth_threshold_m, 1.5);
  // The second component overtakes the first: the choice is made anew.
  change(layer, 7.0, 1.0, 11.5, 6.5, kFree);
  EXPECT_EQ(labelAt(decomposer.update(layer), 3.0, 3.0), kNoRegion);
}

TEST(DudeDecomposer, TraceShowsTheSteps) {
  FreeSpace layer = threeRooms();
  fill(layer, 5.5, 1.0, 7.0, 1.8, kFullObstacle);
  DudeDecomposer decomposer({});
  (void)decomposer.update(layer);
  const DudeTrace trace = decomposer.trace();
  EXPECT_EQ(trace.cuts.size(), 2U);
  EXPECT_GE(trace.candidates.size(), trace.cuts.size());
  EXPECT_EQ(trace.ignored_holes.size(), 1U);
  EXPECT_EQ(trace.minima.size(), 8U);  // Four jamb corners a door.
  // The walls reach in from above and from below.
  EXPECT_EQ(std::count_if(trace.bridges.begin(), trace.bridges.end(),
                          [](const auto& bridge) { return bridge.level == 0; }),
            2);
  for (const DudeTrace::Cut& cut : trace.cuts) EXPECT_NEAR(cut.depth_m, 2.6, 1e-9);
}

TEST(DudeDecomposer, ValuesOutOfRangeAreRefusedByName) {
  const auto messageOf = [](const std::function<void(DudeDecomposerConfig&)>& spoil) {
    DudeDecomposerConfig config;
    spoil(config);
    try {
      const DudeDecomposer decomposer(config);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(messageOf([](auto& c) { c.depth_threshold_m = -1.0; }).find("depth_threshold_m"),
            std::string::npos);
  EXPECT_NE(messageOf([&](auto& c) { c.max_width_ratio = nan; }).find("max_width_ratio"),
            std::string::npos);
  EXPECT_NE(messageOf([](auto& c) { c.longest_cut_m = 0.0; }).find("longest_cut_m"),
            std::string::npos);
  EXPECT_NE(messageOf([](auto& c) { c.min_region_area_m2 = -1.0; }).find("min_region_area_m2"),
            std::string::npos);
  EXPECT_NE(messageOf([](auto& c) { c.max_ignored_hole_m = -0.1; }).find("max_ignored_hole_m"),
            std::string::npos);
  EXPECT_NE(messageOf([](auto& c) { c.keep_bonus = -0.1; }).find("keep_bonus"), std::string::npos);
}

}  // namespace
}  // namespace occusg
