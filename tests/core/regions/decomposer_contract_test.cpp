// SPDX-License-Identifier: BSD-3-Clause
// What every decomposer promises, whatever its method. A new one joins by a line in
// `Implementations` and a specialisation of makeDecomposer().
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "drawn_grid.hpp"
#include "equal_decompositions.hpp"
#include "floor_plans.hpp"
#include "geometry/cell_outline.hpp"
#include "occusg/regions/constriction_decomposer.hpp"
#include "occusg/regions/decomposer.hpp"
#include "occusg/regions/dude_decomposer.hpp"
#include "occusg/regions/label_regions.hpp"

namespace occusg {
namespace {

using testing::expectEqual;

/// Free space that hangs together over less may be dropped.
constexpr double kLargestSpeck_m2 = 1.0;

using testing::drawn;
using testing::fill;
using testing::moved;
using testing::randomFloorPlan;
using testing::randomNoise;
using testing::solid;
using testing::twoRooms;

template <typename Implementation>
std::unique_ptr<Decomposer> makeDecomposer();

template <>
std::unique_ptr<Decomposer> makeDecomposer<ConstrictionDecomposer>() {
  // What is left out as too narrow or outside is tested in constriction_decomposer_test.cpp.
  ConstrictionDecomposerConfig config;
  config.min_region_area_m2 = kLargestSpeck_m2;
  config.min_room_width_m = 0.0;
  config.min_enclosed_share = 0.0;
  return std::make_unique<ConstrictionDecomposer>(config);
}

template <>
std::unique_ptr<Decomposer> makeDecomposer<DudeDecomposer>() {
  DudeDecomposerConfig config;
  config.depth_threshold_m = 1.5;  // the value of the paper
  config.max_ignored_hole_m = 1.0;
  config.min_region_area_m2 = kLargestSpeck_m2;
  return std::make_unique<DudeDecomposer>(config);
}

using Implementations = ::testing::Types<ConstrictionDecomposer, DudeDecomposer>;

bool isFree(const FreeSpace& layer, const Cell& cell) {
  return layer.cells.valueOr(cell, kUnknown) == kFree;
}

template <typename Visitor>
void forCells(const CellBox& box, const Visitor& visitor) {
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) visitor(Cell{x, y});
}

/// Every free cell has a label, or lies in a piece of free space smaller than a speck.
void expectFreeSpaceCovered(const FreeSpace& layer, const Decomposition& result) {
  Grid<std::int32_t> free(layer.cells.box(), kNoRegion);
  forCells(layer.cells.box(), [&](const Cell& c) { free.at(c) = isFree(layer, c) ? 1 : 0; });
  const Grid<std::int32_t> pieces = numberedPieces(free);
  std::map<std::int32_t, std::size_t> cells;
  std::set<std::int32_t> uncovered;
  forCells(layer.cells.box(), [&](const Cell& cell) {
    const std::int32_t piece = pieces.at(cell);
    ++cells[piece];
    if (result.labels.valueOr(cell, kNoRegion) == kNoRegion) uncovered.insert(piece);
  });
  uncovered.erase(kNoRegion);
  for (const std::int32_t piece : uncovered)
    EXPECT_LT(static_cast<double>(cells[piece]) * layer.frame.cellArea(), kLargestSpeck_m2);
}

/// How an island, whose cells are labelled although they are not free, lies among the regions.
enum class Islands {
  kInsideOneRegion,  ///< Its surroundings carry one label.
  kShared,           ///< A cut may run through it, but no cell beside it is without a label.
};

template <typename Implementation>
constexpr Islands kIslands = Islands::kInsideOneRegion;
template <>
constexpr Islands kIslands<DudeDecomposer> = Islands::kShared;

void expectOnlyEnclosedIslandsFilled(const FreeSpace& layer, const Decomposition& result,
                                     Islands islands) {
  forCells(result.labels.box(), [&](const Cell& cell) {
    const std::int32_t label = result.labels.at(cell);
    if (label == kNoRegion || isFree(layer, cell)) return;
    for (const Cell side : {Cell{cell.x + 1, cell.y}, Cell{cell.x - 1, cell.y},
                            Cell{cell.x, cell.y + 1}, Cell{cell.x, cell.y - 1}}) {
      const std::int32_t beside = result.labels.valueOr(side, kNoRegion);
      EXPECT_NE(beside, kNoRegion) << cell.x << ", " << cell.y;
      const bool may_differ = islands == Islands::kShared;
      EXPECT_TRUE(may_differ || beside == label) << cell.x << ", " << cell.y;
    }
  });
}

/// Polygons, areas, centroids and bounds say what the labels say.
void expectRegionsMatchLabels(const Decomposition& result) {
  std::vector<std::size_t> cells(result.regions.size() + 1, 0);
  forCells(result.labels.box(), [&](const Cell& cell) {
    const std::int32_t label = result.labels.at(cell);
    ASSERT_GE(label, 0);
    ASSERT_LE(label, static_cast<std::int32_t>(result.regions.size()));
    ++cells[label];
    if (label == kNoRegion) return;
    EXPECT_TRUE(result.regions[label - 1].cells.contains(cell));
  });
  for (std::size_t i = 0; i < result.regions.size(); ++i) {
    const Region& region = result.regions[i];
    SCOPED_TRACE("region " + std::to_string(region.id));
    EXPECT_EQ(region.id, static_cast<int>(i) + 1);
    EXPECT_TRUE(isSimple(region.polygon));
    EXPECT_GT(signedArea(region.polygon.outer), 0.0);
    const auto count = static_cast<double>(cells[region.id]);
    EXPECT_NEAR(region.area_m2, count * result.frame.cellArea(), 1e-9);
    EXPECT_NEAR(region.area_m2, area(region.polygon), 1e-6);
    EXPECT_NEAR(distance(region.centroid, centroid(region.polygon)), 0.0, 1e-6);
    // One outline of a set whose area is the area of the label's cells: exactly those cells.
    const auto outlines = outlinesOf(result.labels, region.id, region.cells);
    ASSERT_EQ(outlines.size(), 1U);
    const Polygon expected = toPolygon(outlines.front(), result.frame);
    EXPECT_EQ(region.polygon.outer, expected.outer);
    EXPECT_EQ(region.polygon.holes, expected.holes);
  }
}

void expectAdjacencyMatchesCrossings(const Decomposition& result) {
  std::set<std::pair<int, int>> crossed;
  for (const Crossing& crossing : result.crossings) {
    ASSERT_LT(crossing.region_a, crossing.region_b);
    ASSERT_LE(crossing.region_b, static_cast<int>(result.regions.size()));
    EXPECT_GT(length(crossing.segment), 0.0);
    crossed.emplace(crossing.region_a, crossing.region_b);
    crossed.emplace(crossing.region_b, crossing.region_a);
  }
  std::set<std::pair<int, int>> adjacent;
  for (const Region& region : result.regions) {
    EXPECT_TRUE(std::is_sorted(region.adjacent.begin(), region.adjacent.end()));
    for (const int other : region.adjacent)
      EXPECT_TRUE(adjacent.emplace(region.id, other).second) << "named twice";
  }
  EXPECT_EQ(adjacent, crossed);
}

void expectContract(const FreeSpace& layer, const Decomposition& result, Islands islands) {
  EXPECT_DOUBLE_EQ(result.frame.resolution_m, layer.frame.resolution_m);
  expectFreeSpaceCovered(layer, result);
  expectOnlyEnclosedIslandsFilled(layer, result, islands);
  expectRegionsMatchLabels(result);
  expectAdjacencyMatchesCrossings(result);
}

template <typename Implementation>
class DecomposerContract : public ::testing::Test {
 protected:
  const Decomposition& decompose(const FreeSpace& layer) { return decomposer_->update(layer); }
  std::unique_ptr<Decomposer> decomposer_ = makeDecomposer<Implementation>();
};
TYPED_TEST_SUITE(DecomposerContract, Implementations);

TYPED_TEST(DecomposerContract, NoCellsGiveNoRegions) {
  EXPECT_TRUE(this->decompose(FreeSpace{}).regions.empty());
  EXPECT_TRUE(this->decompose(FreeSpace{}).labels.empty());
}

TYPED_TEST(DecomposerContract, FailureMode13NothingFreeGivesNoRegions) {
  for (const std::int8_t value : {kUnknown, kFullObstacle, std::int8_t{1}}) {
    FreeSpace layer = solid(2.0, 3.0);
    fill(layer, 0.0, 0.0, 2.0, 3.0, value);
    const Decomposition& result = this->decompose(layer);
    EXPECT_TRUE(result.regions.empty());
    EXPECT_TRUE(result.crossings.empty());
  }
}

TYPED_TEST(DecomposerContract, FailureMode13AllFreeIsOneRectangle) {
  FreeSpace layer = solid(3.0, 2.0);
  fill(layer, 0.0, 0.0, 3.0, 2.0);
  const Decomposition& result = this->decompose(layer);
  ASSERT_EQ(result.regions.size(), 1U);
  EXPECT_NEAR(result.regions[0].area_m2, 6.0, 1e-9);
  EXPECT_EQ(result.regions[0].polygon.outer.size(), 4U);
  expectContract(layer, result, kIslands<TypeParam>);
}

TYPED_TEST(DecomposerContract, FailureMode13SingleCellAndCheckerboardAndThinLinesAreDefined) {
  const std::vector<std::vector<std::string>> drawings{
      {"."},
      {"#.#", ".#.", "#.#"},
      {"....................................................."},
      {"#...#", "#.#.#", "#...#"},
      {".", ".", ".", ".", "."},
      {".#.#.#.#", "#.#.#.#.", ".#.#.#.#", "#.#.#.#."},
  };
  for (const auto& drawing : drawings) {
    SCOPED_TRACE(drawing.front());
    const FreeSpace layer = drawn(drawing);
    expectContract(layer, this->decompose(layer), kIslands<TypeParam>);
  }
}

TYPED_TEST(DecomposerContract, FailureMode13CombIsDefined) {
  FreeSpace layer = solid(12.0, 5.0);
  fill(layer, 0.5, 0.5, 11.5, 1.5);
  for (double x = 0.5; x < 11.0; x += 1.0) fill(layer, x, 1.5, x + 0.5, 4.5);
  const Decomposition& result = this->decompose(layer);
  EXPECT_FALSE(result.regions.empty());
  expectContract(layer, result, kIslands<TypeParam>);
}

TYPED_TEST(DecomposerContract, FailureMode13SpiralIsDefined) {
  FreeSpace layer = solid(16.0, 16.0);
  for (double inset = 0.5; inset < 7.0; inset += 2.0) {
    const double far = 16.0 - inset;
    fill(layer, inset, inset, far, inset + 1.0);
    fill(layer, far - 1.0, inset, far, far);
    fill(layer, inset + 2.0, far - 1.0, far, far);
    fill(layer, inset + 2.0, inset + 2.0, inset + 3.0, far);
  }
  const Decomposition& result = this->decompose(layer);
  EXPECT_FALSE(result.regions.empty());
  expectContract(layer, result, kIslands<TypeParam>);
}

TYPED_TEST(DecomposerContract, FailureMode13TenThousandHolesAreDefined) {
  constexpr int kSide = 400;
  FreeSpace layer = solid(kSide * 0.05, kSide * 0.05);
  fill(layer, 0.0, 0.0, kSide * 0.05, kSide * 0.05);
  for (int y = 2; y < kSide; y += 4)
    for (int x = 2; x < kSide; x += 4) layer.cells.at({x, y}) = kFullObstacle;
  const Decomposition& result = this->decompose(layer);
  EXPECT_FALSE(result.regions.empty());
  expectFreeSpaceCovered(layer, result);
  expectAdjacencyMatchesCrossings(result);
}

TYPED_TEST(DecomposerContract, FailureMode13RoomsThatTouchAtACornerAreDefined) {
  FreeSpace layer = solid(9.0, 9.0);
  fill(layer, 0.5, 0.5, 4.5, 4.5);
  fill(layer, 4.5, 4.5, 8.5, 8.5);
  const Decomposition& result = this->decompose(layer);
  EXPECT_EQ(result.regions.size(), 2U);
  EXPECT_TRUE(result.crossings.empty()) << "nobody passes between two corners";
  expectContract(layer, result, kIslands<TypeParam>);
}

TYPED_TEST(DecomposerContract, LongOneCellCorridorIsKept) {
  FreeSpace layer = solid(25.0, 0.15);
  fill(layer, 0.0, 0.05, 25.0, 0.10);
  const Decomposition& result = this->decompose(layer);
  ASSERT_EQ(result.regions.size(), 1U);
  EXPECT_NEAR(result.regions[0].area_m2, 1.25, 1e-9);
  expectContract(layer, result, kIslands<TypeParam>);
}

TYPED_TEST(DecomposerContract, EveryComponentIsCut) {
  FreeSpace layer = solid(20.0, 5.0);
  for (const double x : {0.5, 5.5, 10.5, 15.5}) fill(layer, x, 0.5, x + 4.0, 4.5);
  const Decomposition& result = this->decompose(layer);
  EXPECT_EQ(result.regions.size(), 4U);
  EXPECT_TRUE(result.crossings.empty());
  expectContract(layer, result, kIslands<TypeParam>);
}

TYPED_TEST(DecomposerContract, RoomInsideARingIsItsOwnRegionAndAHoleOfTheRing) {
  FreeSpace layer = solid(14.0, 14.0);
  fill(layer, 1.0, 1.0, 13.0, 13.0);
  fill(layer, 4.0, 4.0, 10.0, 10.0, kFullObstacle);
  fill(layer, 5.0, 5.0, 9.0, 9.0);
  fill(layer, 6.4, 6.4, 7.6, 7.6, kUnknown);
  const Decomposition& result = this->decompose(layer);
  expectContract(layer, result, kIslands<TypeParam>);
  double total_m2 = 0.0;
  for (const Region& region : result.regions) total_m2 += region.area_m2;
  EXPECT_NEAR(total_m2, (144.0 - 36.0) + (16.0 - 1.44), 1e-6);
}

TYPED_TEST(DecomposerContract, UnknownBoundsRegionsAsObstaclesDo) {
  FreeSpace walls = twoRooms(0.9);
  FreeSpace unseen = walls;
  forCells(unseen.cells.box(), [&](const Cell& cell) {
    if (!isFree(unseen, cell)) unseen.cells.at(cell) = kUnknown;
  });
  const Decomposition expected = this->decompose(walls);
  expectEqual(this->decompose(unseen), expected);
}

TYPED_TEST(DecomposerContract, TwoRoomsJoinedByADoorAreTwoRegionsWithOneCrossing) {
  const FreeSpace layer = twoRooms(0.9);
  const Decomposition& result = this->decompose(layer);
  ASSERT_EQ(result.regions.size(), 2U);
  ASSERT_EQ(result.crossings.size(), 1U);
  EXPECT_EQ(result.regions[0].adjacent, std::vector<int>{2});
  const Segment2& segment = result.crossings[0].segment;
  EXPECT_NEAR(length(segment), 0.9, 0.11);
  for (const Point2& end : {segment.a, segment.b}) {
    EXPECT_NEAR(end.x, 4.3, 0.3);
    EXPECT_NEAR(std::abs(end.y - 2.2), 0.45, 0.11);
  }
  expectContract(layer, result, kIslands<TypeParam>);
}

TYPED_TEST(DecomposerContract, MovingTheMapMovesTheRegions) {
  for (std::uint32_t seed = 0; seed < 15; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const FreeSpace layer = randomFloorPlan(seed);
    const Decomposition here = this->decompose(layer);
    const Cell by{-1234, 777};
    this->decomposer_->reset();
    const Decomposition& there = this->decompose(moved(layer, by));
    EXPECT_EQ(here.labels.values(), there.labels.values());
    ASSERT_EQ(here.regions.size(), there.regions.size());
    ASSERT_EQ(here.crossings.size(), there.crossings.size());
    for (std::size_t i = 0; i < here.crossings.size(); ++i) {
      const Point2 was = midpoint(here.crossings[i].segment);
      const Point2 is = midpoint(there.crossings[i].segment);
      EXPECT_NEAR(is.x - was.x, by.x * 0.05, 1e-6);
      EXPECT_NEAR(is.y - was.y, by.y * 0.05, 1e-6);
    }
  }
}

TYPED_TEST(DecomposerContract, EqualSequencesGiveEqualResults) {
  const auto other = makeDecomposer<TypeParam>();
  for (std::uint32_t seed = 100; seed < 115; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const FreeSpace layer = randomFloorPlan(seed);
    expectEqual(this->decompose(layer), other->update(layer));
  }
}

TYPED_TEST(DecomposerContract, AfterResetNothingIsRemembered) {
  this->decompose(randomFloorPlan(3));
  this->decomposer_->reset();
  const auto fresh = makeDecomposer<TypeParam>();
  expectEqual(this->decompose(twoRooms(0.9)), fresh->update(twoRooms(0.9)));
}

TYPED_TEST(DecomposerContract, RandomFloorPlansKeepTheContract) {
  for (std::uint32_t seed = 1000; seed < 1060; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const FreeSpace layer = randomFloorPlan(seed);
    expectContract(layer, this->decompose(layer), kIslands<TypeParam>);
  }
}

TYPED_TEST(DecomposerContract, NoiseKeepsTheContract) {
  for (const int free_percent : {20, 50, 65, 80, 95, 99}) {
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(free_percent) + " %");
      const FreeSpace layer = randomNoise(seed, free_percent);
      expectContract(layer, this->decompose(layer), kIslands<TypeParam>);
    }
  }
}

}  // namespace
}  // namespace occusg
