// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "occusg/geometry/polygon.hpp"
#include "rings.hpp"

namespace occusg {
namespace {

using testing::box;

Polygon roomWith(const std::vector<Ring>& holes) { return {box(0, 0, 8, 8), holes}; }

TEST(PolygonIsSimple, EitherSenseOfRotationIsFine) {
  EXPECT_TRUE(isSimple(roomWith({})));
  EXPECT_TRUE(isSimple({{{0, 0}, {0, 1}, {1, 0}}, {}}));
  EXPECT_TRUE(isSimple({{{0, 0}, {1, 0}, {2, 0}, {2, 2}}, {}})) << "collinear vertex";
}

TEST(PolygonIsSimple, DegenerateRingsAreNot) {
  EXPECT_FALSE(isSimple({}));
  EXPECT_FALSE(isSimple({{{0, 0}, {1, 1}}, {}}));
  EXPECT_FALSE(isSimple({{{0, 0}, {1, 1}, {2, 2}}, {}}));
  EXPECT_FALSE(isSimple({{{0, 0}, {1, 0}, {1, 0}, {1, 1}}, {}})) << "repeated vertex";
  EXPECT_FALSE(isSimple(roomWith({{{1, 1}, {2, 2}}})));
}

TEST(PolygonIsSimple, CoordinatesMustBeFinite) {
  EXPECT_FALSE(isSimple({{{0, 0}, {1, 0}, {std::numeric_limits<double>::quiet_NaN(), 1}}, {}}));
  EXPECT_FALSE(isSimple({{{0, 0}, {1, 0}, {1, std::numeric_limits<double>::infinity()}}, {}}));
}

TEST(PolygonIsSimple, RingMustNotCrossOrTouchItself) {
  EXPECT_FALSE(isSimple({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}})) << "bow tie";
  EXPECT_FALSE(isSimple({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, {}})) << "vertex on an edge";
  EXPECT_FALSE(isSimple({{{0, 0}, {4, 0}, {4, 4}, {4, 0}, {2, 2}}, {}})) << "spike";
}

TEST(PolygonIsSimple, HolesMayTouchInPointsOnly) {
  EXPECT_TRUE(isSimple(roomWith({box(1, 1, 2, 2)})));
  EXPECT_TRUE(isSimple(roomWith({box(1, 1, 2, 2), box(2, 2, 3, 3)}))) << "corner to corner";
  EXPECT_TRUE(isSimple(roomWith({{{0, 4}, {2, 3}, {2, 5}}}))) << "corner on the outer edge";
  EXPECT_TRUE(isSimple(roomWith({{{0, 0}, {2, 1}, {1, 2}}}))) << "corner on the outer corner";
  EXPECT_FALSE(isSimple(roomWith({box(0, 1, 2, 2)}))) << "shares part of the outer edge";
  EXPECT_FALSE(isSimple(roomWith({box(1, 1, 2, 2), box(2, 1, 3, 2)}))) << "share an edge";
}

TEST(PolygonIsSimple, RingsMustNotCross) {
  EXPECT_FALSE(isSimple(roomWith({box(6, 6, 9, 7)}))) << "through an edge";
  EXPECT_FALSE(isSimple(roomWith({box(1, 1, 3, 3), box(2, 2, 4, 4)})));
  EXPECT_FALSE(isSimple(roomWith({{{7, 7}, {8, 8}, {9, 7}}}))) << "out through a corner";
  EXPECT_FALSE(isSimple(roomWith({{{7, 1}, {8, 2}, {9, 5}, {8, 6}, {7, 7}}})))
      << "out and in through vertices of its own";
  EXPECT_FALSE(isSimple({{{0, 0}, {8, 0}, {4, 4}, {8, 8}, {0, 8}}, {{{3, 3}, {5, 4}, {3, 5}}}}))
      << "over a reflex corner";
}

TEST(PolygonIsSimple, TouchingAReflexCornerFromInsideIsFine) {
  const Ring arrow{{0, 0}, {8, 0}, {4, 4}, {8, 8}, {0, 8}};
  EXPECT_TRUE(isSimple({arrow, {{{2, 3}, {4, 4}, {2, 5}}}}));
  EXPECT_TRUE(isSimple({arrow, {{{2, 3}, {5, 2}, {4, 4}, {2, 5}}}}));
}

TEST(PolygonIsSimple, HolesLieInsideAndNotInEachOther) {
  EXPECT_FALSE(isSimple(roomWith({box(10, 10, 12, 12)})));
  EXPECT_FALSE(isSimple(roomWith({box(-1, -1, 9, 9)})));
  EXPECT_FALSE(isSimple(roomWith({box(1, 1, 5, 5), box(2, 2, 3, 3)})));
  EXPECT_FALSE(isSimple(roomWith({box(2, 2, 3, 3), box(1, 1, 5, 5)})));
  EXPECT_FALSE(isSimple(roomWith({box(1, 1, 2, 2), box(1, 1, 2, 2)}))) << "twice the same";
}

TEST(PolygonIsSimple, HoleTouchingWithEveryVertexIsJudgedByItsEdges) {
  const Ring diamond{{4, 0}, {8, 4}, {4, 8}, {0, 4}};
  EXPECT_TRUE(isSimple(roomWith({diamond})));
  EXPECT_FALSE(isSimple({diamond, {{{0, 4}, {4, 8}, {8, 4}}}})) << "shares edges";
  const Ring notched{{0, 0}, {8, 0}, {8, 8}, {5, 8}, {4, 2}, {3, 8}, {0, 8}};
  EXPECT_FALSE(isSimple({notched, {{{3, 8}, {4, 2}, {5, 8}}}})) << "fills the notch";
}

TEST(PolygonIsSimple, ManyPillarsAreJudgedQuickly) {
  Polygon hall{box(0, 0, 101, 101), {}};
  for (int x = 0; x < 25; ++x)
    for (int y = 0; y < 25; ++y)
      hall.holes.push_back(box(4 * x + 1, 4 * y + 1, 4 * x + 3, 4 * y + 3));
  EXPECT_TRUE(isSimple(hall));
  hall.holes.push_back(box(98, 98, 100, 100));
  EXPECT_FALSE(isSimple(hall));
}

}  // namespace
}  // namespace occusg
