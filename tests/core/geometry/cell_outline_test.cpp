// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/cell_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "drawn_mask.hpp"

namespace occusg {
namespace {

using testing::drawnMask;
using testing::randomMask;

const GridFrame kUnitFrame{1.0};

Grid<std::uint8_t> rasterised(const CellOutline& outline, const CellBox& box) {
  Grid<std::uint8_t> parity(box, 0);
  const auto toggleRightOf = [&](const CornerRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Cell a = ring[i];
      const Cell b = ring[(i + 1) % ring.size()];
      for (int y = std::min(a.y, b.y); y < std::max(a.y, b.y); ++y)
        for (int x = a.x; x < box.max.x; ++x) parity.at({x, y}) ^= 1;
    }
  };
  toggleRightOf(outline.outer);
  for (const CornerRing& hole : outline.holes) toggleRightOf(hole);
  return parity;
}

void expectWellFormed(const CornerRing& ring) {
  ASSERT_GE(ring.size(), 4U);
  EXPECT_EQ(std::set<Cell>(ring.begin(), ring.end()).size(), ring.size()) << "a corner twice";
  EXPECT_EQ(*std::min_element(ring.begin(), ring.end()), ring.front());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Cell a = ring[i];
    const Cell b = ring[(i + 1) % ring.size()];
    const Cell c = ring[(i + 2) % ring.size()];
    EXPECT_NE(a.x == b.x, a.y == b.y) << "not along cell edges";
    EXPECT_NE(a.x == b.x, b.x == c.x) << "collinear corners";
  }
}

TEST(CellOutline, EmptyMaskHasNone) {
  EXPECT_TRUE(outlinesOf(Grid<std::uint8_t>()).empty());
  EXPECT_TRUE(outlinesOf(drawnMask({"....", "...."})).empty());
}

TEST(CellOutline, OneCellIsItsFourCornersCounterClockwise) {
  const auto outlines = outlinesOf(drawnMask({"#"}, {-3, 7}));
  ASSERT_EQ(outlines.size(), 1U);
  EXPECT_EQ(outlines[0].outer, (CornerRing{{-3, 7}, {-2, 7}, {-2, 8}, {-3, 8}}));
  EXPECT_TRUE(outlines[0].holes.empty());
}

TEST(CellOutline, AnyNonZeroValueIsInside) {
  Grid<std::uint8_t> mask({{0, 0}, {2, 1}}, 255);
  mask.at({1, 0}) = 2;
  ASSERT_EQ(outlinesOf(mask).size(), 1U);
  EXPECT_EQ(outlinesOf(mask)[0].outer.size(), 4U);
}

TEST(CellOutline, StraightStretchesHaveNoCornersBetween) {
  const auto outlines = outlinesOf(drawnMask({"#...",  //
                                              "####"}));
  ASSERT_EQ(outlines.size(), 1U);
  EXPECT_EQ(outlines[0].outer, (CornerRing{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 2}, {0, 2}}));
}

TEST(CellOutline, HoleRunsClockwiseFromItsSmallestCorner) {
  const auto outlines = outlinesOf(drawnMask({"####",  //
                                              "#..#",  //
                                              "####"}));
  ASSERT_EQ(outlines.size(), 1U);
  ASSERT_EQ(outlines[0].holes.size(), 1U);
  EXPECT_EQ(outlines[0].holes[0], (CornerRing{{1, 1}, {1, 2}, {3, 2}, {3, 1}}));
}

TEST(CellOutline, CellsTouchingAtACornerAreApart) {
  EXPECT_EQ(outlinesOf(drawnMask({"#.", ".#"})).size(), 2U);
  EXPECT_EQ(outlinesOf(drawnMask({".#", "#."})).size(), 2U);
}

TEST(CellOutline, IslandInAHoleIsAComponentOfItsOwn) {
  const auto outlines = outlinesOf(drawnMask({"#####",  //
                                              "#...#",  //
                                              "#.#.#",  //
                                              "#...#",  //
                                              "#####"}));
  ASSERT_EQ(outlines.size(), 2U);
  EXPECT_EQ(outlines[0].holes.size(), 1U);
  EXPECT_EQ(outlines[1].outer.front(), (Cell{2, 2}));
  EXPECT_TRUE(outlines[1].holes.empty());
}

TEST(CellOutline, IslandTouchingTheRimOfItsHoleStaysApart) {
  const auto outlines = outlinesOf(drawnMask({"####",  //
                                              "#..#",  //
                                              "##.#",  //
                                              "#..#",  //
                                              "####"}));
  ASSERT_EQ(outlines.size(), 1U);
  const auto touching = outlinesOf(drawnMask({"#####",  //
                                              "#...#",  //
                                              "#.#.#",  //
                                              "##..#",  //
                                              "#####"}));
  ASSERT_EQ(touching.size(), 2U);
  EXPECT_EQ(touching[0].holes.size(), 1U);
  EXPECT_EQ(touching[1].outer.size(), 4U);
}

TEST(CellOutline, RingPassingACornerTwiceBecomesOuterRingAndHole) {
  const auto outlines = outlinesOf(drawnMask({".###",  //
                                              "#..#",  //
                                              "####"}));
  ASSERT_EQ(outlines.size(), 1U);
  expectWellFormed(outlines[0].outer);
  ASSERT_EQ(outlines[0].holes.size(), 1U);
  EXPECT_EQ(outlines[0].holes[0], (CornerRing{{1, 1}, {1, 2}, {3, 2}, {3, 1}}));
  EXPECT_EQ(outlines[0].outer, (CornerRing{{0, 0}, {4, 0}, {4, 3}, {1, 3}, {1, 2}, {0, 2}}));
}

TEST(CellOutline, EmptyCellsTouchingAtACornerAreTwoHoles) {
  const auto outlines = outlinesOf(drawnMask({"####",  //
                                              "#.##",  //
                                              "##.#",  //
                                              "####"}));
  ASSERT_EQ(outlines.size(), 1U);
  ASSERT_EQ(outlines[0].holes.size(), 2U);
  EXPECT_EQ(outlines[0].holes[0].front(), (Cell{2, 1}));
  EXPECT_EQ(outlines[0].holes[1].front(), (Cell{1, 2}));
}

TEST(CellOutline, ChainOfPinchesFallsIntoOneHoleEach) {
  const auto outlines = outlinesOf(drawnMask({"#######",  //
                                              "#.###.#",  //
                                              "##.#.##",  //
                                              "###.###",  //
                                              "#######"}));
  ASSERT_EQ(outlines.size(), 1U);
  EXPECT_EQ(outlines[0].holes.size(), 5U);
  for (const CornerRing& hole : outlines[0].holes) EXPECT_EQ(hole.size(), 4U);
}

TEST(CellOutline, HolesSideBySideBelongToTheirOwnComponents) {
  const auto outlines = outlinesOf(drawnMask({"#######.#####",  //
                                              "#.#.#.#.#.#.#",  //
                                              "#######.#####"}));
  ASSERT_EQ(outlines.size(), 2U);
  EXPECT_EQ(outlines[0].holes.size(), 3U);
  EXPECT_EQ(outlines[1].holes.size(), 2U);
}

TEST(CellOutline, OutlinesAreOrderedByTheirSmallestCorner) {
  const auto outlines = outlinesOf(drawnMask({"#.....",  //
                                              "#.#..#",  //
                                              "..#..#"}));
  ASSERT_EQ(outlines.size(), 3U);
  EXPECT_EQ(outlines[0].outer.front(), (Cell{2, 0}));
  EXPECT_EQ(outlines[1].outer.front(), (Cell{5, 0}));
  EXPECT_EQ(outlines[2].outer.front(), (Cell{0, 1}));
}

TEST(CellOutline, LabelsAreReadWithinTheBoxOnly) {
  Grid<std::int32_t> labels({{-5, -5}, {5, 5}}, 3);
  labels.at({0, 0}) = 4;
  const CellBox box{{-2, -2}, {2, 2}};
  const auto threes = outlinesOf(labels, 3, box);
  ASSERT_EQ(threes.size(), 1U);
  EXPECT_EQ(threes[0].outer, (CornerRing{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}));
  EXPECT_EQ(threes[0].holes.size(), 1U);
  EXPECT_EQ(outlinesOf(labels, 4, box).size(), 1U);
  EXPECT_TRUE(outlinesOf(labels, 5, box).empty());
}

TEST(CellOutline, BoxBeyondTheLabelsIsCutToThem) {
  const Grid<std::int32_t> labels({{0, 0}, {2, 2}}, 1);
  ASSERT_EQ(outlinesOf(labels, 1, {{-9, -9}, {9, 9}}).size(), 1U);
  EXPECT_TRUE(outlinesOf(labels, 1, {{5, 5}, {9, 9}}).empty());
  EXPECT_TRUE(outlinesOf(labels, 1, CellBox{}).empty());
  EXPECT_TRUE(outlinesOf(Grid<std::int32_t>(), 0, {{0, 0}, {9, 9}}).empty());
}

TEST(CellOutline, PolygonIsInMetresOfTheFrame) {
  const auto outlines = outlinesOf(drawnMask({"####", "#..#", "####"}, {10, -20}));
  const Polygon polygon = toPolygon(outlines.at(0), GridFrame{0.05});
  EXPECT_EQ(polygon.outer.front(), (GridFrame{0.05}.corner({10, -20})));
  EXPECT_NEAR(area(polygon), 10 * 0.0025, 1e-12);
  EXPECT_GT(signedArea(polygon.outer), 0.0);
  EXPECT_LT(signedArea(polygon.holes.at(0)), 0.0);
}

/// Masks of every density and of odd and even sizes, in all quadrants.
class RandomMasks : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  [[nodiscard]] Grid<std::uint8_t> mask() const {
    const auto seed = GetParam();
    const int x = static_cast<int>(seed % 7) * 9 - 30;
    const int y = static_cast<int>(seed % 5) * 11 - 25;
    const int width = 1 + static_cast<int>(seed * 37 % 50);
    const int height = 1 + static_cast<int>(seed * 53 % 40);
    const double density = 0.1 + 0.1 * (seed % 9);
    return randomMask(seed, {{x, y}, {x + width, y + height}}, density);
  }
};

TEST_P(RandomMasks, RingsAreSimpleAndHolesInside) {
  SCOPED_TRACE(GetParam());
  for (const CellOutline& outline : outlinesOf(mask())) {
    expectWellFormed(outline.outer);
    for (const CornerRing& hole : outline.holes) expectWellFormed(hole);
    EXPECT_TRUE(isSimple(toPolygon(outline, kUnitFrame)));
  }
}

TEST_P(RandomMasks, RasterisedOutlinesAreTheMask) {
  SCOPED_TRACE(GetParam());
  const auto drawn = mask();
  Grid<std::uint8_t> sum(drawn.box(), 0);
  double total_area = 0.0;
  for (const CellOutline& outline : outlinesOf(drawn)) {
    const auto cells = rasterised(outline, drawn.box());
    for (std::size_t i = 0; i < sum.values().size(); ++i) sum.values()[i] += cells.values()[i];
    const Polygon polygon = toPolygon(outline, kUnitFrame);
    EXPECT_GT(signedArea(polygon.outer), 0.0);
    for (const Ring& hole : polygon.holes) EXPECT_LT(signedArea(hole), 0.0);
    total_area += area(polygon);
  }
  EXPECT_EQ(sum, drawn);
  EXPECT_EQ(total_area, std::count(drawn.values().begin(), drawn.values().end(), 1));
}

TEST_P(RandomMasks, EveryOutlineIsOneConnectedComponent) {
  SCOPED_TRACE(GetParam());
  for (const CellOutline& outline : outlinesOf(mask())) {
    auto cells = rasterised(outline, mask().box());
    std::vector<Cell> open{outline.outer.front()};
    cells.at(open.front()) = 0;
    while (!open.empty()) {
      const Cell cell = open.back();
      open.pop_back();
      for (const Cell next : {Cell{cell.x + 1, cell.y}, Cell{cell.x - 1, cell.y},
                              Cell{cell.x, cell.y + 1}, Cell{cell.x, cell.y - 1}}) {
        if (cells.valueOr(next, 0) == 0) continue;
        cells.at(next) = 0;
        open.push_back(next);
      }
    }
    EXPECT_EQ(std::count(cells.values().begin(), cells.values().end(), 1), 0);
  }
}

TEST_P(RandomMasks, ShiftedMaskHasShiftedOutlines) {
  SCOPED_TRACE(GetParam());
  const auto drawn = mask();
  const CellBox box{{drawn.box().min.x + 1000, drawn.box().min.y - 777},
                    {drawn.box().max.x + 1000, drawn.box().max.y - 777}};
  Grid<std::uint8_t> shifted(box, 0);
  shifted.values() = drawn.values();
  const auto back = [](CornerRing ring) {
    for (Cell& corner : ring) corner = {corner.x - 1000, corner.y + 777};
    return ring;
  };
  const auto expected = outlinesOf(drawn);
  const auto outlines = outlinesOf(shifted);
  ASSERT_EQ(outlines.size(), expected.size());
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    EXPECT_EQ(back(outlines[i].outer), expected[i].outer);
    ASSERT_EQ(outlines[i].holes.size(), expected[i].holes.size());
    for (std::size_t j = 0; j < outlines[i].holes.size(); ++j)
      EXPECT_EQ(back(outlines[i].holes[j]), expected[i].holes[j]);
  }
}

TEST_P(RandomMasks, LabelsAndMaskAgree) {
  SCOPED_TRACE(GetParam());
  const auto drawn = mask();
  Grid<std::int32_t> labels(drawn.box(), 0);
  for (std::size_t i = 0; i < labels.values().size(); ++i)
    labels.values()[i] = drawn.values()[i] != 0 ? -7 : 7;
  const auto expected = outlinesOf(drawn);
  const auto outlines = outlinesOf(labels, -7, drawn.box());
  ASSERT_EQ(outlines.size(), expected.size());
  for (std::size_t i = 0; i < outlines.size(); ++i) EXPECT_EQ(outlines[i].outer, expected[i].outer);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMasks, ::testing::Range(1U, 61U));

}  // namespace
}  // namespace occusg
