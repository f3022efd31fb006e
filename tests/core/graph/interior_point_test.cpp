// SPDX-License-Identifier: BSD-3-Clause
#include "graph/interior_point.hpp"

#include <gtest/gtest.h>

#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::rectangle;

TEST(InteriorPoint, IsTheCentroidOfAConvexRoom) {
  const Point2 point = interiorPoint(rectangle(1.0, 2.0, 5.0, 4.0));
  EXPECT_DOUBLE_EQ(point.x, 3.0);
  EXPECT_DOUBLE_EQ(point.y, 3.0);
}

TEST(InteriorPoint, LiesInsideARoomWhoseCentroidDoesNot) {
  const Polygon u_shape{{{0, 0}, {9, 0}, {9, 9}, {7, 9}, {7, 1}, {2, 1}, {2, 9}, {0, 9}}, {}};
  ASSERT_FALSE(contains(u_shape, centroid(u_shape)));
  const Point2 point = interiorPoint(u_shape);
  EXPECT_TRUE(contains(u_shape, point));
  EXPECT_GE(boundaryDistance(u_shape, point), 1.0 - 0.05);
}

TEST(InteriorPoint, LeavesACentroidThatIsSqueezedAgainstAWall) {
  // An L whose centroid lies 0.19 m inside the inner corner.
  const Polygon l_shape{{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}}, {}};
  ASSERT_TRUE(!contains(l_shape, centroid(l_shape)) ||
              boundaryDistance(l_shape, centroid(l_shape)) < 0.5);
  const Point2 point = interiorPoint(l_shape);
  EXPECT_TRUE(contains(l_shape, point));
  EXPECT_GE(boundaryDistance(l_shape, point), 1.0);
}

TEST(InteriorPoint, AvoidsTheHoleOfARingCorridor) {
  Polygon ring = rectangle(0.0, 0.0, 10.0, 10.0);
  ring.holes = {{{1.5, 1.5}, {1.5, 8.5}, {8.5, 8.5}, {8.5, 1.5}}};
  const Point2 point = interiorPoint(ring);
  EXPECT_TRUE(contains(ring, point));
  EXPECT_GE(boundaryDistance(ring, point), 0.7);
}

TEST(InteriorPoint, OfASliverIsNotOutsideIt) {
  const Polygon sliver{{{0, 0}, {100, 0}, {100, 100}, {99.98, 100}, {99.98, 0.02}, {0, 0.02}}, {}};
  EXPECT_TRUE(contains(sliver, interiorPoint(sliver)));
}

}  // namespace
}  // namespace occusg
