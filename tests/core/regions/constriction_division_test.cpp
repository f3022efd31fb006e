// SPDX-License-Identifier: BSD-3-Clause
// The parts of a map that did not change are not cut again, and nobody can tell.
#include "regions/constriction_division.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>
#include <string>

#include "equal_decompositions.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg {
namespace {

using testing::expectEqual;

constexpr double kResolution_m = 0.1;

/// What a rectangle of the layer becomes.
enum class Paint { kFree, kObstacle, kUnknown, kLintel, kCount };

ColumnEvidence evidenceOf(Paint paint) {
  ColumnEvidence evidence;
  evidence.floor = 0;
  evidence.gap_top = paint == Paint::kLintel ? 20 : 26;
  evidence.overhead = Overhead::kOccupied;
  return evidence;
}

/// Paints a rectangle and adds it to what has changed.
void paint(const CellBox& box, Paint paint, FreeSpace& layer) {
  layer.cells.cover(box);
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const bool is_free = paint == Paint::kFree || paint == Paint::kLintel;
      layer.cells.at({x, y}) =
          is_free ? kFree : (paint == Paint::kObstacle ? kFullObstacle : kUnknown);
      layer.evidence.touch({x, y}) = evidenceOf(paint);
    }
  }
  layer.changed = layer.changed.including(box);
  layer.gaps_changed = layer.changed;
}

/// Two by two rooms of 3 m, walls of 0.2 m, a lintel in every wall between two.
FreeSpace fourRooms() {
  FreeSpace layer;
  layer.frame.resolution_m = kResolution_m;
  paint({{0, 0}, {66, 66}}, Paint::kObstacle, layer);
  for (const int y : {2, 34})
    for (const int x : {2, 34}) paint({{x, y}, {x + 30, y + 30}}, Paint::kFree, layer);
  for (const int along : {12, 44}) {
    paint({{32, along}, {34, along + 9}}, Paint::kLintel, layer);
    paint({{along, 32}, {along + 9, 34}}, Paint::kLintel, layer);
  }
  return layer;
}

CellBox randomBox(std::mt19937& random, const CellBox& within) {
  std::uniform_int_distribution<int> x(within.min.x, within.max.x - 1);
  std::uniform_int_distribution<int> y(within.min.y, within.max.y - 1);
  // Often small or thin, as tables, rays and pieces of wall are.
  std::uniform_int_distribution<int> side(1, random() % 3 == 0 ? 20 : 5);
  const Cell low{x(random), y(random)};
  return {low, {low.x + side(random), low.y + side(random)}};
}

/// What the layer gives when nothing came before it.
Decomposition cutAnew(const FreeSpace& layer, const ConstrictionDecomposerConfig& config) {
  ConstrictionDecomposer decomposer(config);
  return decomposer.update(layer, layer.cells.box());
}

/// The same, two of them with a ceiling as low as the lintels.
FreeSpace fourRoomsTwoOfThemLow() {
  FreeSpace layer = fourRooms();
  paint({{2, 2}, {32, 32}}, Paint::kLintel, layer);
  paint({{2, 34}, {32, 64}}, Paint::kLintel, layer);
  return layer;
}

void expectSameAsCutAnew(const ConstrictionDecomposerConfig& config, unsigned seed,
                         FreeSpace layer = fourRooms()) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  ConstrictionDecomposer decomposer(config);
  for (int step = 0; step < 30; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    expectEqual(decomposer.update(layer), cutAnew(layer, config));
    if (::testing::Test::HasFailure()) return;
    layer.changed = layer.gaps_changed = {};
    const std::uint32_t strokes = 1 + random() % 3;
    for (std::uint32_t i = 0; i < strokes; ++i) {
      const int margin = random() % 10 == 0 ? 8 : 0;
      const auto kind = static_cast<Paint>(random() % static_cast<unsigned>(Paint::kCount));
      paint(randomBox(random, layer.cells.box().grown(margin)), kind, layer);
    }
  }
}

TEST(ConstrictionDivision, ResultOfManyUpdatesIsThatOfTheLastLayerAlone) {
  for (unsigned seed = 0; seed < 40; ++seed) expectSameAsCutAnew({}, seed);
}

TEST(ConstrictionDivision, ResultIsThatOfTheLastLayerAloneWhateverTheParameters) {
  ConstrictionDecomposerConfig leaves_islands_out;
  leaves_islands_out.island_footprint = IslandFootprint::kLeaveOut;
  leaves_islands_out.min_region_area_m2 = 0.3;
  ConstrictionDecomposerConfig fills_much;
  fills_much.max_filled_obstacle_m2 = 4.0;
  fills_much.min_region_area_m2 = 0.2;
  fills_much.min_room_width_m = 0.0;
  fills_much.min_crossing_m = 0.0;
  ConstrictionDecomposerConfig without_lintels;
  without_lintels.highest_lintel_m = 0.0;
  for (unsigned seed = 100; seed < 120; ++seed) {
    expectSameAsCutAnew(leaves_islands_out, seed);
    expectSameAsCutAnew(fills_much, seed);
    expectSameAsCutAnew(without_lintels, seed);
  }
}

TEST(ConstrictionDivision, ResultIsThatOfTheLastLayerAloneUnderLowCeilings) {
  for (unsigned seed = 200; seed < 230; ++seed)
    expectSameAsCutAnew({}, seed, fourRoomsTwoOfThemLow());
}

TEST(ConstrictionDivision, RoomsWithALowCeilingAreRegionsAsOthersAre) {
  const Decomposition high = cutAnew(fourRooms(), {});
  const Decomposition low = cutAnew(fourRoomsTwoOfThemLow(), {});
  ASSERT_EQ(high.regions.size(), 4U);
  ASSERT_EQ(low.regions.size(), 4U);
  EXPECT_EQ(low.crossings.size(), high.crossings.size());
  for (std::size_t i = 0; i < 4; ++i) {
    // The floor of a doorway may go to the other side of it.
    EXPECT_NEAR(low.regions[i].area_m2, high.regions[i].area_m2, 0.3);
    EXPECT_EQ(low.regions[i].adjacent, high.regions[i].adjacent);
  }
}

TEST(ConstrictionDivision, NarrowPassageWithALowCeilingIsNoRegion) {
  FreeSpace layer = fourRooms();
  paint({{32, 12}, {34, 26}}, Paint::kLintel, layer);  // 0.2 m deep, 1.4 m wide
  EXPECT_EQ(cutAnew(layer, {}).regions.size(), 4U);
}

/// Every cell has the id that the track of its region has.
void expectLabelsFollowTracks(const Decomposition& regions, const TrackedRegions& tracked) {
  ASSERT_EQ(regions.regions.size(), tracked.decomposition.regions.size());
  std::map<std::int32_t, std::int32_t> track_of{{kNoRegion, kNoRegion}};
  for (std::size_t i = 0; i < regions.labels.values().size(); ++i) {
    const std::int32_t track = tracked.decomposition.labels.values()[i];
    EXPECT_EQ(track_of.emplace(regions.labels.values()[i], track).first->second, track);
  }
  EXPECT_EQ(track_of.size(), regions.regions.size() + 1);
}

// What the decomposer says of regions that stayed the same only saves the tracker time.
TEST(ConstrictionDivision, TrackerFollowsWithAndWithoutBeingToldWhatIsTheSame) {
  for (unsigned seed = 200; seed < 220; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    FreeSpace layer = fourRooms();
    ConstrictionDecomposer decomposer{{}};
    RegionTracker told{{}};
    RegionTracker untold{{}};
    for (int step = 0; step < 20; ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      const Decomposition& regions = decomposer.update(layer);
      Decomposition silent = regions;
      silent.update = 0;
      silent.same_as.clear();
      const TrackedRegions& a = told.update(regions);
      const TrackedRegions& b = untold.update(silent);
      ASSERT_EQ(a.stale, b.stale);
      ASSERT_EQ(a.changed, b.changed);
      ASSERT_EQ(a.missed, b.missed);
      expectEqual(a.decomposition, b.decomposition);
      if (!a.stale) expectLabelsFollowTracks(regions, a);
      if (HasFailure()) return;
      layer.changed = layer.gaps_changed = {};
      const auto kind = static_cast<Paint>(random() % static_cast<unsigned>(Paint::kCount));
      paint(randomBox(random, layer.cells.box()), kind, layer);
    }
  }
}

TEST(ConstrictionDivision, RegionsAreNumberedByTheirFirstCell) {
  FreeSpace layer = fourRooms();
  ConstrictionDecomposer decomposer{{}};
  ASSERT_EQ(decomposer.update(layer).regions.size(), 4U);
  layer.changed = layer.gaps_changed = {};
  paint({{2, 2}, {32, 32}}, Paint::kObstacle, layer);
  const Decomposition& result = decomposer.update(layer);
  ASSERT_EQ(result.regions.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(result.regions[i].id, static_cast<int>(i) + 1);
    const Cell inside = layer.frame.cellAt(result.regions[i].centroid);
    EXPECT_EQ(result.labels.at(inside), result.regions[i].id);
  }
}

TEST(ConstrictionDivision, LintelThatComesIntoViewSeparatesRooms) {
  FreeSpace layer = fourRooms();
  for (const int along : {12, 44}) {
    paint({{32, along}, {34, along + 9}}, Paint::kFree, layer);
    paint({{along, 32}, {along + 9, 34}}, Paint::kFree, layer);
  }
  ConstrictionDecomposerConfig config;
  config.widest_door_m = 0.5;  // without lintels the openings are no doors
  ConstrictionDecomposer decomposer(config);
  ASSERT_EQ(decomposer.update(layer).regions.size(), 1U);
  layer.changed = layer.gaps_changed = {};
  for (const int along : {12, 44}) {
    paint({{32, along}, {34, along + 9}}, Paint::kLintel, layer);
    paint({{along, 32}, {along + 9, 34}}, Paint::kLintel, layer);
  }
  layer.changed = {};  // the cells are as free as before
  EXPECT_EQ(decomposer.update(layer).regions.size(), 4U);
}

TEST(ConstrictionDivision, OtherMapAndOtherResolutionAreTakenAsTheyCome) {
  ConstrictionDecomposer decomposer{{}};
  FreeSpace layer = fourRooms();
  ASSERT_EQ(decomposer.update(layer).regions.size(), 4U);
  FreeSpace small;
  small.frame.resolution_m = kResolution_m;
  paint({{0, 0}, {30, 30}}, Paint::kFree, small);
  EXPECT_EQ(decomposer.update(small).regions.size(), 1U);
  small.frame.resolution_m = 0.2;
  EXPECT_NEAR(decomposer.update(small).regions.front().area_m2, 36.0, 1e-9);
}

}  // namespace
}  // namespace occusg
