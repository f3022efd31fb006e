// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "rings.hpp"

namespace occusg {
namespace {

using testing::box;
using testing::reversed;

/// A 4 x 4 m room with a 1 x 1 m pillar in its left half.
Polygon roomWithPillar() { return {box(0, 0, 4, 4), {reversed(box(1, 1, 2, 2))}}; }

TEST(Polygon, SignedAreaFollowsTheSenseOfRotation) {
  EXPECT_DOUBLE_EQ(signedArea(box(0, 0, 2, 3)), 6.0);
  EXPECT_DOUBLE_EQ(signedArea(reversed(box(0, 0, 2, 3))), -6.0);
  EXPECT_EQ(signedArea({}), 0.0);
  EXPECT_EQ(signedArea({{0, 0}, {1, 1}}), 0.0);
}

TEST(Polygon, AreaKeepsItsDigitsFarFromTheOrigin) {
  EXPECT_NEAR(area({box(1e6, 1e6, 1e6 + 2, 1e6 + 3), {}}), 6.0, 1e-9);
}

TEST(Polygon, HolesAreTakenOutOfTheAreaWhicheverWayTheyRun) {
  EXPECT_DOUBLE_EQ(area(roomWithPillar()), 15.0);
  EXPECT_DOUBLE_EQ(area({box(0, 0, 4, 4), {box(1, 1, 2, 2)}}), 15.0);
  EXPECT_DOUBLE_EQ(area({reversed(box(0, 0, 4, 4)), {}}), 16.0);
}

TEST(Polygon, AreaIsNeverNegative) {
  EXPECT_EQ(area({box(0, 0, 1, 1), {box(0, 0, 4, 4)}}), 0.0);
  EXPECT_EQ(area({}), 0.0);
}

TEST(Polygon, PerimeterCountsHoles) { EXPECT_DOUBLE_EQ(perimeter(roomWithPillar()), 20.0); }

TEST(Polygon, EdgesEndWithTheOneThatClosesTheRing) {
  const Ring triangle = {{0, 0}, {3, 0}, {3, 4}};
  const std::vector<Segment2> edges = edgesOf(triangle);
  ASSERT_EQ(edges.size(), 3U);
  EXPECT_EQ(edges.front().a, triangle.front());
  EXPECT_EQ(edges.back().a, triangle.back());
  EXPECT_EQ(edges.back().b, triangle.front());
  EXPECT_DOUBLE_EQ(length(triangle), 12.0);
  EXPECT_TRUE(edgesOf({}).empty());
  EXPECT_EQ(length(Ring()), 0.0);
}

TEST(Polygon, CentroidIsThatOfTheAreaWithoutHoles) {
  const Point2 center = centroid(roomWithPillar());
  EXPECT_NEAR(center.x, (16 * 2.0 - 1.5) / 15, 1e-12);
  EXPECT_NEAR(center.y, (16 * 2.0 - 1.5) / 15, 1e-12);
  const Point2 same = centroid({reversed(box(0, 0, 4, 4)), {box(1, 1, 2, 2)}});
  EXPECT_NEAR(same.x, center.x, 1e-12);
}

TEST(Polygon, CentroidWithoutAreaIsTheMeanOfTheVertices) {
  EXPECT_EQ(centroid({{{0, 0}, {2, 2}, {4, 4}}, {}}), (Point2{2, 2}));
  EXPECT_EQ(centroid({{{3, 1}}, {}}), (Point2{3, 1}));
  EXPECT_EQ(centroid({}), (Point2{0, 0}));
}

TEST(Polygon, BoundsAreThoseOfTheOuterRing) {
  const Bounds2 limits = bounds({{{1, 5}, {-2, 0}, {3, -4}}, {}});
  EXPECT_EQ(limits.min, (Point2{-2, -4}));
  EXPECT_EQ(limits.max, (Point2{3, 5}));
}

TEST(ConvexHull, InnerRepeatedAndCollinearPointsAreLeftOut) {
  const Ring hull =
      convexHull({{2, 2}, {0, 0}, {4, 0}, {2, 0}, {4, 4}, {0, 4}, {0, 0}, {0, 1}, {3, 4}});
  EXPECT_EQ(hull, box(0, 0, 4, 4));
}

TEST(ConvexHull, OfCellCornersOnASlopeHasNoCollinearVertex) {
  Ring points{{0.0, 5.0}};
  for (int k = 0; k <= 60; ++k) points.push_back({k * 0.05, 3 * k * 0.05});
  EXPECT_EQ(convexHull(points).size(), 3U);
}

TEST(ConvexHull, OfFewerThanThreeDirectionsIsNoArea) {
  EXPECT_TRUE(convexHull({}).empty());
  EXPECT_EQ(convexHull({{1, 1}, {1, 1}}).size(), 1U);
  EXPECT_EQ(convexHull({{0, 0}, {1, 1}, {3, 3}, {2, 2}}), (Ring{{0, 0}, {3, 3}}));
}

TEST(ConvexHull, HoldsAllPointsAndTurnsLeftEverywhere) {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 engine(seed);
    Ring points;
    for (int i = 0; i < 200; ++i)
      points.push_back({static_cast<double>(engine() % 40) * 0.05 - 1.0,
                        static_cast<double>(engine() % 40) * 0.05 - 1.0});
    const Ring hull = convexHull(points);
    for (const Point2& point : points) EXPECT_TRUE(contains({hull, {}}, point));
    for (std::size_t i = 0; i < hull.size(); ++i)
      EXPECT_GT(signedArea({hull[i], hull[(i + 1) % hull.size()], hull[(i + 2) % hull.size()]}),
                1e-6);
  }
}

TEST(PolygonContains, BoundaryIsInsideHoleIsNot) {
  const Polygon room = roomWithPillar();
  EXPECT_TRUE(contains(room, {3, 3}));
  EXPECT_TRUE(contains(room, {0, 0}));
  EXPECT_TRUE(contains(room, {4, 2.5}));
  EXPECT_TRUE(contains(room, {1, 1.5}));
  EXPECT_FALSE(contains(room, {1.5, 1.5}));
  EXPECT_FALSE(contains(room, {4.0001, 2}));
  EXPECT_FALSE(contains(room, {-1, 0}));
  EXPECT_FALSE(contains(room, {5, 4}));
  EXPECT_FALSE(contains({}, {0, 0}));
}

TEST(PolygonContains, EveryPointOfASlopedEdgeIsOnTheBoundary) {
  const Polygon triangle{{{0, 0}, {0.3, 0.1}, {0, 7}}, {}};
  for (int k = 0; k <= 100; ++k) {
    EXPECT_TRUE(contains(triangle, {0.3 * k / 100, 0.1 * k / 100})) << k;
    EXPECT_FALSE(contains(triangle, {0.3 * k / 100, 0.1 * k / 100 - 1e-6})) << k;
  }
}

TEST(PolygonContains, RayThroughVerticesCountsThemOnce) {
  const Polygon zigzag{{{0, 0}, {2, 2}, {4, 0}, {6, 2}, {8, 0}, {8, 4}, {0, 4}}, {}};
  EXPECT_TRUE(contains(zigzag, {1, 2}));
  EXPECT_FALSE(contains(zigzag, {-1, 2}));
  EXPECT_FALSE(contains(zigzag, {-1, 0}));
  EXPECT_FALSE(contains(zigzag, {4, -1}));
  EXPECT_FALSE(contains(zigzag, {2, 1}));
}

TEST(PolygonDistance, IsZeroInsideAndToTheNearestEdgeOutside) {
  const Polygon room = roomWithPillar();
  EXPECT_EQ(distance(room, {3, 3}), 0.0);
  EXPECT_DOUBLE_EQ(distance(room, {1.4, 1.5}), 0.4);
  EXPECT_DOUBLE_EQ(distance(room, {7, 8}), 5.0);
  EXPECT_DOUBLE_EQ(boundaryDistance(room, {3.5, 2}), 0.5);
  EXPECT_DOUBLE_EQ(boundaryDistance(room, {1.4, 1.5}), 0.4);
}

TEST(PolygonDistance, ToNothingIsInfinite) {
  EXPECT_EQ(distance(Polygon{}, Point2{1, 2}), std::numeric_limits<double>::infinity());
}

TEST(SegmentDistance, EndsAndPointSegmentsCount) {
  EXPECT_DOUBLE_EQ(distance(Segment2{{0, 0}, {2, 0}}, {1, 3}), 3.0);
  EXPECT_DOUBLE_EQ(distance(Segment2{{0, 0}, {2, 0}}, {5, 4}), 5.0);
  EXPECT_DOUBLE_EQ(distance(Segment2{{1, 1}, {1, 1}}, {4, 5}), 5.0);
  EXPECT_DOUBLE_EQ(length(Segment2{{0, 0}, {3, 4}}), 5.0);
  EXPECT_EQ(midpoint({{0, 2}, {4, 4}}), (Point2{2, 3}));
}

TEST(PolygonNormalized, TurnsRingsAndDropsWhatIsNoCorner) {
  const Polygon messy{{{0, 0}, {0, 2}, {0, 4}, {0, 4}, {4, 4}, {4, 0}, {2, 0}, {0, 0}},
                      {box(1, 1, 2, 2), {{3, 3}, {3, 3.5}, {3, 3.2}}}};
  const Polygon clean = normalized(messy);
  EXPECT_EQ(clean.outer.size(), 4U);
  EXPECT_DOUBLE_EQ(signedArea(clean.outer), 16.0);
  ASSERT_EQ(clean.holes.size(), 1U);
  EXPECT_DOUBLE_EQ(signedArea(clean.holes[0]), -1.0);
  EXPECT_TRUE(isSimple(clean));
}

TEST(PolygonNormalized, SpikesAreGone) {
  const Polygon spiked{{{0, 0}, {2, 0}, {9, 0}, {2, 0}, {2, 2}, {0, 2}}, {}};
  EXPECT_EQ(normalized(spiked).outer, box(0, 0, 2, 2));
}

TEST(PolygonNormalized, FirstVertexMayBeSuperfluousToo) {
  const Polygon rotated{{{1, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}, {}};
  EXPECT_EQ(normalized(rotated).outer.size(), 4U);
}

TEST(PolygonNormalized, NothingIsLeftOfALine) {
  const Polygon line{{{0, 0}, {1, 1}, {2, 2}}, {box(0, 0, 1, 1)}};
  EXPECT_TRUE(normalized(line).outer.empty());
  EXPECT_TRUE(normalized(line).holes.empty());
  EXPECT_TRUE(normalized({}).outer.empty());
}

TEST(PolygonTranslated, MovesHolesAlong) {
  const Polygon moved = translated(roomWithPillar(), 10, -1);
  EXPECT_EQ(moved.outer, box(10, -1, 14, 3));
  EXPECT_EQ(moved.holes.at(0), reversed(box(11, 0, 12, 1)));
}

}  // namespace
}  // namespace occusg
