// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/boundary_f1.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "occusg/error.hpp"
#include "rooms.hpp"

namespace occusg {
namespace {

using testing::box;

EvaluatedRoom room(const Ring& outer, const std::vector<Ring>& holes = {}) {
  return {1, {Polygon{outer, holes}}};
}

TEST(BoundarySamples, StartAtTheFirstVertexAndKeepTheirDistance) {
  const auto samples = boundarySamples(room(box(0, 0, 4, 4)), 1.0);
  ASSERT_EQ(samples.size(), 16U);
  EXPECT_EQ(samples[0], (Point2{0, 0}));
  EXPECT_EQ(samples[1], (Point2{1, 0}));
  EXPECT_EQ(samples[4], (Point2{4, 0}));
  EXPECT_EQ(samples[15], (Point2{0, 1}));
}

TEST(BoundarySamples, AsManyAsStepsBegun) {
  EXPECT_EQ(boundarySamples(room(box(0, 0, 4, 4)), 0.1).size(), 160U);
  EXPECT_EQ(boundarySamples(room(box(0, 0, 4, 4)), 0.3).size(), 54U);
  EXPECT_EQ(boundarySamples(room(box(0, 0, 4, 4)), 100.0).size(), 1U);
}

TEST(BoundarySamples, HolesFollowWhereTheOuterRingEnds) {
  const auto samples = boundarySamples(room(box(0, 0, 4, 4), {box(1, 1, 2, 2)}), 1.0);
  ASSERT_EQ(samples.size(), 20U);
  EXPECT_EQ(samples[16], (Point2{1, 1})) << "a point at the end of a ring belongs to the next";
  EXPECT_EQ(samples[17], (Point2{2, 1}));
}

TEST(BoundarySamples, AllPartsCount) {
  const EvaluatedRoom two{1, {{box(0, 0, 1, 1), {}}, {box(5, 0, 6, 1), {}}}};
  const auto samples = boundarySamples(two, 1.0);
  ASSERT_EQ(samples.size(), 8U);
  EXPECT_EQ(samples[4], (Point2{5, 0}));
}

TEST(BoundarySamples, NoneWithoutLength) {
  EXPECT_TRUE(boundarySamples({}, 0.1).empty());
  EXPECT_TRUE(boundarySamples(room({{1, 1}, {1, 1}}), 0.1).empty());
}

TEST(BoundarySamples, RefusesStepsThatAreNotPositiveOrTooShort) {
  EXPECT_THROW((void)boundarySamples(room(box(0, 0, 4, 4)), 0.0), Error);
  EXPECT_THROW((void)boundarySamples(room(box(0, 0, 4, 4)), std::nan("")), Error);
  EXPECT_THROW((void)boundarySamples(room(box(0, 0, 1e9, 1e9)), 0.1), Error);
}

TEST(BoundaryF1, IsOneWithinTheToleranceAndZeroBeyond) {
  const EvaluatedRoom truth = room(box(0, 0, 4, 4));
  EXPECT_EQ(boundaryF1(truth, truth, 0.25, 0.1), 1.0);
  EXPECT_EQ(boundaryF1(room(box(-0.25, -0.25, 4.25, 4.25)), truth, 0.36, 0.1), 1.0);
  EXPECT_EQ(boundaryF1(room(box(1, 1, 3, 3)), truth, 0.25, 0.1), 0.0);
}

TEST(BoundaryF1, PointAtTheToleranceCounts) {
  const EvaluatedRoom truth = room(box(0, 0, 4, 4));
  const EvaluatedRoom inside = room(box(0.25, 0.25, 3.75, 3.75));
  // All points of the inner box lie at 0.25 m; of the outer, all but the corners' last steps do.
  const double recall = (160.0 - 4 * 5.0) / 160.0;  // 0, 0.1, 0.2 m from a corner, on both sides
  EXPECT_NEAR(boundaryF1(inside, truth, 0.25, 0.1), 2 * recall / (1 + recall), 1e-12);
}

TEST(BoundaryF1, MissedHoleLowersTheRecallAlone) {
  const EvaluatedRoom truth = room(box(0, 0, 4, 4), {box(1.5, 1.5, 2.5, 2.5)});
  const double recall = 160.0 / 200.0;
  EXPECT_NEAR(boundaryF1(room(box(0, 0, 4, 4)), truth, 0.25, 0.1), 2 * recall / (1 + recall),
              1e-12);
}

TEST(BoundaryF1, OfNothingIsZero) { EXPECT_EQ(boundaryF1({}, {}, 0.25, 0.1), 0.0); }

}  // namespace
}  // namespace occusg
