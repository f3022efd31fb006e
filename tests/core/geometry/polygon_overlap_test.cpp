// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/geometry/polygon_overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "drawn_mask.hpp"
#include "geometry/cell_outline.hpp"
#include "occusg/error.hpp"
#include "rings.hpp"

namespace occusg {
namespace {

using testing::box;
using testing::reversed;

double totalArea(const std::vector<Polygon>& polygons) {
  double sum = 0.0;
  for (const Polygon& polygon : polygons) sum += area(polygon);
  return sum;
}

template <typename Call>
void expectRefused(const Call& call, const std::string& words) {
  try {
    call();
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(IntersectionArea, OfBoxesIsExact) {
  const Polygon room{box(0, 0, 4, 4), {}};
  EXPECT_EQ(intersectionArea(room, {box(3, 1, 6, 3), {}}), 2.0);
  EXPECT_EQ(intersectionArea(room, room), 16.0);
  EXPECT_EQ(intersectionArea(room, {box(4, 0, 8, 4), {}}), 0.0) << "shared wall";
  EXPECT_EQ(intersectionArea(room, {box(9, 9, 10, 10), {}}), 0.0);
  EXPECT_EQ(intersectionArea(room, {}), 0.0);
}

TEST(IntersectionArea, HolesOnEitherSideCount) {
  const Polygon ring{box(0, 0, 4, 4), {box(1, 1, 3, 3)}};
  EXPECT_EQ(intersectionArea(ring, {box(0, 0, 2, 2), {}}), 3.0);
  EXPECT_EQ(intersectionArea({box(0, 0, 2, 2), {}}, ring), 3.0);
  EXPECT_EQ(intersectionArea(ring, {box(1, 1, 3, 3), {}}), 0.0);
}

TEST(IntersectionArea, DoesNotDependOnTheSenseOfRotation) {
  const Polygon a{reversed(box(0, 0, 4, 4)), {reversed(box(1, 1, 3, 3))}};
  const Polygon b{reversed(box(0, 0, 2, 2)), {}};
  EXPECT_EQ(intersectionArea(a, b), 3.0);
  EXPECT_EQ(intersectionArea(b, a), 3.0);
}

TEST(IntersectionArea, KeepsItsDigitsFarFromTheOrigin) {
  const double far = 123456.0;
  EXPECT_EQ(intersectionArea({box(far, far, far + 4, far + 4), {}},
                             {box(far + 3, far + 1, far + 6, far + 3), {}}),
            2.0);
}

TEST(IntersectionArea, OfCellOutlinesIsTheNumberOfCommonCells) {
  const GridFrame frame{0.05};
  const CellBox cells{{-15, -15}, {15, 15}};
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto mask_a = testing::randomMask(seed, cells, 0.7);
    const auto mask_b = testing::randomMask(seed + 1000, cells, 0.6);
    int common = 0;
    for (std::size_t i = 0; i < mask_a.values().size(); ++i)
      common += mask_a.values()[i] & mask_b.values()[i];
    double sum = 0.0;
    double covered = 0.0;
    std::vector<Polygon> polygons_b;
    for (const CellOutline& outline : outlinesOf(mask_b))
      polygons_b.push_back(toPolygon(outline, frame));
    for (const CellOutline& outline : outlinesOf(mask_a)) {
      const Polygon a = toPolygon(outline, frame);
      for (const Polygon& b : polygons_b) sum += intersectionArea(a, b);
      covered += coveredArea(a, polygons_b);
    }
    EXPECT_NEAR(sum, common * frame.cellArea(), 1e-10);
    EXPECT_NEAR(covered, common * frame.cellArea(), 1e-10);
  }
}

TEST(IntersectionArea, RefusesCoordinatesThatAreNotUsable) {
  const Polygon room{box(0, 0, 4, 4), {}};
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), 2e11, -1e300}) {
    const Polygon broken{{{0, 0}, {4, 0}, {2, 4}}, {{{1, 1}, {2, 1}, {2, bad}}}};
    EXPECT_THROW((void)intersectionArea(room, broken), Error) << bad;
    EXPECT_THROW((void)coveredArea(broken, {room}), Error) << bad;
    EXPECT_THROW((void)repaired(broken), Error) << bad;
  }
}

TEST(IntersectionArea, RefusesANanInTheOuterRingWhereverItStands) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Polygon room{box(0, 0, 4, 4), {}};
  for (std::size_t i = 0; i < 4; ++i) {
    Polygon broken = room;
    broken.outer[i].x = nan;
    EXPECT_THROW((void)intersectionArea(room, broken), Error) << i;
    EXPECT_THROW((void)intersectionArea(broken, room), Error) << i;
    EXPECT_THROW((void)coveredArea(room, {broken}), Error) << i;
    EXPECT_THROW((void)intersectionArea(translated(room, 99, 99), broken), Error) << i;
  }
}

TEST(IntersectionArea, RefusalNamesTheValueAndTheLimit) {
  try {
    (void)repaired({{{0, 0}, {4, 0}, {2, 5e11}}, {}});
    FAIL() << "accepted";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("500000000000."), std::string::npos) << what;
    EXPECT_NE(what.find("100000000000."), std::string::npos) << what;
  }
}

TEST(IntersectionArea, LargestAcceptedCoordinatesDoNotOverflow) {
  const double far = kMaxCoordinate_m;
  const Polygon world{box(-far, -far, far, far), {}};
  EXPECT_NEAR(intersectionArea(world, world) / (4 * far * far), 1.0, 1e-12);
  EXPECT_EQ(intersectionArea(world, {box(0, 0, 4, 4), {}}), 16.0);
}

TEST(IntersectionOverUnion, OfHalfOverlappingBoxesIsAThird) {
  const Polygon a{box(0, 0, 4, 4), {}};
  EXPECT_DOUBLE_EQ(intersectionOverUnion(a, {box(2, 0, 6, 4), {}}), 8.0 / 24.0);
  EXPECT_DOUBLE_EQ(intersectionOverUnion(a, a), 1.0);
  EXPECT_EQ(intersectionOverUnion(a, {box(4, 0, 6, 4), {}}), 0.0);
}

TEST(IntersectionOverUnion, OfNothingIsZero) {
  EXPECT_EQ(intersectionOverUnion({}, {}), 0.0);
  EXPECT_EQ(intersectionOverUnion({{{0, 0}, {1, 1}, {2, 2}}, {}}, {}), 0.0);
}

TEST(CoveredArea, CountsOverlapsOfTheOthersOnce) {
  const Polygon room{box(0, 0, 4, 4), {}};
  EXPECT_EQ(coveredArea(room, {{box(0, 0, 2, 4), {}}, {box(1, 0, 3, 4), {}}}), 12.0);
  EXPECT_EQ(coveredArea(room, {}), 0.0);
  EXPECT_EQ(coveredArea(room, {{box(5, 5, 6, 6), {}}}), 0.0);
}

TEST(CoveredArea, HoleOfOneMayBeFilledByAnother) {
  const Polygon room{box(0, 0, 4, 4), {}};
  const Polygon ring{box(0, 0, 4, 4), {box(1, 1, 3, 3)}};
  EXPECT_EQ(coveredArea(room, {ring}), 12.0);
  EXPECT_EQ(coveredArea(room, {ring, {box(1, 1, 2, 3), {}}}), 14.0);
}

TEST(Repaired, SoundPolygonKeepsItsShape) {
  const Polygon ring{box(0, 0, 4, 4), {reversed(box(1, 1, 3, 3))}};
  const auto pieces = repaired(ring);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(area(pieces[0]), 12.0);
  EXPECT_EQ(pieces[0].holes.size(), 1U);
  EXPECT_GT(signedArea(pieces[0].outer), 0.0);
  EXPECT_LT(signedArea(pieces[0].holes[0]), 0.0);
}

TEST(Repaired, BowTieFallsIntoItsWings) {
  const auto pieces = repaired({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {}});
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(area(pieces[0]), 4.0);
  EXPECT_EQ(area(pieces[1]), 4.0);
  EXPECT_LT(pieces[0].outer.front().x, 2.0 + 1e-9) << "ties by position";
}

TEST(Repaired, LargestPieceComesFirst) {
  const auto pieces = repaired({{{0, 0}, {6, 6}, {6, 0}, {0, 2}}, {}});
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_GT(area(pieces[0]), area(pieces[1]));
}

TEST(Repaired, HoleAcrossTheOuterRingFollowsTheEvenOddRule) {
  const auto pieces = repaired({box(0, 0, 4, 4), {box(3, 1, 5, 3)}});
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(totalArea(pieces), 16.0);
  EXPECT_EQ(area(pieces[0]), 14.0);
}

TEST(Repaired, VertexOnAnEdgeOfTheSameRingIsCutFree) {
  const Polygon touching{{{3, 6}, {0, 3}, {2, 2}, {2, 5}, {3.5, 4.5}}, {}};
  const auto pieces = repaired(touching);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_TRUE(isSimple(pieces[0]) && isSimple(pieces[1]));
  EXPECT_NEAR(totalArea(pieces), area(touching), 1e-4);
}

TEST(Repaired, IslandsInHolesAreKept) {
  const auto pieces = repaired({box(0, 0, 9, 9), {box(1, 1, 8, 8), box(2, 2, 7, 7)}});
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(area(pieces[0]), 81.0 - 49.0);
  EXPECT_EQ(area(pieces[1]), 25.0);
}

TEST(Repaired, NothingIsLeftOfLinesAndPoints) {
  EXPECT_TRUE(repaired({}).empty());
  EXPECT_TRUE(repaired({{{0, 0}, {1, 1}, {2, 2}}, {}}).empty());
  EXPECT_TRUE(repaired({{{0, 0}, {1, 0}, {1, 1}, {1, 0}}, {}}).empty());
  EXPECT_TRUE(repaired({{{1, 1}, {1, 1}, {1, 1}}, {}}).empty());
}

/// Even-odd area by counting the points of a fine raster that has none on a line of small slope.
double evenOddArea(const Polygon& polygon, double step) {
  double sum = 0.0;
  for (double y = step * 0.317; y < 8.0; y += step)
    for (double x = step * 0.683; x < 8.0; x += step)
      if (contains(polygon, {x, y})) sum += step * step;
  return sum;
}

/// @param steps lattice steps a side: few make vertices fall on edges and edges on each other.
Polygon randomTangle(std::uint32_t seed, std::uint32_t steps) {
  std::mt19937 engine(seed);
  Polygon tangle;
  const std::size_t count = 3 + engine() % 25;
  while (tangle.outer.size() < count) {
    const double x = engine() % steps;
    const double y = engine() % steps;
    tangle.outer.push_back({8.0 * x / steps, 8.0 * y / steps});
  }
  return tangle;
}

TEST(Repaired, RandomTanglesFallIntoSimplePiecesOfTheSameArea) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    const Polygon tangle = randomTangle(seed, 8000);
    const auto pieces = repaired(tangle);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      EXPECT_TRUE(isSimple(pieces[i]));
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_LT(intersectionArea(pieces[i], pieces[j]), 1e-4) << "pieces overlap";
    }
    EXPECT_NEAR(totalArea(pieces), evenOddArea(tangle, 0.05), 0.25);
  }
}

TEST(Repaired, TanglesThatTouchThemselvesEverywhereStillGiveSimplePieces) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    const Polygon tangle = randomTangle(seed, 8);
    const auto pieces = repaired(tangle);
    for (const Polygon& piece : pieces) EXPECT_TRUE(isSimple(piece));
    const double expected = evenOddArea(tangle, 0.05);
    EXPECT_NEAR(totalArea(pieces), expected, 0.05 * expected + 0.25);
  }
}

/// A comb with teeth upwards, 1 m apart, or to the right.
Polygon comb(int teeth, bool sideways) {
  Ring ring;
  for (int i = 0; i < teeth; ++i) {
    for (const Point2& corner : Ring{{i + 0.0, 0}, {i + 0.0, 1e4}, {i + 0.5, 1e4}, {i + 0.5, 0}})
      ring.push_back(corner);
  }
  ring.push_back({1.0 * teeth, 0});
  ring.push_back({1.0 * teeth, -1});
  ring.push_back({0, -1});
  if (sideways)
    for (Point2& point : ring) std::swap(point.x, point.y);
  return {ring, {}};
}

TEST(Repaired, RefusesAPolygonThatCrossesItselfThousandsOfTimes) {
  std::mt19937 engine(1);
  Polygon tangle;
  for (int i = 0; i < 2000; ++i)
    tangle.outer.push_back({0.001 * (engine() % 30000), 0.001 * (engine() % 30000)});
  expectRefused([&] { (void)repaired(tangle); }, "edges cross or touch at more than 16000 places");
}

TEST(IntersectionArea, RefusesCombsThatCrossMillionsOfTimes) {
  EXPECT_NEAR(intersectionArea(comb(100, false), comb(100, true)), 2500.0, 300.0);
  expectRefused([&] { (void)intersectionArea(comb(2000, false), comb(2000, true)); },
                "edges cross or touch at more than");
}

TEST(IntersectionArea, ALargeOutlineWithItselfIsNoTangle) {
  const Polygon large = comb(2000, false);
  EXPECT_NEAR(intersectionArea(large, large), area(large), 1.0);
}

TEST(UnitedPolygons, CoverEachPlaceOnce) {
  const auto united_boxes =
      united({{box(0, 0, 4, 4), {}}, {box(2, 2, 6, 6), {}}, {box(20, 0, 21, 1), {}}, {}});
  ASSERT_EQ(united_boxes.size(), 2U);
  EXPECT_NEAR(area(united_boxes[0]), 28.0, 1e-6);
  EXPECT_NEAR(area(united_boxes[1]), 1.0, 1e-6);
  EXPECT_TRUE(united({}).empty());
}

TEST(UnitedPolygons, TheWayARingRunsDoesNotMatter) {
  EXPECT_NEAR(totalArea(united({{box(0, 0, 4, 4), {}}, {reversed(box(2, 2, 6, 6)), {}}})), 28.0,
              1e-6);
}

TEST(UnitedPolygons, RoomsAroundACourtLeaveAHole) {
  const auto ring = united(
      {{box(0, 0, 6, 1), {}}, {box(0, 5, 6, 6), {}}, {box(0, 0, 1, 6), {}}, {box(5, 0, 6, 6), {}}});
  ASSERT_EQ(ring.size(), 1U);
  EXPECT_EQ(ring[0].holes.size(), 1U);
  EXPECT_NEAR(area(ring[0]), 20.0, 1e-6);
}

TEST(DifferenceOfPolygons, IsWhatTheOthersLeave) {
  const Polygon hall{box(0, 0, 8, 4), {}};
  EXPECT_NEAR(totalArea(difference(hall, {{box(1, 1, 3, 3), {}}})), 28.0, 1e-6);
  EXPECT_EQ(difference(hall, {{box(3, -1, 5, 5), {}}}).size(), 2U);
  EXPECT_TRUE(difference(hall, {{box(-1, -1, 9, 9), {}}}).empty());
  EXPECT_NEAR(totalArea(difference(hall, {{box(20, 0, 21, 1), {}}})), 32.0, 1e-6);
}

}  // namespace
}  // namespace occusg
