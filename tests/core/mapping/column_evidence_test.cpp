// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/column_evidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mapping/voxel_run.hpp"
#include "occusg/error.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

using testing::freeColumn;
using testing::occupiedVoxel;

constexpr int kCeiling = 44;  // 2.2 m in voxels of 0.05 m
constexpr int kRoomHeight = 50;

/// Runs of one column from the lowest up: first voxel, voxel after the last.
struct DrawnColumn {
  std::vector<VoxelRun> free;
  std::vector<VoxelRun> occupied;
};

const DrawnColumn kOpenFloor{{{0, kRoomHeight}}, {{-1, 0}, {kRoomHeight, kRoomHeight + 1}}};

void insert(OccupancyMap& map, const Cell& cell, const DrawnColumn& column) {
  for (const VoxelRun& run : column.free) map.insert(freeColumn(cell, run.bottom, run.top));
  for (const VoxelRun& run : column.occupied)
    for (int z = run.bottom; z < run.top; ++z) map.insert(occupiedVoxel(cell, z));
}

/// A column in the middle of an open floor of 3 x 3 tiles.
ColumnEvidence evidenceOf(const DrawnColumn& column, const DrawnColumn& around = kOpenFloor) {
  constexpr Cell kMiddle{12, 12};
  OccupancyMap map{OccupancyMapConfig{}};
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) insert(map, {x, y}, Cell{x, y} == kMiddle ? column : around);
  return FreeSpaceLayer({}, GridFrame{0.05}).recompute(map).evidence.at(kMiddle);
}

TEST(ColumnEvidence, OpenFloorIsFreeUpToTheCeiling) {
  const ColumnEvidence evidence = evidenceOf(kOpenFloor);
  EXPECT_EQ(evidence.floor, 0);
  EXPECT_EQ(evidence.observed, 100);
  EXPECT_EQ(evidence.occupied, 0);
  EXPECT_EQ(evidence.free_in_body_band, 100);
  EXPECT_EQ(evidence.gap_bottom, 0);
  EXPECT_EQ(evidence.gap_top, kRoomHeight);
  EXPECT_EQ(evidence.overhead, Overhead::kOccupied);
}

TEST(ColumnEvidence, WallIsOccupiedOverItsWholeHeight) {
  const ColumnEvidence evidence = evidenceOf({{}, {{0, kRoomHeight}}});
  EXPECT_EQ(evidence.floor, 0);
  EXPECT_EQ(evidence.observed, 100);
  EXPECT_EQ(evidence.occupied, 100);
  EXPECT_EQ(evidence.free_in_body_band, 0);
  EXPECT_EQ(evidence.gapLength(), 0);
  EXPECT_EQ(evidence.overhead, Overhead::kUnknown);
}

TEST(ColumnEvidence, HalfSeenWallTellsHowMuchWasSeen) {
  const ColumnEvidence evidence = evidenceOf({{}, {{0, 22}}});
  EXPECT_EQ(evidence.observed, 50);
  EXPECT_EQ(evidence.occupied, 50);
}

TEST(ColumnEvidence, TableIsLowAndOpenAboveAndBelow) {
  // The top is 0.75 m high and a voxel thick; the floor below it was seen.
  const ColumnEvidence evidence =
      evidenceOf({{{0, 14}, {15, kRoomHeight}}, {{-1, 0}, {14, 15}, {kRoomHeight, 51}}});
  EXPECT_EQ(evidence.floor, 0);
  EXPECT_EQ(evidence.occupied, 100 * 1 / kCeiling);
  EXPECT_EQ(evidence.observed, 100);
  EXPECT_EQ(evidence.free_in_body_band, 100 * 23 / 24);  // 0.3 m to 1.5 m
  EXPECT_EQ(evidence.gap_bottom, 15);
  EXPECT_EQ(evidence.gap_top, kRoomHeight);
}

TEST(ColumnEvidence, TableWhoseUndersideWasNotSeenStandsOnTheFloorAroundIt) {
  const ColumnEvidence evidence = evidenceOf({{{15, kRoomHeight}}, {{14, 15}, {kRoomHeight, 51}}});
  EXPECT_EQ(evidence.floor, 0);
  EXPECT_EQ(evidence.observed, 100 * 30 / kCeiling);
  EXPECT_EQ(evidence.free_in_body_band, 100 * 15 / 24);
}

TEST(ColumnEvidence, CupboardIsOccupiedUpToItsTop) {
  // 1.8 m high, seen from the front and from above.
  const ColumnEvidence evidence = evidenceOf({{{36, kRoomHeight}}, {{0, 36}, {kRoomHeight, 51}}});
  EXPECT_EQ(evidence.floor, 0);
  EXPECT_EQ(evidence.occupied, 100 * 36 / kCeiling);
  EXPECT_EQ(evidence.free_in_body_band, 0);
  EXPECT_EQ(evidence.gap_bottom, 36);
  EXPECT_EQ(evidence.gapLength(), 14);
}

TEST(ColumnEvidence, DoorHasALintelAboveAFreeGap) {
  const ColumnEvidence evidence = evidenceOf({{{0, 40}}, {{-1, 0}, {40, kRoomHeight}}});
  EXPECT_EQ(evidence.occupied, 100 * 4 / kCeiling);
  EXPECT_EQ(evidence.free_in_body_band, 100);
  EXPECT_EQ(evidence.overhead, Overhead::kOccupied);
  EXPECT_EQ(evidence.gap_bottom, 0);
  EXPECT_EQ(evidence.gap_top, 40);  // 2 m
}

TEST(ColumnEvidence, WindowHasASillBelowTheGapAndALintelAbove) {
  const ColumnEvidence evidence = evidenceOf({{{18, 40}}, {{0, 18}, {40, kRoomHeight}}});
  EXPECT_EQ(evidence.occupied, 100 * 22 / kCeiling);
  EXPECT_EQ(evidence.free_in_body_band, 100 * 12 / 24);
  EXPECT_EQ(evidence.overhead, Overhead::kOccupied);
  EXPECT_EQ(evidence.gap_bottom, 18);
  EXPECT_EQ(evidence.gap_top, 40);
}

TEST(ColumnEvidence, GapBelowTheUnknownHasNoOverhead) {
  const ColumnEvidence evidence = evidenceOf({{{0, 30}}, {{-1, 0}}});
  EXPECT_EQ(evidence.gap_top, 30);
  EXPECT_EQ(evidence.overhead, Overhead::kUnknown);
}

TEST(ColumnEvidence, GapIsCountedUpToTwiceTheCeilingHeight) {
  const ColumnEvidence evidence = evidenceOf({{{0, 300}}, {{-1, 0}, {300, 301}}});
  EXPECT_EQ(evidence.gap_top, 2 * kCeiling);
  EXPECT_EQ(evidence.overhead, Overhead::kUnknown);
}

TEST(ColumnEvidence, HoleInTheFloorBelongsToTheStoreyItOpensIn) {
  // One column sees a floor 2.7 m further down.
  const ColumnEvidence evidence = evidenceOf({{{-54, kRoomHeight}}, {{-55, -54}}});
  EXPECT_EQ(evidence.floor, 0);
  EXPECT_EQ(evidence.observed, 100);
  EXPECT_EQ(evidence.gap_bottom, 0);
  EXPECT_EQ(evidence.gap_top, kRoomHeight);
}

TEST(ColumnEvidence, StairsStandOnTheLowestStepNearThem) {
  // Each tile of 0.4 m is a step of 0.2 m: within 1 m, the lowest is two steps down.
  OccupancyMap map{OccupancyMapConfig{}};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 64; ++x) {
      const int step = 4 * (x / 8);
      insert(map, {x, y}, {{{step, step + 50}}, {{step - 1, step}}});
    }
  const FreeSpace layer = FreeSpaceLayer({}, GridFrame{0.05}).recompute(map);
  for (int x = 0; x < 64; ++x)
    ASSERT_EQ(layer.evidence.at({x, 4}).floor, 4 * std::max(0, x / 8 - 2)) << x;
}

TEST(ColumnEvidence, UnobservedColumnHasNone) {
  EXPECT_EQ(evidenceOf({}), ColumnEvidence{});
  EXPECT_FALSE(evidenceOf({}).hasFloor());
}

TEST(ColumnEvidence, ColumnFarFromAnyFloorHasNone) {
  EXPECT_EQ(evidenceOf({{{0, 20}}, {{20, 40}}}, {{{0, 20}}, {}}), ColumnEvidence{});
}

TEST(ColumnEvidence, FollowsTheFloorWhenItIsSeenLater) {
  OccupancyMap map{OccupancyMapConfig{}};
  FreeSpaceLayer layer({}, GridFrame{0.05});
  (void)layer.update(map, map.insert(occupiedVoxel({3, 3}, 10)));
  EXPECT_FALSE(layer.freeSpace().evidence.at({3, 3}).hasFloor());
  for (int x = 8; x < 16; ++x) {
    (void)layer.update(map, map.insert(freeColumn({x, 3}, 0, 20)));
    (void)layer.update(map, map.insert(occupiedVoxel({x, 3}, -1)));
  }
  EXPECT_EQ(layer.freeSpace().evidence.at({3, 3}).floor, 0);
  EXPECT_EQ(layer.freeSpace().evidence.at({3, 3}).occupied, 100 * 1 / kCeiling);
}

std::string refusal(const ColumnEvidenceConfig& evidence) {
  FreeSpaceLayerConfig config;
  config.evidence = evidence;
  try {
    const FreeSpaceLayer layer(config, GridFrame{0.05});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ColumnEvidence, RefusesHeightsOutOfOrder) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal({2.2, 0.3, 1.5}), "");
  for (const double ceiling : {0.0, -1.0, inf, nan})
    EXPECT_EQ(refusal({ceiling, 0.3, 1.5}).rfind("mapping.evidence.ceiling_height_m: is ", 0), 0U)
        << ceiling;
  EXPECT_EQ(refusal({2.2, -0.1, 1.5}).rfind("mapping.evidence.body_bottom_m: is ", 0), 0U);
  EXPECT_EQ(refusal({2.2, 1.5, 1.5}).rfind("body_bottom_m: is ", 0), 0U);
  EXPECT_EQ(refusal({2.2, nan, 1.5}).rfind("mapping.evidence.body_bottom_m: is ", 0), 0U);
  EXPECT_EQ(refusal({2.2, 0.3, 2.3}).rfind("body_top_m: is ", 0), 0U);
}

}  // namespace
}  // namespace occusg
