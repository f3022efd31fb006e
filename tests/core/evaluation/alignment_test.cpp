// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "occusg/error.hpp"
#include "rooms.hpp"

namespace occusg {
namespace {

using testing::box;
using testing::moved;
using testing::roomsOf;
using testing::twoRooms;

/// Three rooms, of which predictions below know two only.
std::vector<EvaluatedRoom> threeRooms() {
  return roomsOf({box(0, 0, 4, 4), box(4, 0, 8, 4), box(0, 4, 4, 8)});
}

void expectShift(const Point2& shift, double x, double y) {
  EXPECT_NEAR(shift.x, x, 1e-9);
  EXPECT_NEAR(shift.y, y, 1e-9);
}

TEST(Alignment, NoneNeverMoves) {
  expectShift(alignmentShift(moved(twoRooms(), 3, 1), twoRooms(), Alignment::kNone, {}), 0, 0);
}

TEST(Alignment, WithoutRoomsNothingMoves) {
  for (const Alignment alignment : {Alignment::kCentroid, Alignment::kSearch}) {
    expectShift(alignmentShift({}, twoRooms(), alignment, {}), 0, 0);
    expectShift(alignmentShift(twoRooms(), {}, alignment, {}), 0, 0);
  }
}

TEST(Alignment, CentroidAndSearchUndoATranslation) {
  for (const Alignment alignment : {Alignment::kCentroid, Alignment::kSearch})
    expectShift(alignmentShift(moved(twoRooms(), 3, -1.5), twoRooms(), alignment, {}), 3, -1.5);
}

TEST(Alignment, CentroidWeighsRoomsNotAreas) {
  const auto predicted = roomsOf({box(0, 0, 2, 2)});
  const auto truth = roomsOf({box(0, 0, 2, 2), box(10, 0, 30, 20)});
  expectShift(alignmentShift(predicted, truth, Alignment::kCentroid, {}), 1 - 10.5, 1 - 5.5);
}

TEST(Alignment, MissingRoomBiasesTheCentroid) {
  expectShift(alignmentShift(twoRooms(), threeRooms(), Alignment::kCentroid, {}), 2.0 / 3,
              -4.0 / 3);
}

TEST(Alignment, SearchComesBackToWithinOneStep) {
  const Point2 shift = alignmentShift(twoRooms(), threeRooms(), Alignment::kSearch, {});
  EXPECT_LE(std::max(std::abs(shift.x), std::abs(shift.y)), kAlignmentStep_m);
  const double steps = (shift.x - 2.0 / 3) / kAlignmentStep_m;
  EXPECT_NEAR(steps, std::round(steps), 1e-9) << "on the lattice of the start";
}

TEST(Alignment, SearchReachesTenMetresAndNoFarther) {
  const std::vector<EvaluatedRoom> room = roomsOf({box(0, 0, 4, 4)});
  const Point2 start{0, 0};
  const auto shiftTo = [&](double x, double y) {
    // A robot position makes the start known; the far room keeps the centroid from helping.
    auto truth = moved(room, -x, -y);
    truth.push_back({2, {{box(1000, 1000, 1001, 1001), {}}}});
    return alignmentShift(room, truth, Alignment::kSearch, start);
  };
  expectShift(shiftTo(10, -10), 10, -10);
  expectShift(shiftTo(-10, 9.5), -10, 9.5);
  expectShift(shiftTo(12, 0), 10, 0);
  expectShift(shiftTo(50, 0), 0, 0);
}

TEST(Alignment, RobotPositionIsTheStartWhenItOverlapsAtLeastAsMuch) {
  const auto truth = threeRooms();
  const auto predicted = moved(twoRooms(), 5.3, 2.1);
  expectShift(alignmentShift(predicted, truth, Alignment::kSearch, Point2{-5.3, -2.1}), 5.3, 2.1);
  const Point2 without = alignmentShift(predicted, truth, Alignment::kSearch, {});
  const Point2 useless = alignmentShift(predicted, truth, Alignment::kSearch, Point2{500, 500});
  expectShift(useless, without.x, without.y);
}

TEST(Alignment, TiesKeepTheStart) {
  const auto hall = roomsOf({box(0, 0, 30, 30)});
  const auto room = roomsOf({box(13, 13, 17, 17)});
  expectShift(alignmentShift(hall, room, Alignment::kSearch, {}), 0, 0);
  expectShift(alignmentShift(room, hall, Alignment::kSearch, {}), 0, 0);
}

TEST(Alignment, HolesDoNotCountAsOverlap) {
  // The centroids meet in the hole; 2 m to either side the bar lies on the ring, the lower x wins.
  const std::vector<EvaluatedRoom> ring{{1, {{box(0, 0, 6, 2), {box(2, 0.5, 4, 1.5)}}}}};
  const auto bar = roomsOf({box(7, 0, 9, 2)});
  expectShift(alignmentShift(ring, bar, Alignment::kSearch, {}), -7, 0);
}

TEST(Alignment, PlacesCoveredByTwoRoomsCountTwice) {
  // One corner of the hall holds two rooms, the other, larger one only one.
  const auto hall = roomsOf({box(0, 0, 6, 6), box(0, 0, 2, 2)});
  const auto room = roomsOf({box(3, 3, 5, 5)});
  expectShift(alignmentShift(hall, room, Alignment::kSearch, Point2{0, 0}), -3, -3);
}

TEST(Alignment, RefusesWhatWouldNeedAHugeRaster) {
  const auto wide = roomsOf({box(0, 0, 1e7, 1)});
  EXPECT_THROW((void)alignmentShift(wide, twoRooms(), Alignment::kSearch, {}), Error);
  const auto apart = roomsOf({box(0, 0, 1, 1), box(600, 600, 601, 601)});
  EXPECT_THROW((void)alignmentShift(apart, twoRooms(), Alignment::kSearch, {}), Error);
  EXPECT_NO_THROW((void)alignmentShift(twoRooms(), wide, Alignment::kSearch, {}));
}

TEST(Alignment, RefusesARobotPositionThatIsNotFinite) {
  const Point2 nowhere{std::numeric_limits<double>::quiet_NaN(), 0};
  EXPECT_THROW((void)alignmentShift(twoRooms(), twoRooms(), Alignment::kSearch, nowhere), Error);
}

}  // namespace
}  // namespace occusg
