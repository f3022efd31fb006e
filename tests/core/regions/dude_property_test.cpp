// SPDX-License-Identifier: BSD-3-Clause
// Properties of the dual-space decomposition on random shapes. OCCUSG_DUDE_SHAPES sets how many.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "geometry/cell_outline.hpp"
#include "occusg/regions/dude_decomposer.hpp"
#include "regions/dude_holes.hpp"
#include "regions/dude_symmetry.hpp"

namespace occusg {
namespace {

constexpr int kShapesByDefault = 2000;
constexpr double kResolution_m = 0.1;

int shapeCount() {
  const char* text = std::getenv("OCCUSG_DUDE_SHAPES");
  return text == nullptr ? kShapesByDefault : std::max(1, std::atoi(text));
}

/// Small enough that a shape of a few hundred cells has many regions.
DudeDecomposerConfig smallScale(std::mt19937& random) {
  DudeDecomposerConfig config;
  config.depth_threshold_m = 0.1 * static_cast<double>(random() % 12);
  config.min_region_area_m2 = random() % 3 == 0 ? 0.12 : 0.0;
  config.max_ignored_hole_m = random() % 2 == 0 ? 0.3 : 0.0;
  config.max_width_ratio = 0.6 + 0.1 * static_cast<double>(random() % 8);
  return config;
}

FreeSpace blocked(int width, int height) {
  const CellBox box{{0, 0}, {width, height}};
  return {GridFrame{kResolution_m}, FreeSpaceCells(box, kFullObstacle), box};
}

void setRectangle(FreeSpace& layer, const CellBox& rectangle, std::int8_t value) {
  const CellBox box = rectangle.intersected(layer.cells.box());
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) layer.cells.at({x, y}) = value;
}

CellBox randomRectangle(std::mt19937& random, const CellBox& box, int longest) {
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  const Cell corner{box.min.x + below(box.width()), box.min.y + below(box.height())};
  return {corner, {corner.x + 1 + below(longest), corner.y + 1 + below(longest)}};
}

/// Rooms and walls of all sizes over one another: blobs, holes, staircases, touching corners.
FreeSpace randomLayer(std::mt19937& random) {
  FreeSpace layer =
      blocked(8 + static_cast<int>(random() % 33), 8 + static_cast<int>(random() % 33));
  const CellBox box = layer.cells.box();
  switch (random() % 8) {
    case 0:  // Noise.
      for (int y = 0; y < box.max.y; ++y)
        for (int x = 0; x < box.max.x; ++x)
          layer.cells.at({x, y}) = random() % 3 == 0 ? kFullObstacle : kFree;
      return layer;
    case 1:  // Chessboard.
      for (int y = 0; y < box.max.y; ++y)
        for (int x = y % 2; x < box.max.x; x += 2) layer.cells.at({x, y}) = kFree;
      return layer;
    case 2:  // Nested islands, broken here and there.
      for (int i = 0; 2 * i < std::min(box.max.x, box.max.y); ++i)
        setRectangle(layer, {{i, i}, {box.max.x - i, box.max.y - i}},
                     i / 2 % 2 == 0 ? kFree : kFullObstacle);
      break;
    case 3:  // One-cell corridors.
      for (int i = 0; i < 12; ++i) {
        CellBox corridor = randomRectangle(random, box, 30);
        (random() % 2 == 0 ? corridor.max.x : corridor.max.y) =
            random() % 2 == 0 ? corridor.min.x + 1 : corridor.min.y + 1;
        setRectangle(layer, corridor, kFree);
      }
      return layer;
    case 4:  // All free, or all blocked.
      setRectangle(layer, box, random() % 2 == 0 ? kFree : kFullObstacle);
      return layer;
    default:
      break;
  }
  const int count = 3 + static_cast<int>(random() % 15);
  for (int i = 0; i < count; ++i)
    setRectangle(layer, randomRectangle(random, box, 12),
                 random() % 3 == 0 ? kFullObstacle : kFree);
  return layer;
}

FreeSpace moved(const FreeSpace& layer, const GridSymmetry& symmetry) {
  const CellBox box = symmetry.box(layer.cells.box());
  FreeSpace image{layer.frame, FreeSpaceCells(box, kUnknown), box};
  for (int y = layer.cells.box().min.y; y < layer.cells.box().max.y; ++y)
    for (int x = layer.cells.box().min.x; x < layer.cells.box().max.x; ++x)
      image.cells.at(symmetry.cell({x, y})) = layer.cells.at({x, y});
  return image;
}

/// Cells that are no region's although they are free; small components may be.
std::int64_t unlabelledFreeCells(const FreeSpace& layer, const Decomposition& decomposition) {
  std::int64_t count = 0;
  const Grid<std::int8_t> cells = layer.cells.dense();
  for (std::size_t i = 0; i < cells.values().size(); ++i)
    if (cells.values()[i] == kFree && decomposition.labels.values()[i] == kNoRegion) ++count;
  return count;
}

Cell cornerOf(const Point2& point) {
  return {static_cast<int>(std::lround(point.x / kResolution_m)),
          static_cast<int>(std::lround(point.y / kResolution_m))};
}

CornerRing cornersOf(const Ring& ring) {
  CornerRing corners;
  for (const Point2& point : ring) corners.push_back(cornerOf(point));
  return corners;
}

/// Twice the area between the rings, in cells, from the polygon's corners alone.
std::int64_t twiceTheCells(const Polygon& polygon) {
  std::int64_t cells = signedCells(cornersOf(polygon.outer));
  for (const Ring& hole : polygon.holes) cells += signedCells(cornersOf(hole));
  return 2 * cells;
}

void expectPiecesMatchLabels(const Decomposition& decomposition) {
  std::map<std::int32_t, std::int64_t> cells;
  for (const std::int32_t label : decomposition.labels.values())
    if (label != kNoRegion) ++cells[label];
  ASSERT_EQ(cells.size(), decomposition.regions.size());
  for (std::size_t i = 0; i < decomposition.regions.size(); ++i) {
    const Region& region = decomposition.regions[i];
    ASSERT_EQ(region.id, static_cast<int>(i + 1));
    EXPECT_EQ(twiceTheCells(region.polygon), 2 * cells[region.id]);
    EXPECT_TRUE(isSimple(region.polygon));
    // One outline: the cells hang together, and the polygon is theirs.
    const auto outlines = outlinesOf(decomposition.labels, region.id, decomposition.labels.box());
    ASSERT_EQ(outlines.size(), 1U);
    EXPECT_EQ(outlines.front().outer, cornersOf(region.polygon.outer));
  }
}

void expectAdjacencyMatchesCrossings(const Decomposition& decomposition) {
  std::vector<std::set<int>> adjacent(decomposition.regions.size() + 1);
  for (const Crossing& crossing : decomposition.crossings) {
    ASSERT_LT(crossing.region_a, crossing.region_b);
    ASSERT_GT(crossing.region_a, 0);
    ASSERT_LE(crossing.region_b, static_cast<int>(decomposition.regions.size()));
    EXPECT_GT(length(crossing.segment), 0.0);
    adjacent[static_cast<std::size_t>(crossing.region_a)].insert(crossing.region_b);
    adjacent[static_cast<std::size_t>(crossing.region_b)].insert(crossing.region_a);
  }
  for (const Region& region : decomposition.regions) {
    const std::set<int>& expected = adjacent[static_cast<std::size_t>(region.id)];
    EXPECT_EQ(region.adjacent, std::vector<int>(expected.begin(), expected.end()));
  }
  for (std::size_t i = 1; i < decomposition.crossings.size(); ++i) {
    const Crossing& before = decomposition.crossings[i - 1];
    const Crossing& after = decomposition.crossings[i];
    EXPECT_LE(std::make_pair(before.region_a, before.region_b),
              std::make_pair(after.region_a, after.region_b));
  }
}

void expectInvariants(const FreeSpace& layer, const Decomposition& decomposition,
                      const DudeDecomposerConfig& config) {
  ASSERT_EQ(decomposition.labels.box(), layer.cells.box());
  expectPiecesMatchLabels(decomposition);
  expectAdjacencyMatchesCrossings(decomposition);
  if (config.min_region_area_m2 == 0.0) {
    EXPECT_EQ(unlabelledFreeCells(layer, decomposition), 0);
  }
  if (config.max_ignored_hole_m == 0.0) {
    const Grid<std::int8_t> cells = layer.cells.dense();
    for (std::size_t i = 0; i < cells.values().size(); ++i) {
      if (cells.values()[i] == kFree) continue;
      ASSERT_EQ(decomposition.labels.values()[i], kNoRegion);
    }
  }
}

std::vector<std::int64_t> sortedAreas(const Decomposition& decomposition) {
  std::vector<std::int64_t> areas;
  for (const Region& region : decomposition.regions) areas.push_back(twiceTheCells(region.polygon));
  std::sort(areas.begin(), areas.end());
  return areas;
}

TEST(DudeProperty, PiecesAreSimpleDisjointAndCoverFreeSpace) {
  for (int i = 0; i < shapeCount() && !HasFatalFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    std::mt19937 random(static_cast<unsigned>(i));
    const FreeSpace layer = randomLayer(random);
    const DudeDecomposerConfig config = smallScale(random);
    DudeDecomposer decomposer(config);
    expectInvariants(layer, decomposer.update(layer), config);
    if (HasNonfatalFailure()) break;
  }
}

TEST(DudeProperty, ShiftQuarterTurnAndMirrorGiveTheSameAreas) {
  for (int i = 0; i < shapeCount(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    std::mt19937 random(static_cast<unsigned>(i));
    const FreeSpace layer = randomLayer(random);
    const DudeDecomposerConfig config = smallScale(random);
    const GridSymmetry symmetry = GridSymmetry(static_cast<int>(random() % 8))
                                      .shifted({static_cast<int>(random() % 2000) - 1000,
                                                static_cast<int>(random() % 2000) - 1000});
    DudeDecomposer decomposer(config);
    DudeDecomposer decomposer_of_image(config);
    const auto areas = sortedAreas(decomposer.update(layer));
    const auto areas_of_image = sortedAreas(decomposer_of_image.update(moved(layer, symmetry)));
    ASSERT_EQ(areas, areas_of_image);
  }
}

TEST(DudeProperty, LargerThresholdNeverGivesMoreRegions) {
  for (int i = 0; i < shapeCount(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    std::mt19937 random(static_cast<unsigned>(i));
    const FreeSpace layer = randomLayer(random);
    DudeDecomposerConfig config = smallScale(random);
    std::size_t fewest = layer.cells.size() + 1;
    for (const double threshold_m : {0.0, 0.3, 0.6, 1.5, 3.0}) {
      config.depth_threshold_m = threshold_m;
      DudeDecomposer decomposer(config);
      const std::size_t count = decomposer.update(layer).regions.size();
      ASSERT_LE(count, fewest) << threshold_m;
      fewest = count;
    }
  }
}

TEST(DudeProperty, InvariantsHoldAfterEveryUpdate) {
  for (int i = 0; i < shapeCount() / 10 + 1; ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    std::mt19937 random(static_cast<unsigned>(i));
    FreeSpace layer = randomLayer(random);
    const DudeDecomposerConfig config = smallScale(random);
    DudeDecomposer decomposer(config);
    (void)decomposer.update(layer);
    for (int step = 0; step < 10; ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      if (random() % 4 == 0) {
        const CellBox larger =
            layer.cells.box().including(randomRectangle(random, layer.cells.box().grown(6), 4));
        layer.cells.cover(larger);
      }
      layer.changed = randomRectangle(random, layer.cells.box(), 6).intersected(layer.cells.box());
      setRectangle(layer, layer.changed, random() % 2 == 0 ? kFree : kFullObstacle);
      expectInvariants(layer, decomposer.update(layer), config);
      if (HasFailure()) return;
    }
  }
}

}  // namespace
}  // namespace occusg
