// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/evaluated_room.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "occusg/error.hpp"
#include "rooms.hpp"

namespace occusg {
namespace {

using testing::box;

TEST(EvaluatedRoom, SoundPolygonIsKeptAsGiven) {
  const Ring clockwise{{0, 4}, {4, 4}, {4, 2}, {4, 0}, {0, 0}};
  const auto room = roomFrom(7, {clockwise, {box(1, 1, 2, 2)}}, "rooms.json");
  ASSERT_TRUE(room.has_value());
  EXPECT_EQ(room->id, 7);
  ASSERT_EQ(room->parts.size(), 1U);
  EXPECT_EQ(room->parts[0].outer, clockwise) << "samples depend on the vertices";
  EXPECT_DOUBLE_EQ(area(*room), 15.0);
}

TEST(EvaluatedRoom, RepeatedVerticesAndHolesWithoutAreaAreDropped) {
  const auto room = roomFrom(
      1, {{{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}, {{{1, 1}, {2, 2}}}}, "rooms.json");
  ASSERT_TRUE(room.has_value());
  EXPECT_EQ(room->parts.at(0).outer, box(0, 0, 4, 4));
  EXPECT_TRUE(room->parts.at(0).holes.empty());
}

TEST(EvaluatedRoom, TangledPolygonIsTheSumOfItsPieces) {
  const auto room = roomFrom(1, {{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {}}, "rooms.json");
  ASSERT_TRUE(room.has_value());
  EXPECT_EQ(room->parts.size(), 2U);
  EXPECT_NEAR(area(*room), 8.0, 1e-6);
  EXPECT_NEAR(centroid(*room).x, 2.0, 1e-6);
  EXPECT_NEAR(centroid(*room).y, 2.0, 1e-6);
  const EvaluatedRoom left{2, {{box(0, 0, 2, 4), {}}}};
  EXPECT_NEAR(intersectionArea(*room, left), 4.0, 1e-6);
  EXPECT_NEAR(centroid(translated(*room, {3, -1})).x, 5.0, 1e-6);
}

TEST(EvaluatedRoom, IsNothingWithoutArea) {
  EXPECT_FALSE(roomFrom(1, {}, "rooms.json").has_value());
  EXPECT_FALSE(roomFrom(1, {{{0, 0}, {1, 1}}, {}}, "rooms.json").has_value());
  EXPECT_FALSE(roomFrom(1, {{{0, 0}, {1, 1}, {2, 2}}, {}}, "rooms.json").has_value());
  EXPECT_FALSE(roomFrom(1, {box(0, 0, 1, 1), {box(0, 0, 1, 1)}}, "rooms.json").has_value())
      << "all hole";
}

TEST(EvaluatedRoom, RefusesCoordinatesThatAreNotUsableNamingTheRoom) {
  for (const double bad : {std::nan(""), -std::numeric_limits<double>::infinity(), 1e200}) {
    try {
      (void)roomFrom(42, {box(0, 0, 4, 4), {{{1, 1}, {2, 1}, {bad, 2}}}}, "rooms.json");
      FAIL() << "accepted " << bad;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("room 42"), std::string::npos) << error.what();
    }
  }
}

TEST(EvaluatedRoom, CheckNamesTheFirstUnusableRoom) {
  EXPECT_NO_THROW(check({}, "predicted room"));
  EXPECT_NO_THROW(check(testing::twoRooms(), "predicted room"));
  EXPECT_THROW(check({{3, {}}}, "predicted room"), Error);
  EXPECT_THROW(check({{3, {Polygon{}}}}, "predicted room"), Error);
  EXPECT_THROW(check({{3, {{{{0, 0}, {1, std::nan("")}}, {}}}}}, "predicted room"), Error);
}

TEST(EvaluatedRoom, CentroidWithoutPartsIsTheOrigin) {
  EXPECT_EQ(centroid(EvaluatedRoom{}), (Point2{0, 0}));
  EXPECT_EQ(area(EvaluatedRoom{}), 0.0);
}

}  // namespace
}  // namespace occusg
