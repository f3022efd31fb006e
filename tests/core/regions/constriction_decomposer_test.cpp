// SPDX-License-Identifier: BSD-3-Clause
// What the constriction method promises beyond decomposer_contract_test.cpp.
#include "occusg/regions/constriction_decomposer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "error_sentence.hpp"
#include "floor_plans.hpp"

namespace occusg {
namespace {

using testing::fill;
using testing::sentenceOf;
using testing::solid;
using testing::tells;
using testing::twoRooms;

Decomposition decompose(const FreeSpace& layer, const ConstrictionDecomposerConfig& config = {}) {
  return ConstrictionDecomposer(config).update(layer);
}

std::size_t regionCount(const FreeSpace& layer, const ConstrictionDecomposerConfig& config = {}) {
  return decompose(layer, config).regions.size();
}

TEST(ConstrictionDecomposer, PassageWiderThanTheWidestDoorDoesNotSeparate) {
  ConstrictionDecomposerConfig config;
  config.widest_door_m = 1.5;
  EXPECT_EQ(regionCount(twoRooms(1.4), config), 2U);
  EXPECT_EQ(regionCount(twoRooms(1.6), config), 1U);
}

/// Two rooms of 4 m open to each other over their whole width, with something overhead in between.
FreeSpace roomsUnderALintel(int lintel_voxels) {
  FreeSpace layer = solid(8.6, 4.4);
  fill(layer, 0.2, 0.2, 8.4, 4.2);
  ColumnEvidence under_lintel;
  under_lintel.floor = 0;
  under_lintel.gap_top = static_cast<std::uint16_t>(lintel_voxels);
  under_lintel.overhead = Overhead::kOccupied;
  for (int y = 4; y < 84; ++y)
    for (int x = 84; x < 88; ++x) layer.evidence.touch({x, y}) = under_lintel;
  return layer;
}

TEST(ConstrictionDecomposer, LintelSeparatesRoomsUnlessToldNotTo) {
  ConstrictionDecomposerConfig config;
  config.highest_lintel_m = 0.0;
  EXPECT_EQ(regionCount(roomsUnderALintel(40), config), 1U);
  config.highest_lintel_m = 2.15;
  const Decomposition result = decompose(roomsUnderALintel(40), config);
  ASSERT_EQ(result.regions.size(), 2U);
  EXPECT_NEAR(result.regions[0].area_m2, 16.4, 1e-6);  // the floor below the lintel is shared
  EXPECT_NEAR(result.regions[1].area_m2, 16.4, 1e-6);
  EXPECT_EQ(result.crossings.size(), 1U);
}

TEST(ConstrictionDecomposer, WhatHangsTooHighOrTooLowIsNoLintel) {
  ConstrictionDecomposerConfig config;
  config.highest_lintel_m = 2.15;
  EXPECT_EQ(regionCount(roomsUnderALintel(44), config), 1U);
  EXPECT_EQ(regionCount(roomsUnderALintel(33), config), 1U);
}

TEST(ConstrictionDecomposer, RegionsGetNoFewerAsDoorsMayBeWider) {
  std::size_t before = 0;
  for (const double widest_door_m : {0.5, 0.8, 1.0, 1.5, 2.0, 3.0}) {
    ConstrictionDecomposerConfig config;
    config.widest_door_m = widest_door_m;
    const std::size_t count = regionCount(twoRooms(0.9), config);
    EXPECT_GE(count, before) << widest_door_m;
    before = count;
  }
  EXPECT_EQ(before, 2U);
}

TEST(ConstrictionDecomposer, CutIsStraightFromJambToJambAndNoFrontBulgesThroughTheDoor) {
  const Decomposition result = decompose(twoRooms(0.9));
  ASSERT_EQ(result.regions.size(), 2U);
  // Rooms with their share of the doorway: four corners and the four of a straight step.
  EXPECT_LE(result.regions[0].polygon.outer.size(), 8U);
  EXPECT_LE(result.regions[1].polygon.outer.size(), 8U);
  for (const Region& region : result.regions) {
    EXPECT_GE(region.area_m2, 16.0 - 1e-9);
    EXPECT_LE(region.area_m2, 16.0 + 0.2 * 0.9 + 1e-9);
  }
  ASSERT_EQ(result.crossings.size(), 1U);
  const Segment2& segment = result.crossings[0].segment;
  EXPECT_NEAR(segment.a.x, segment.b.x, 1e-9);
  EXPECT_NEAR(length(segment), 0.9, 1e-9);
}

TEST(ConstrictionDecomposer, ObliqueDoorIsCutObliquely) {
  // A wall along x + y = 8 m with a gap of 1 m in its middle.
  FreeSpace layer = solid(8.0, 8.0);
  fill(layer, 0.5, 0.5, 7.5, 7.5);
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 160; ++x) {
      const bool is_gap = std::abs(x - y) * 0.05 / std::sqrt(2.0) < 0.5;
      if (std::abs(x + y - 160) <= 2 && !is_gap) layer.cells.at({x, y}) = kFullObstacle;
    }
  }
  const Decomposition result = decompose(layer);
  ASSERT_EQ(result.regions.size(), 2U);
  ASSERT_EQ(result.crossings.size(), 1U);
  const Segment2& segment = result.crossings[0].segment;
  EXPECT_NEAR(length(segment), 1.0, 0.15);
  EXPECT_NEAR(std::atan2(segment.b.y - segment.a.y, segment.a.x - segment.b.x), M_PI / 4, 0.15);
}

TEST(ConstrictionDecomposer, DoorAsWideAsItsCorridorSeparates) {
  // 0.8 m both. Opposite the door the corridor has room for a circle of hardly more.
  FreeSpace layer = solid(10.6, 6.0);
  fill(layer, 3.8, 0.2, 6.6, 1.0);
  fill(layer, 3.2, 1.2, 7.2, 5.2);
  fill(layer, 4.8, 1.0, 5.6, 1.2);
  EXPECT_EQ(regionCount(layer), 2U);
  ConstrictionDecomposerConfig config;
  config.door_reach_m = 0.0;
  EXPECT_EQ(regionCount(layer, config), 1U);
}

TEST(ConstrictionDecomposer, UnevenCorridorStaysWhole) {
  FreeSpace layer = solid(12.0, 2.4);
  fill(layer, 0.2, 0.2, 11.8, 2.2);
  for (const double x : {3.0, 6.0, 9.0}) {  // Pilasters leave 1.6 of 2 m.
    fill(layer, x, 0.2, x + 0.3, 0.4, kFullObstacle);
    fill(layer, x, 2.0, x + 0.3, 2.2, kFullObstacle);
  }
  EXPECT_EQ(regionCount(layer), 1U);
}

TEST(ConstrictionDecomposer, TableDoesNotShapeRegionsAndIsPartOfTheFootprint) {
  FreeSpace layer = solid(4.4, 4.4);
  fill(layer, 0.2, 0.2, 4.2, 4.2);
  fill(layer, 1.7, 1.9, 2.7, 2.5, kFullObstacle);
  const Decomposition filled = decompose(layer);
  ASSERT_EQ(filled.regions.size(), 1U);
  EXPECT_NEAR(filled.regions[0].area_m2, 16.0, 1e-9);
  EXPECT_TRUE(filled.regions[0].polygon.holes.empty());
  EXPECT_EQ(filled.labels.at({44, 44}), 1);

  ConstrictionDecomposerConfig config;
  config.island_footprint = IslandFootprint::kLeaveOut;
  const Decomposition left_out = decompose(layer, config);
  ASSERT_EQ(left_out.regions.size(), 1U);
  EXPECT_NEAR(left_out.regions[0].area_m2, 15.4, 1e-9);
  EXPECT_EQ(left_out.regions[0].polygon.holes.size(), 1U);
  EXPECT_EQ(left_out.labels.at({44, 44}), kNoRegion);
}

TEST(ConstrictionDecomposer, WhatANestedIslandEnclosesIsFilledWithIt) {
  FreeSpace layer = solid(4.4, 4.4);
  fill(layer, 0.2, 0.2, 4.2, 4.2);
  fill(layer, 1.8, 1.8, 2.6, 2.6, kFullObstacle);
  fill(layer, 1.9, 1.9, 2.5, 2.5);
  fill(layer, 2.1, 2.1, 2.2, 2.2, kUnknown);
  const Decomposition result = decompose(layer);
  ASSERT_EQ(result.regions.size(), 1U);
  EXPECT_NEAR(result.regions[0].area_m2, 16.0, 1e-9);
}

TEST(ConstrictionDecomposer, IslandAboveTheLimitStaysAHole) {
  FreeSpace layer = solid(6.4, 6.4);
  fill(layer, 0.2, 0.2, 6.2, 6.2);
  fill(layer, 2.5, 2.5, 3.9, 3.9, kFullObstacle);
  const Decomposition result = decompose(layer);
  double total_m2 = 0.0;
  for (const Region& region : result.regions) total_m2 += region.area_m2;
  EXPECT_NEAR(total_m2, 36.0 - 1.96, 1e-9);
}

TEST(ConstrictionDecomposer, FreestandingWallSeparatesAlthoughItsAreaIsSmall) {
  // A wall of 2.6 m x 0.1 m that touches nothing leaves a door of 0.7 m on either end.
  FreeSpace layer = solid(8.4, 4.4);
  fill(layer, 0.2, 0.2, 8.2, 4.2);
  fill(layer, 4.1, 0.9, 4.2, 3.5, kFullObstacle);
  const Decomposition result = decompose(layer);
  EXPECT_EQ(result.regions.size(), 2U);
  EXPECT_EQ(result.crossings.size(), 2U);
}

/// A hall of 8 m x 8 m; a corridor of 1.5 m leaves the middle of its right wall without a door.
FreeSpace hallWithACorridor(double length_m) {
  FreeSpace layer = solid(8.6 + length_m, 8.4);
  fill(layer, 0.2, 0.2, 8.2, 8.2);
  fill(layer, 8.2, 3.45, 8.2 + length_m, 4.95);
  return layer;
}

TEST(ConstrictionDecomposer, CorridorThatOpensIntoAHallIsARegion) {
  const Decomposition result = decompose(hallWithACorridor(8.0));
  ASSERT_EQ(result.regions.size(), 2U);
  ASSERT_EQ(result.crossings.size(), 1U);
  EXPECT_NEAR(result.regions[0].area_m2, 64.0, 0.4);
  EXPECT_NEAR(result.regions[1].area_m2, 12.0, 0.4);
}

TEST(ConstrictionDecomposer, ShortArmOfAHallIsNoCorridor) {
  EXPECT_EQ(regionCount(hallWithACorridor(4.0)), 1U);
}

TEST(ConstrictionDecomposer, NicheBelowTheSmallestAreaBelongsToItsRoom) {
  FreeSpace layer = twoRooms(0.9);
  fill(layer, 1.0, 4.2, 1.2, 4.3);
  ConstrictionDecomposerConfig config;
  config.min_region_area_m2 = 0.5;
  EXPECT_EQ(regionCount(layer, config), 2U);
}

TEST(ConstrictionDecomposer, DetachedSpeckIsDropped) {
  FreeSpace layer = solid(6.0, 5.0);
  fill(layer, 0.2, 0.2, 4.2, 4.2);
  fill(layer, 5.0, 1.0, 5.5, 2.0);
  const Decomposition result = decompose(layer);
  ASSERT_EQ(result.regions.size(), 1U);
  EXPECT_EQ(result.labels.at({104, 30}), kNoRegion);
}

TEST(ConstrictionDecomposer, SoftObstaclesAreNotFree) {
  FreeSpace layer = twoRooms(0.9);
  fill(layer, 4.2, 1.7, 4.4, 2.7, std::int8_t{1});
  const Decomposition result = decompose(layer);
  EXPECT_EQ(result.regions.size(), 2U);
  EXPECT_TRUE(result.crossings.empty());
}

TEST(ConstrictionDecomposer, ResolutionChangesTheCellsNotTheRooms) {
  for (const double resolution_m : {0.025, 0.05, 0.1}) {
    SCOPED_TRACE(resolution_m);
    const Decomposition result = decompose(twoRooms(1.0, resolution_m));
    ASSERT_EQ(result.regions.size(), 2U);
    EXPECT_NEAR(result.regions[0].area_m2, 16.1, 0.15);
  }
}

/// A hall of 10 m x 5 m between walls of 0.2 m, nothing known around it.
FreeSpace hall() {
  FreeSpace layer = solid(30.0, 20.0);
  fill(layer, 0.0, 0.0, 30.0, 20.0, kUnknown);
  fill(layer, 9.8, 4.8, 20.2, 10.2, kFullObstacle);
  fill(layer, 10.0, 5.0, 20.0, 10.0);
  return layer;
}

TEST(ConstrictionDecomposer, BeamsThroughCracksOfDoorsAreNoRooms) {
  FreeSpace layer = hall();
  for (const double x : {11.0, 13.0, 15.0}) fill(layer, x, 10.3, x + 0.2, 19.0);
  const Decomposition result = decompose(layer);
  ASSERT_EQ(result.regions.size(), 1U);
  EXPECT_NEAR(result.regions[0].area_m2, 50.0, 0.3);
  ConstrictionDecomposerConfig config;
  config.min_room_width_m = 0.0;
  config.min_enclosed_share = 0.0;
  EXPECT_EQ(regionCount(layer, config), 4U);
}

/// Beams of 0.4 m, 0.2 m apart beyond a window of 1.2 m, that fill up near it.
FreeSpace hallWithAFanBehindItsWindow() {
  FreeSpace layer = hall();
  fill(layer, 14.0, 10.0, 15.2, 10.2);
  fill(layer, 12.6, 10.2, 16.6, 12.0);
  for (int beam = 0; beam < 7; ++beam)
    fill(layer, 12.6 + 0.6 * beam, 12.0, 13.0 + 0.6 * beam, 15.0 + beam % 3);
  return layer;
}

TEST(ConstrictionDecomposer, FanOfRaysBehindAWindowIsOutside) {
  const Decomposition result = decompose(hallWithAFanBehindItsWindow());
  ASSERT_EQ(result.regions.size(), 1U);
  EXPECT_NEAR(result.regions[0].area_m2, 50.0, 0.5);
  ConstrictionDecomposerConfig config;
  config.min_enclosed_share = 0.0;
  EXPECT_GT(regionCount(hallWithAFanBehindItsWindow(), config), 1U);
}

TEST(ConstrictionDecomposer, RoomsOfAMapThatDrawsNoWallsStay) {
  FreeSpace layer = solid(12.0, 6.0);
  fill(layer, 0.0, 0.0, 12.0, 6.0, kUnknown);
  fill(layer, 0.5, 0.5, 5.5, 5.5);
  fill(layer, 5.5, 2.5, 5.8, 3.4);
  fill(layer, 5.8, 0.5, 11.0, 5.5);
  EXPECT_EQ(regionCount(layer), 2U);
}

TEST(ConstrictionDecomposer, PaperAroundADrawnPlanIsNoRoom) {
  FreeSpace layer = solid(14.6, 10.4);
  fill(layer, 0.0, 0.0, 14.6, 10.4);
  fill(layer, 3.0, 3.0, 11.6, 7.4, kFullObstacle);
  fill(layer, 3.2, 3.2, 7.2, 7.2);
  fill(layer, 7.4, 3.2, 11.4, 7.2);
  fill(layer, 7.2, 4.7, 7.4, 5.6);
  const Decomposition result = decompose(layer);
  ASSERT_EQ(result.regions.size(), 2U);
  EXPECT_LT(result.regions[0].area_m2 + result.regions[1].area_m2, 32.5);
}

/// A room of 6 m x 4 m whose corner of 1.6 m x 1.5 m lies behind a cabinet and clutter at the wall.
TEST(ConstrictionDecomposer, CornerBehindACabinetIsPartOfItsRoom) {
  FreeSpace layer = solid(6.4, 4.4);
  fill(layer, 0.2, 0.2, 6.2, 4.2);
  fill(layer, 1.8, 2.7, 2.4, 4.2, kFullObstacle);
  for (int i = 0; i < 7; ++i)
    fill(layer, 0.2, 2.7 + 0.1 * i, 0.9 - 0.1 * i, 2.8 + 0.1 * i, kFullObstacle);
  ConstrictionDecomposerConfig config;
  config.max_opening_ratio = 100.0;
  EXPECT_EQ(regionCount(layer, config), 2U);
  EXPECT_EQ(regionCount(layer), 1U);
}

TEST(ConstrictionDecomposer, BoothsBehindStubsOfWallAreRooms) {
  // Two booths of 2.2 m x 2.2 m that open over 1.6 m between stubs of a thin wall.
  FreeSpace layer = solid(8.0, 7.0);
  fill(layer, 0.2, 0.2, 7.8, 3.2);
  for (const double x : {1.0, 4.0}) {
    fill(layer, x, 3.3, x + 2.2, 5.5);
    fill(layer, x + 0.3, 3.2, x + 1.9, 3.3);
  }
  EXPECT_EQ(regionCount(layer), 3U);
}

TEST(ConstrictionDecomposer, RefusesParametersOutOfRange) {
  const auto refusal = [](auto change) {
    ConstrictionDecomposerConfig config;
    change(config);
    return sentenceOf([&] { ConstrictionDecomposer decomposer(config); });
  };
  const std::string where = "regions.constriction.";
  EXPECT_TRUE(tells(refusal([](auto& c) { c.widest_door_m = 0.0; }), {where + "widest_door_m"}));
  EXPECT_TRUE(tells(refusal([](auto& c) { c.shallowest_basin_ratio = 1.5; }),
                    {where + "shallowest_basin_ratio", "1.5", "allowed is [0.01, 1]"}));
  EXPECT_TRUE(tells(refusal([](auto& c) { c.door_widening = 0.9; }), {where + "door_widening"}));
  EXPECT_TRUE(tells(refusal([](auto& c) { c.door_reach_m = -1.0; }), {where + "door_reach_m"}));
  EXPECT_TRUE(tells(refusal([](auto& c) { c.min_region_area_m2 = std::nan(""); }),
                    {where + "min_region_area_m2", "nan"}));
  EXPECT_TRUE(tells(refusal([](auto& c) { c.min_crossing_m = -0.1; }), {where + "min_crossing_m"}));
  EXPECT_TRUE(tells(refusal([](auto& c) { c.max_filled_obstacle_m2 = -1.0; }),
                    {where + "max_filled_obstacle_m2"}));
}

}  // namespace
}  // namespace occusg
