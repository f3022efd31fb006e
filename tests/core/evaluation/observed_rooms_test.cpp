// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/observed_rooms.hpp"

#include <gtest/gtest.h>

#include "rooms.hpp"

namespace occusg {
namespace {

using testing::box;
using testing::roomsOf;

/// A floor of 0.5 m cells of which those in `seen` were seen.
SeenFloor floorSeen(const CellBox& seen) {
  SeenFloor floor{{0.5}, {0, 0}, Grid<std::uint8_t>({{-20, -20}, {20, 20}}, 0)};
  for (int y = seen.min.y; y < seen.max.y; ++y)
    for (int x = seen.min.x; x < seen.max.x; ++x) floor.seen.at({x, y}) = 1;
  return floor;
}

TEST(ObservedRooms, ShareIsThatOfTheCells) {
  const EvaluatedRoom room = roomsOf({box(0, 0, 4, 4)}).front();
  EXPECT_DOUBLE_EQ(observedShare(room, floorSeen({{0, 0}, {8, 8}})), 1.0);
  EXPECT_DOUBLE_EQ(observedShare(room, floorSeen({{0, 0}, {2, 8}})), 0.25);
  EXPECT_DOUBLE_EQ(observedShare(room, floorSeen({{-8, 0}, {0, 8}})), 0.0);
}

TEST(ObservedRooms, HolesAreNotFloor) {
  const EvaluatedRoom ring{1, {{box(0, 0, 4, 4), {box(1, 1, 3, 3)}}}};
  EXPECT_DOUBLE_EQ(observedShare(ring, floorSeen({{2, 2}, {6, 6}})), 0.0);
}

TEST(ObservedRooms, OffsetOfTheMapCounts) {
  SeenFloor floor = floorSeen({{0, 0}, {8, 8}});
  floor.offset = {0.25, 0.0};
  const EvaluatedRoom room = roomsOf({box(0.25, 0, 4.25, 4)}).front();
  EXPECT_DOUBLE_EQ(observedShare(room, floor), 1.0);
}

TEST(ObservedRooms, BeyondTheMapNothingWasSeen) {
  const EvaluatedRoom far = roomsOf({box(1000, 1000, 1004, 1004)}).front();
  EXPECT_DOUBLE_EQ(observedShare(far, floorSeen({{0, 0}, {8, 8}})), 0.0);
  EXPECT_DOUBLE_EQ(observedShare(far, SeenFloor{}), 0.0);
}

TEST(ObservedRooms, RoomSmallerThanACellIsDecidedByTheCellItLiesIn) {
  const EvaluatedRoom tiny = roomsOf({box(0.1, 0.1, 0.2, 0.2)}).front();
  EXPECT_DOUBLE_EQ(observedShare(tiny, floorSeen({{0, 0}, {1, 1}})), 1.0);
  EXPECT_DOUBLE_EQ(observedShare(tiny, floorSeen({{1, 0}, {2, 1}})), 0.0);
}

TEST(ObservedRooms, HugeRoomIsSampled) {
  const EvaluatedRoom huge = roomsOf({box(-1e5, -1e5, 1e5, 1e5)}).front();
  EXPECT_LT(observedShare(huge, floorSeen({{0, 0}, {8, 8}})), 0.01);
}

TEST(ObservedRooms, AQuarterSeenIsEnough) {
  const auto truth = roomsOf({box(0, 0, 4, 4), box(4, 0, 8, 4)});
  const auto observed = observedRooms(truth, floorSeen({{0, 0}, {9, 8}}));
  ASSERT_EQ(observed.size(), 1U);
  EXPECT_EQ(observed[0].id, 1);
  EXPECT_EQ(observedRooms(truth, floorSeen({{0, 0}, {10, 8}})).size(), 2U);
}

}  // namespace
}  // namespace occusg
