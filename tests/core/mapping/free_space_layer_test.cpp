// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/free_space_layer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "occusg/error.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

using testing::freeColumn;
using testing::insertSlice;
using testing::occupiedVoxel;
using testing::randomCloud;
using testing::scanOfBox;
using testing::withMisses;

const GridFrame kFrame{0.05};
constexpr double kInf = std::numeric_limits<double>::infinity();

OccupancyMap emptyMap() { return OccupancyMap{OccupancyMapConfig{}}; }

FreeSpace layerOf(const OccupancyMap& map, const FreeSpaceLayerConfig& config = {}) {
  return FreeSpaceLayer(config, kFrame).recompute(map);
}

int valueAt(const FreeSpace& layer, const Cell& cell) {
  return layer.cells.valueOr(cell, kUnknown);
}

/// One slice of a map, the rest unknown, as values along x.
std::vector<int> valuesOfSlice(const std::vector<std::string>& rows,
                               const FreeSpaceLayerConfig& config = {}) {
  OccupancyMap map = emptyMap();
  insertSlice(map, rows);
  const FreeSpace layer = layerOf(map, config);
  std::vector<int> values;
  for (int x = 0; x < static_cast<int>(rows[0].size()); ++x)
    values.push_back(valueAt(layer, {x, 0}));
  return values;
}

/// A free column of height `neighbour` beside one of which `occupied` voxels from below are hit.
int levelOf(int occupied, int neighbour, const FreeSpaceLayerConfig& config = {}) {
  OccupancyMap map = emptyMap();
  map.insert(freeColumn({0, 0}, 0, neighbour));
  for (int z = 0; z < occupied; ++z) map.insert(occupiedVoxel({1, 0}, z));
  return valueAt(layerOf(map, config), {1, 0});
}

TEST(FreeSpaceLayer, RunOfSixVoxelsIsFreeAndOfFiveIsNot) {
  for (const int voxels : {5, 6, 7}) {
    OccupancyMap map = emptyMap();
    map.insert(freeColumn({0, 0}, 10, 10 + voxels));
    EXPECT_EQ(valueAt(layerOf(map), {0, 0}), voxels < 6 ? kUnknown : kFree) << voxels;
  }
}

TEST(FreeSpaceLayer, FigureCasesOpenFurnitureWallAndBeam) {
  // Columns from the left: open, low furniture, full wall, overhead beam, open.
  const std::vector<std::string> rows = {
      "######",  //
      "..#.#.", "..#.#.", "..#.#.", "..#...", "..#...", "..#...", "..#...",
      "..#...", "..#...", "..#...", ".##...", ".##...", ".##...", "######",
  };
  EXPECT_EQ(valuesOfSlice(rows), (std::vector<int>{kFree, kFree, 100, kFree, kFree, kFree}));
}

TEST(FreeSpaceLayer, GapIsAWholeNumberOfVoxelsWhateverTheDivisionRoundsTo) {
  for (int voxels = 1; voxels <= 40; ++voxels) {
    FreeSpaceLayerConfig config;
    config.min_free_gap_m = voxels * 0.05;
    OccupancyMap map = emptyMap();
    map.insert(freeColumn({0, 0}, 0, voxels));
    map.insert(freeColumn({5, 0}, 0, voxels + 1));
    if (voxels > 1) map.insert(freeColumn({10, 0}, 0, voxels - 1));
    const FreeSpace layer = layerOf(map, config);
    EXPECT_EQ(valueAt(layer, {0, 0}), kFree) << voxels;
    EXPECT_EQ(valueAt(layer, {5, 0}), kFree) << voxels;
    EXPECT_EQ(valueAt(layer, {10, 0}), kUnknown) << voxels;
  }
}

TEST(FreeSpaceLayer, OccupiedOrUnknownVoxelEndsTheRun) {
  EXPECT_EQ(valuesOfSlice({"...", "...", "...", ".# ", "...", "...", "..."}),
            (std::vector<int>{kFree, 28, kUnknown}));
}

TEST(FreeSpaceLayer, TableIsFreeAndWallToTheCeilingIsFull) {
  OccupancyMap map = emptyMap();
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 6; ++y) {
      const bool table = x >= 3 && x < 7;
      const bool wall = x == 11;
      const int bottom = wall ? 50 : table ? 16 : 0;  // the table is 0.8 m high
      for (int z = 0; z < bottom; ++z) map.insert(occupiedVoxel({x, y}, z));
      if (!wall) map.insert(freeColumn({x, y}, bottom, 50));
    }
  const FreeSpace layer = layerOf(map);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 11; ++x) EXPECT_EQ(valueAt(layer, {x, y}), kFree) << x << ", " << y;
    EXPECT_EQ(valueAt(layer, {11, y}), kFullObstacle) << y;
  }
}

TEST(FreeSpaceLayer, ObstacleLevelIsTwiceTheFilledShare) {
  EXPECT_EQ(levelOf(2, 50), 8);
  EXPECT_EQ(levelOf(12, 50), 48);
  EXPECT_EQ(levelOf(24, 50), 96);
  EXPECT_EQ(levelOf(25, 50), 100);
  EXPECT_EQ(levelOf(50, 50), 100);
  EXPECT_EQ(levelOf(1, 7), 28);  // 2 * floor(100 / 7)
}

TEST(FreeSpaceLayer, WeakObstacleIsUnknown) {
  FreeSpaceLayerConfig config;
  config.min_obstacle_level = 8;
  EXPECT_EQ(levelOf(2, 50, config), 8);
  config.min_obstacle_level = 9;
  EXPECT_EQ(levelOf(2, 50, config), kUnknown);
}

TEST(FreeSpaceLayer, ObstacleOfLevelZeroIsUnknownNotFree) {
  FreeSpaceLayerConfig config;
  config.min_obstacle_level = 0;
  EXPECT_EQ(levelOf(0, 50, config), kUnknown);
  EXPECT_EQ(levelOf(1, 101, config), kUnknown);  // floor(100 / 101) is zero
  EXPECT_EQ(levelOf(1, 50, config), 4);
}

TEST(FreeSpaceLayer, ObstacleLevelCountsAgainstTheLowestRunThatIsLongEnough) {
  OccupancyMap map = emptyMap();
  map.insert(freeColumn({0, 0}, 0, 4));    // too short to count
  map.insert(freeColumn({0, 0}, 10, 20));  // the run that counts
  map.insert(freeColumn({0, 0}, 30, 60));
  for (const int z : {0, 1, 2, 10, 11, 40, 41}) map.insert(occupiedVoxel({1, 0}, z));
  EXPECT_EQ(valueAt(layerOf(map), {1, 0}), 40);
}

TEST(FreeSpaceLayer, ObstacleLevelIsTheLargestOverAllEightNeighbours) {
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy) {
      if (dx == 0 && dy == 0) continue;
      OccupancyMap map = emptyMap();
      map.insert(occupiedVoxel({0, 0}, 5));
      map.insert(freeColumn({dx, dy}, 0, 10));
      map.insert(freeColumn({-dx, -dy}, 0, 40));
      const FreeSpace layer = layerOf(map);
      EXPECT_EQ(valueAt(layer, {0, 0}), 20) << dx << ", " << dy;
      EXPECT_EQ(valueAt(layer, {dx, dy}), kFree);
    }
}

TEST(FreeSpaceLayer, OccupiedColumnWithoutFreeNeighbourIsUnknown) {
  OccupancyMap map = emptyMap();
  for (int z = 0; z < 40; ++z) map.insert(occupiedVoxel({2, 0}, z));
  map.insert(freeColumn({0, 0}, 0, 40));
  EXPECT_EQ(valueAt(layerOf(map), {2, 0}), kUnknown);
}

TEST(FreeSpaceLayer, HeightLimitsCutTheColumn) {
  // A window: 1 m of sill, 1 m of opening, and wall above.
  OccupancyMap map = emptyMap();
  map.insert(freeColumn({0, 0}, 0, 50));
  map.insert(freeColumn({1, 0}, 20, 40));
  for (int z = 0; z < 50; ++z)
    if (z < 20 || z >= 40) map.insert(occupiedVoxel({1, 0}, z));
  EXPECT_EQ(valueAt(layerOf(map), {1, 0}), kFree);
  FreeSpaceLayerConfig config;
  config.highest_z_m = 1.25;
  EXPECT_EQ(valueAt(layerOf(map, config), {1, 0}), kFullObstacle);  // 0.25 m of opening left
  config.highest_z_m = 1.30;
  EXPECT_EQ(valueAt(layerOf(map, config), {1, 0}), kFree);
  config.lowest_z_m = 1.75;
  config.highest_z_m = 2.30;
  EXPECT_EQ(valueAt(layerOf(map, config), {1, 0}), kFullObstacle);
}

TEST(FreeSpaceLayer, OnlyVoxelsWhollyBetweenTheLimitsCount) {
  OccupancyMap map = emptyMap();
  map.insert(freeColumn({0, 0}, -20, 20));
  FreeSpaceLayerConfig config;
  config.lowest_z_m = -0.15;
  config.highest_z_m = 0.15;
  EXPECT_EQ(valueAt(layerOf(map, config), {0, 0}), kFree);
  config.lowest_z_m = -0.14;
  config.highest_z_m = 0.21;
  EXPECT_EQ(valueAt(layerOf(map, config), {0, 0}), kFree);
  config.min_free_gap_m = 0.35;
  EXPECT_THROW(layerOf(map, config), Error);  // six whole voxels, seven wanted
}

TEST(FreeSpaceLayer, PrunedLeafCountsForEveryColumnItCovers) {
  OccupancyMapConfig config;
  config.resolution_m = 0.1;
  OccupancyMap map(config);
  std::mt19937 random(1);
  for (int frame = 0; frame < 12; ++frame)
    map.insert(scanOfBox({1.6F, 1.6F, 1.6F}, {{0, 0, 0}, {3.2F, 3.2F, 3.2F}}, 20000, random));
  unsigned shallowest = 16;
  for (auto leaf = map.tree().begin_leafs(); leaf != map.tree().end_leafs(); ++leaf)
    shallowest = std::min(shallowest, leaf.getDepth());
  ASSERT_LT(shallowest, 14U) << "the scene is meant to be pruned";
  const FreeSpace layer = FreeSpaceLayer({}, GridFrame{0.1}).recompute(map);
  for (int x = 1; x < 31; ++x)
    for (int y = 1; y < 31; ++y) EXPECT_EQ(valueAt(layer, {x, y}), kFree) << x << ", " << y;
}

TEST(FreeSpaceLayer, BoxIsTheKnownColumnsWidenedToItsStep) {
  OccupancyMap map = emptyMap();
  EXPECT_TRUE(layerOf(map).cells.empty());
  map.insert(occupiedVoxel({-1, 63}, 0));
  EXPECT_EQ(layerOf(map).cells.box(), (CellBox{{-64, 0}, {0, 64}}));
  map.insert(occupiedVoxel({64, 64}, 0));
  EXPECT_EQ(layerOf(map).cells.box(), (CellBox{{-64, 0}, {128, 128}}));
  map.insert(occupiedVoxel({-65, -64}, 0));
  EXPECT_EQ(layerOf(map).cells.box(), (CellBox{{-128, -64}, {128, 128}}));
}

TEST(FreeSpaceLayer, ChangedBoundsTheCellsThatDifferFromThePreviousUpdate) {
  OccupancyMap map = emptyMap();
  FreeSpaceLayer layer({}, kFrame);
  EXPECT_EQ(layer.update(map, map.insert(freeColumn({2, 3}, 0, 20))).changed,
            (CellBox{{2, 3}, {3, 4}}));
  EXPECT_TRUE(layer.update(map, map.insert(freeColumn({2, 3}, 0, 20))).changed.empty());
  // Known voxels, but no value: nothing differs, though the box grows.
  EXPECT_TRUE(layer.update(map, map.insert(occupiedVoxel({200, 3}, 0))).changed.empty());
  // A longer free run weakens the obstacle beside it.
  (void)layer.update(map, map.insert(occupiedVoxel({3, 4}, 0)));
  EXPECT_EQ(valueAt(layer.freeSpace(), {3, 4}), 10);
  EXPECT_EQ(layer.update(map, map.insert(freeColumn({2, 3}, 20, 30))).changed,
            (CellBox{{3, 4}, {4, 5}}));
  EXPECT_EQ(valueAt(layer.freeSpace(), {3, 4}), 6);
}

TEST(FreeSpaceLayer, ChangedOfRecomputeIsAgainstTheLayerBefore) {
  OccupancyMap map = emptyMap();
  FreeSpaceLayer layer({}, kFrame);
  map.insert(freeColumn({2, 3}, 0, 20));
  EXPECT_EQ(layer.recompute(map).changed, (CellBox{{2, 3}, {3, 4}}));
  EXPECT_TRUE(layer.recompute(map).changed.empty());
  map.reset();
  EXPECT_EQ(layer.recompute(map).changed, (CellBox{{2, 3}, {3, 4}}));
  EXPECT_TRUE(layer.freeSpace().cells.empty());
}

/// Bounds of the cells whose gap or overhead differs.
CellBox differingGaps(const FreeSpace& a, const FreeSpace& b) {
  const CellBox box = a.cells.box().including(b.cells.box());
  CellBox differing;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (!haveSameGap(a.evidence.at({x, y}), b.evidence.at({x, y})))
        differing = differing.including(Cell{x, y});
  return differing;
}

/// Updates a layer frame by frame; each time it must equal the layer recomputed from the map.
void expectUpdatesEqualRecompute(const std::vector<PointCloud>& frames,
                                 const OccupancyMapConfig& map_config,
                                 const FreeSpaceLayerConfig& config, const HeightSpan& span = {}) {
  const GridFrame frame{map_config.resolution_m};
  OccupancyMap map(map_config);
  FreeSpaceLayer updated(config, frame);
  updated.confine(map, span);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    const FreeSpace before = updated.freeSpace();
    FreeSpaceLayer oracle = updated;
    const FreeSpace& by_update = updated.update(map, map.insert(frames[i]));
    const FreeSpace& from_scratch = oracle.recompute(map);
    ASSERT_TRUE(by_update.cells == from_scratch.cells);
    ASSERT_TRUE(by_update.evidence == from_scratch.evidence);
    ASSERT_EQ(by_update.changed, from_scratch.changed);
    const CellBox gaps = differingGaps(before, by_update);
    ASSERT_EQ(by_update.gaps_changed.including(gaps), by_update.gaps_changed);
    ASSERT_EQ(from_scratch.gaps_changed.including(gaps), from_scratch.gaps_changed);
  }
}

TEST(FreeSpaceLayer, UpdatesEqualRecomputeCellForCell) {
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    OccupancyMapConfig map_config;
    map_config.max_range_m = 1.0;
    FreeSpaceLayerConfig config;
    config.min_free_gap_m = seed % 2 == 0 ? 0.05 : 0.15;
    if (seed % 3 == 0) {
      config.lowest_z_m = -0.3;
      config.highest_z_m = 0.4;
    }
    if (seed > 4) {
      config.height_reference = HeightReference::kLocalFloor;
      config.evidence = {0.4, 0.1, 0.3};
    }
    std::vector<PointCloud> frames;
    for (int frame = 0; frame < 24; ++frame) {
      // Surfaces move and come back, so columns turn from free to occupied and back.
      if (frame % 4 == 3)
        frames.push_back(frames[random() % frames.size()]);
      else
        frames.push_back(withMisses(randomCloud(40, random), 4));
    }
    expectUpdatesEqualRecompute(frames, map_config, config);
  }
}

TEST(FreeSpaceLayer, UpdatesEqualRecomputeInARoomWhoseWallMoves) {
  std::mt19937 random(11);
  OccupancyMapConfig map_config;
  map_config.resolution_m = 0.1;
  FreeSpaceLayerConfig config;
  config.lowest_z_m = 0.2;
  config.highest_z_m = 1.8;
  std::vector<PointCloud> frames;
  for (int frame = 0; frame < 24; ++frame) {
    const testing::Box3 room = {{-4.1F, -1.3F, 0.0F},
                                {3.0F + 0.1F * static_cast<float>(frame % 9), 1.7F, 2.4F}};
    frames.push_back(scanOfBox({-1.0F, 0.1F, 1.2F}, room, 3000, random));
  }
  expectUpdatesEqualRecompute(frames, map_config, config);
  config.height_reference = HeightReference::kLocalFloor;
  expectUpdatesEqualRecompute(frames, map_config, config);
}

TEST(FreeSpaceLayer, UpdatesOfAStoreyEqualItsRecompute) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    OccupancyMapConfig map_config;
    map_config.max_range_m = 1.5;
    std::vector<PointCloud> frames;
    for (int frame = 0; frame < 24; ++frame)
      frames.push_back(withMisses(randomCloud(60, random), 4));
    expectUpdatesEqualRecompute(frames, map_config, {}, {0.1, seed % 2 == 0 ? 0.6 : kInf});
  }
}

TEST(FreeSpaceLayer, ConfinedLayerShowsOneStorey) {
  OccupancyMap map = emptyMap();
  // A slab at voxel 30 with a hole in its middle, free space below and above it.
  insertSlice(map, std::vector<std::string>(30, "......"), 0, 0);
  insertSlice(map, {"##..##"}, 0, 30);
  insertSlice(map, std::vector<std::string>(30, "......"), 0, 31);
  FreeSpaceLayer upper({}, kFrame);
  const FreeSpace& layer = upper.confine(map, {1.4, kInf});
  EXPECT_EQ(valueAt(layer, {0, 0}), kFree);
  EXPECT_EQ(valueAt(layer, {5, 0}), kFree);
  EXPECT_NE(valueAt(layer, {2, 0}), kFree);
  EXPECT_NE(valueAt(layer, {3, 0}), kFree);
}

TEST(FreeSpaceLayer, HeightLimitsFollowTheLocalFloor) {
  // Two storeys' worth of steps: a floor at 0 m, one at 3 m, and a beam 1.5 m above each.
  OccupancyMap map = emptyMap();
  const auto addFloor = [&map](int first_x, int floor) {
    for (int x = first_x; x < first_x + 16; ++x)
      for (int y = 0; y < 16; ++y) {
        const bool is_under_beam = x == first_x + 8;
        map.insert(occupiedVoxel({x, y}, floor - 1));
        map.insert(freeColumn({x, y}, floor, floor + (is_under_beam ? 30 : 50)));
        if (is_under_beam) map.insert(occupiedVoxel({x, y}, floor + 30));
      }
  };
  addFloor(0, 0);
  addFloor(64, 60);
  FreeSpaceLayerConfig config;
  config.lowest_z_m = 1.25;
  config.highest_z_m = 1.55;
  const FreeSpace by_map = layerOf(map, config);
  EXPECT_EQ(valueAt(by_map, {4, 4}), kFree);
  EXPECT_NE(valueAt(by_map, {8, 4}), kFree);
  EXPECT_EQ(valueAt(by_map, {68, 4}), kUnknown);
  config.height_reference = HeightReference::kLocalFloor;
  const FreeSpace by_floor = layerOf(map, config);
  for (const int x : {0, 64}) {
    EXPECT_EQ(valueAt(by_floor, {x + 4, 4}), kFree) << x;
    EXPECT_NE(valueAt(by_floor, {x + 8, 4}), kFree) << x;
  }
}

TEST(FreeSpaceLayer, WithoutAFloorAllHeightsCount) {
  OccupancyMap map = emptyMap();
  map.insert(freeColumn({0, 0}, 200, 206));
  FreeSpaceLayerConfig config;
  config.lowest_z_m = 0.0;
  config.highest_z_m = 1.0;
  EXPECT_EQ(valueAt(layerOf(map, config), {0, 0}), kUnknown);
  config.height_reference = HeightReference::kLocalFloor;
  EXPECT_EQ(valueAt(layerOf(map, config), {0, 0}), kFree);
}

TEST(FreeSpaceLayer, ResetForgetsTheLayer) {
  OccupancyMap map = emptyMap();
  FreeSpaceLayer layer({}, kFrame);
  (void)layer.update(map, map.insert(freeColumn({2, 3}, 0, 20)));
  layer.reset();
  EXPECT_TRUE(layer.freeSpace().cells.empty());
  EXPECT_EQ(layer.freeSpace().frame.resolution_m, 0.05);
}

std::string refusal(const FreeSpaceLayerConfig& config, const GridFrame& frame = kFrame) {
  try {
    const FreeSpaceLayer layer(config, frame);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FreeSpaceLayer, RefusesAConfigurationOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal({0.3, 101, -kInf, kInf}),
            "mapping.free_space.min_obstacle_level: is 101; allowed is [0, 100]");
  EXPECT_EQ(refusal({0.3, -1, -kInf, kInf}).rfind("mapping.free_space.min_obstacle_level: ", 0),
            0U);
  for (const double gap : {0.0, -1.0, 101.0, nan, kInf})
    EXPECT_EQ(refusal({gap, 5, -kInf, kInf}).rfind("mapping.free_space.min_free_gap_m: is ", 0), 0U)
        << gap;
  EXPECT_EQ(refusal({0.3, 5, nan, kInf}).rfind("mapping.free_space.lowest_z_m: ", 0), 0U);
  EXPECT_EQ(refusal({0.3, 5, 0.0, nan}).rfind("mapping.free_space.highest_z_m: ", 0), 0U);
  EXPECT_EQ(refusal({0.3, 5, 0.0, 0.25}).rfind("highest_z_m: is 0.25", 0), 0U);
  EXPECT_EQ(refusal({0.3, 5, kInf, kInf}).rfind("highest_z_m: ", 0), 0U);
  EXPECT_EQ(refusal({0.3, 5, 1.0, -1.0}).rfind("highest_z_m: ", 0), 0U);
  EXPECT_EQ(refusal({0.3, 5, 0.0, 0.3}), "");
  EXPECT_EQ(refusal({}, GridFrame{0.0}).rfind("resolution_m: ", 0), 0U);
}

TEST(FreeSpaceLayer, RefusesAMapOfAnotherResolution) {
  OccupancyMap map = emptyMap();
  FreeSpaceLayer layer({}, GridFrame{0.1});
  EXPECT_THROW(layer.update(map, MapChange{}), Error);
  EXPECT_THROW(layer.recompute(map), Error);
}

TEST(FreeSpaceLayer, RefusesAMapThatSpansTooFarAndStaysAsItWas) {
  OccupancyMap map = emptyMap();
  FreeSpaceLayer layer({}, kFrame);
  const FreeSpace before = layer.update(map, map.insert(freeColumn({2, 3}, 0, 20)));
  const MapChange far = map.insert(freeColumn({30000, 30000}, 0, 20));
  EXPECT_THROW(layer.update(map, far), Error);
  EXPECT_THROW(layer.recompute(map), Error);
  EXPECT_TRUE(layer.freeSpace().cells == before.cells);
  EXPECT_EQ(layer.freeSpace().changed, before.changed);
}

}  // namespace
}  // namespace occusg
