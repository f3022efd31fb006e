// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/region_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "error_sentence.hpp"
#include "occusg/regions/label_regions.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;

/// A rectangle of cells of 0.1 m.
struct Block {
  int x = 0;
  int y = 0;
  int width = 40;
  int height = 40;
};

/// One region a block, in this order (labels follow the blocks; regions the labels).
Decomposition blocks(const std::vector<Block>& list) {
  Decomposition result;
  result.frame = GridFrame{0.1};
  CellBox all;
  for (const Block& b : list)
    all = all.including(CellBox{{b.x, b.y}, {b.x + b.width, b.y + b.height}});
  result.labels = Grid<std::int32_t>(all, kNoRegion);
  for (const Block& b : list) {
    Region region;
    region.id = static_cast<int>(result.regions.size()) + 1;
    region.cells = {{b.x, b.y}, {b.x + b.width, b.y + b.height}};
    const double x0 = 0.1 * b.x;
    const double y0 = 0.1 * b.y;
    const double x1 = 0.1 * (b.x + b.width);
    const double y1 = 0.1 * (b.y + b.height);
    region.polygon = {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
    region.area_m2 = (x1 - x0) * (y1 - y0);
    region.centroid = {(x0 + x1) / 2, (y0 + y1) / 2};
    for (int y = b.y; y < b.y + b.height; ++y)
      for (int x = b.x; x < b.x + b.width; ++x) result.labels.at({x, y}) = region.id;
    result.regions.push_back(std::move(region));
  }
  return result;
}

/// No guard: what comes is taken.
RegionTrackerConfig unguarded() {
  RegionTrackerConfig config;
  config.guard.max_area_drop = 1.0;
  return config;
}

std::vector<int> idsOf(const TrackedRegions& tracked) {
  std::vector<int> ids;
  for (const Region& region : tracked.decomposition.regions) ids.push_back(region.id);
  return ids;
}

/// The id a region gets when `before` was there one update earlier and had id 1.
int idAfter(const Block& before, const Block& after,
            const RegionTrackerConfig& config = unguarded()) {
  RegionTracker tracker(config);
  tracker.update(blocks({before}));
  return idsOf(tracker.update(blocks({after}))).front();
}

const Block kLeft{0, 0};
const Block kMiddle{50, 0};
const Block kRight{100, 0};

TEST(RegionTracker, IdsCountUpFromOneInListOrder) {
  RegionTracker tracker(unguarded());
  EXPECT_EQ(idsOf(tracker.update(blocks({kLeft, kMiddle}))), (std::vector<int>{1, 2}));
}

TEST(RegionTracker, SwappedInputOrderKeepsIds) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft, kMiddle}));
  const TrackedRegions& tracked = tracker.update(blocks({kMiddle, kLeft}));
  ASSERT_EQ(idsOf(tracked), (std::vector<int>{1, 2}));
  EXPECT_EQ(tracked.decomposition.regions[0].cells.min, (Cell{0, 0}));
  EXPECT_EQ(tracked.decomposition.regions[1].cells.min, (Cell{50, 0}));
  EXPECT_EQ(tracked.decomposition.labels.at({0, 0}), 1);
  EXPECT_EQ(tracked.decomposition.labels.at({50, 0}), 2);
  EXPECT_EQ(tracked.decomposition.labels.at({45, 0}), kNoRegion);
}

TEST(RegionTracker, RestoredTrackerGivesTheFirstRegionsWhole) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft, kMiddle}));
  RegionTracker restored(unguarded());
  restored.restore(tracker.state());
  const TrackedRegions& tracked = restored.update(blocks({kMiddle, kLeft, kRight}));
  ASSERT_EQ(idsOf(tracked), (std::vector<int>{1, 2, 3}));
  for (const Region& region : tracked.decomposition.regions) {
    EXPECT_EQ(region.polygon.outer.size(), 4U);
    EXPECT_EQ(tracked.decomposition.labels.at(region.cells.min), region.id);
  }
}

TEST(RegionTracker, LabelsFollowRegionsThatMoveShrinkAndGo) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft, kMiddle, kRight}));
  const TrackedRegions& tracked =
      tracker.update(blocks({{2, 0, 36, 40}, {50, 0, 40, 20}, {100, 0, 40, 40}}));
  const Grid<std::int32_t>& labels = tracked.decomposition.labels;
  EXPECT_EQ(labels.at({2, 0}), 1);
  EXPECT_EQ(labels.at({39, 0}), kNoRegion);
  EXPECT_EQ(labels.at({50, 19}), 2);
  EXPECT_EQ(labels.at({50, 20}), kNoRegion);
  EXPECT_EQ(tracker.update(blocks({kMiddle})).decomposition.labels.valueOr({100, 0}, kNoRegion),
            kNoRegion);
}

TEST(RegionTracker, ThirdRegionGetsTheNextId) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft, kMiddle}));
  EXPECT_EQ(idsOf(tracker.update(blocks({kRight, kLeft, kMiddle}))), (std::vector<int>{1, 2, 3}));
}

TEST(RegionTracker, VanishedAndEmptyUpdateBringBackOldIds) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft, kMiddle}));
  EXPECT_EQ(tracker.update(blocks({kMiddle})).missed, std::vector<int>{1});
  const TrackedRegions& empty = tracker.update(Decomposition{});
  EXPECT_TRUE(empty.decomposition.regions.empty());
  EXPECT_EQ(empty.missed, (std::vector<int>{1, 2}));
  const TrackedRegions& back = tracker.update(blocks({kMiddle, kLeft}));
  ASSERT_EQ(idsOf(back), (std::vector<int>{1, 2}));
  EXPECT_EQ(back.decomposition.regions[0].cells.min, (Cell{0, 0}));
  EXPECT_TRUE(back.missed.empty());
}

TEST(RegionTracker, IdReturnsAfterThreeMissedUpdates) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft, kMiddle}));
  for (int i = 0; i < 3; ++i) {
    const TrackedRegions& tracked = tracker.update(blocks({kLeft}));
    EXPECT_EQ(idsOf(tracked), std::vector<int>{1});
    EXPECT_EQ(tracked.missed, std::vector<int>{2});
  }
  EXPECT_EQ(idsOf(tracker.update(blocks({kLeft, kMiddle}))), (std::vector<int>{1, 2}));
}

TEST(RegionTracker, IdIsNewAfterFourMissedUpdates) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft, kMiddle}));
  for (int i = 0; i < 4; ++i) tracker.update(blocks({kLeft}));
  EXPECT_TRUE(tracker.regions().missed.empty());
  EXPECT_EQ(idsOf(tracker.update(blocks({kLeft, kMiddle}))), (std::vector<int>{1, 3}));
}

// Shifted by s of its width w, a block overlaps its old self by (w - s) / (w + s).
TEST(RegionTracker, OverlapMustExceedAFifth) {
  const Block wall{0, 0, 15, 40};
  EXPECT_EQ(idAfter(wall, {9, 0, 15, 40}), 1);   // 6 / 24 = 0.25
  EXPECT_EQ(idAfter(wall, {10, 0, 15, 40}), 2);  // 5 / 25 = 0.2 exactly
  EXPECT_EQ(idAfter(wall, {11, 0, 15, 40}), 2);  // 4 / 26, though the centroids are 1.1 m apart
}

TEST(RegionTracker, CentroidsMustBeNearerThanOneAndAHalfMetres) {
  RegionTrackerConfig paper = unguarded();
  paper.max_centroid_distance_m = 1.5;
  EXPECT_EQ(idAfter(kLeft, {14, 0}, paper), 1);
  EXPECT_EQ(idAfter(kLeft, {16, 0}, paper), 2);  // IoU 24 / 56 would do.
}

TEST(RegionTracker, ByDefaultOverlapAloneTellsWhetherALargeRegionIsTheSame) {
  EXPECT_EQ(idAfter(kLeft, {16, 0}), 1);
}

TEST(RegionTracker, AreaRatioMustLieWithinAQuarterAndFour) {
  const Block small{15, 15, 10, 10};
  RegionTrackerConfig config = unguarded();
  config.min_overlap = 0.0;  // Nested blocks overlap by the ratio itself.
  const auto follows = [&](const Block& before, const Block& after) {
    RegionTracker tracker(config);
    tracker.update(blocks({before}));
    return idsOf(tracker.update(blocks({after}))).front() == 1;
  };
  EXPECT_TRUE(follows(small, {10, 10, 20, 20}));
  EXPECT_FALSE(follows(small, {10, 10, 20, 21}));
  EXPECT_TRUE(follows({10, 10, 20, 20}, small));
  EXPECT_FALSE(follows({10, 10, 20, 21}, small));
}

TEST(RegionTracker, GreatestOverlapWinsThoughItsCentroidIsFarther) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({{0, 0, 40, 40}}));
  // Concentric, IoU 0.36; or shifted by 1 m, IoU 30 / 50.
  Decomposition next = blocks({{8, 8, 24, 24}});
  next.regions.push_back(blocks({{10, 0, 40, 40}}).regions.front());
  next.regions.back().id = 2;
  const TrackedRegions& tracked = tracker.update(next);
  ASSERT_EQ(idsOf(tracked), (std::vector<int>{1, 2}));
  EXPECT_EQ(tracked.decomposition.regions[0].cells.min, (Cell{10, 0}));
}

TEST(RegionTracker, OneTrackIsContinuedByOneRegionOnly) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({{0, 0, 40, 40}}));
  const TrackedRegions& halves = tracker.update(blocks({{0, 0, 20, 40}, {20, 0, 20, 40}}));
  EXPECT_EQ(idsOf(halves), (std::vector<int>{1, 2}));
}

const Block kCorridor{0, 0, 240, 15};
const Block kLongPart{0, 0, 140, 15};
const Block kShortPart{140, 0, 100, 15};

// The centroids of the parts lie 5 m and 7 m from that of the whole.
TEST(RegionTracker, ACorridorCutInTwoLeavesItsIdToTheLongerPart) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kCorridor}));
  const TrackedRegions& parts = tracker.update(blocks({kShortPart, kLongPart}));
  ASSERT_EQ(idsOf(parts), (std::vector<int>{1, 2}));
  EXPECT_EQ(parts.decomposition.regions[0].cells.min, (Cell{0, 0}));
  EXPECT_EQ(parts.decomposition.regions[1].cells.min, (Cell{140, 0}));
  EXPECT_TRUE(parts.missed.empty());
}

TEST(RegionTracker, TwoRegionsThatMergeGoOnUnderTheIdOfTheLarger) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kShortPart, kLongPart}));
  const TrackedRegions& whole = tracker.update(blocks({kCorridor}));
  EXPECT_EQ(idsOf(whole), std::vector<int>{2});
  EXPECT_EQ(whole.missed, std::vector<int>{1});
}

TEST(RegionTracker, WhatPartsAgainSoonHasItsOldIds) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kShortPart, kLongPart}));
  for (int i = 0; i < 3; ++i) tracker.update(blocks({kCorridor}));
  const TrackedRegions& parts = tracker.update(blocks({kLongPart, kShortPart}));
  ASSERT_EQ(idsOf(parts), (std::vector<int>{1, 2}));
  EXPECT_EQ(parts.decomposition.regions[0].cells.min, (Cell{140, 0}));
}

TEST(RegionTracker, ACutIntoManyPartsLeavesTheIdToNone) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kCorridor}));
  std::vector<Block> fifths;
  for (int x = 0; x < 240; x += 48) fifths.push_back({x, 0, 48, 15});
  EXPECT_EQ(idsOf(tracker.update(blocks(fifths))), (std::vector<int>{2, 3, 4, 5, 6}));
}

TEST(RegionTracker, AnUnchangedRegionKeepsItsIdBesideOnesThatGrew) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft, kMiddle, kRight}));
  const Block towards_middle{91, 0, 49, 40};
  const TrackedRegions& tracked = tracker.update(blocks({towards_middle, kMiddle, {0, 0, 49, 40}}));
  ASSERT_EQ(idsOf(tracked), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(tracked.decomposition.regions[1].cells.min, (Cell{50, 0}));
  EXPECT_EQ(tracked.changed, (std::vector<int>{1, 3}));
}

TEST(RegionTracker, MatchedTrackTakesTheNewGeometry) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft}));
  for (int x = 10; x <= 50; x += 10) {  // Each step passes the gate, the whole way would not.
    const TrackedRegions& tracked = tracker.update(blocks({{x, 0}}));
    ASSERT_EQ(idsOf(tracked), std::vector<int>{1});
    EXPECT_EQ(tracked.decomposition.regions[0].cells.min.x, x);
  }
}

TEST(RegionTracker, AdjacencyAndCrossingsSpeakOfTracks) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kRight, kMiddle, kLeft}));  // Tracks 1, 2, 3 from right to left.
  Decomposition next = blocks({kLeft, kMiddle, kRight});
  next.regions[0].adjacent = {2};
  next.regions[1].adjacent = {1, 3};
  next.regions[2].adjacent = {2};
  next.crossings = {{1, 2, {{4.0, 1.0}, {5.0, 2.0}}}, {2, 3, {{9.0, 1.0}, {10.0, 2.0}}}};
  const Decomposition& tracked = tracker.update(next).decomposition;
  EXPECT_EQ(tracked.regions[0].adjacent, std::vector<int>{2});
  EXPECT_EQ(tracked.regions[1].adjacent, (std::vector<int>{1, 3}));
  ASSERT_EQ(tracked.crossings.size(), 2U);
  EXPECT_EQ(tracked.crossings[0].region_a, 1);
  EXPECT_EQ(tracked.crossings[0].region_b, 2);
  EXPECT_DOUBLE_EQ(tracked.crossings[0].segment.a.x, 9.0);
  EXPECT_EQ(tracked.crossings[1].region_a, 2);
  EXPECT_EQ(tracked.crossings[1].region_b, 3);
  EXPECT_EQ(tracked.labels.at({0, 0}), 3);
}

TEST(RegionTracker, RejectedUpdateRepeatsTheLastAcceptedStateAsStale) {
  RegionTracker tracker({});
  tracker.update(blocks({kLeft, kMiddle, kRight}));
  for (int i = 0; i < 5; ++i) {  // More often than a track may be missed.
    const TrackedRegions& tracked = tracker.update(blocks({kLeft}));
    EXPECT_TRUE(tracked.stale);
    EXPECT_EQ(idsOf(tracked), (std::vector<int>{1, 2, 3}));
    EXPECT_TRUE(tracked.missed.empty());
  }
  const TrackedRegions& back = tracker.update(blocks({kRight, kMiddle, kLeft}));
  EXPECT_FALSE(back.stale);
  EXPECT_EQ(idsOf(back), (std::vector<int>{1, 2, 3}));
}

TEST(RegionTracker, ResetStartsAtOneAgain) {
  RegionTracker tracker(unguarded());
  tracker.update(blocks({kLeft, kMiddle}));
  tracker.reset();
  EXPECT_TRUE(tracker.regions().decomposition.regions.empty());
  EXPECT_EQ(idsOf(tracker.update(blocks({kRight}))), std::vector<int>{1});
}

TEST(RegionTracker, RefusesParametersOutOfRange) {
  const auto refusal = [](auto change) {
    RegionTrackerConfig config;
    change(config);
    return sentenceOf([&] { RegionTracker tracker(config); });
  };
  EXPECT_TRUE(tells(refusal([](auto& config) { config.min_overlap = -0.1; }),
                    {"regions.tracker.min_overlap", "-0.1"}));
  EXPECT_TRUE(tells(refusal([](auto& config) { config.max_centroid_distance_m = std::nan(""); }),
                    {"regions.tracker.max_centroid_distance_m", "nan"}));
  EXPECT_TRUE(tells(refusal([](auto& config) { config.min_area_ratio = 2.0; }),
                    {"regions.tracker.min_area_ratio", "2"}));
  EXPECT_TRUE(tells(refusal([](auto& config) { config.max_area_ratio = 0.5; }),
                    {"regions.tracker.max_area_ratio", "0.5"}));
  EXPECT_TRUE(tells(refusal([](auto& config) { config.max_missed_updates = -1; }),
                    {"regions.tracker.max_missed_updates", "-1"}));
  EXPECT_TRUE(tells(refusal([](auto& config) { config.guard.max_area_drop = 2.0; }),
                    {"regions.guard.max_area_drop", "2"}));
}

TEST(RegionTracker, TellsWhichRegionsAreOthersThanBefore) {
  const Block grown_middle{50, 0, 44, 40};
  RegionTracker tracker(unguarded());
  EXPECT_EQ(tracker.update(blocks({kLeft, kMiddle})).changed, (std::vector<int>{1, 2}));
  const std::uint64_t update = tracker.regions().update;
  EXPECT_TRUE(tracker.update(blocks({kMiddle, kLeft})).changed.empty()) << "the order is no change";
  EXPECT_EQ(tracker.regions().update, update + 1);
  EXPECT_EQ(tracker.update(blocks({kLeft, grown_middle})).changed, (std::vector<int>{2}));
  EXPECT_EQ(tracker.update(blocks({kLeft})).changed, (std::vector<int>{2})) << "gone";
  EXPECT_TRUE(tracker.update(blocks({kLeft})).changed.empty()) << "gone before";
  EXPECT_EQ(tracker.update(blocks({kLeft, grown_middle})).changed, (std::vector<int>{2})) << "back";
}

}  // namespace
}  // namespace occusg
