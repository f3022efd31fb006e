// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/truth_check.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "error_sentence.hpp"
#include "rooms.hpp"

namespace occusg {
namespace {

using testing::box;
using testing::sentenceOf;
using testing::tells;

TEST(TruthCheck, SoundRoomsKeepTheirVerticesAndNeedNoNote) {
  const SoundTruth truth =
      soundTruth({{1, {box(0, 0, 4, 4), {}}, 0}, {2, {box(4, 0, 8, 4), {}}, 0}}, "truth.json");
  ASSERT_EQ(truth.rooms.size(), 2U);
  EXPECT_EQ(truth.rooms[0].parts.at(0).outer, box(0, 0, 4, 4));
  EXPECT_EQ(truth.rooms[1].id, 2);
  EXPECT_TRUE(truth.notes.empty());
}

TEST(TruthCheck, RoomWithoutAreaIsLeftOutAndSaidSo) {
  const SoundTruth truth = soundTruth(
      {{1, {box(0, 0, 4, 4), {}}, 0}, {7, {{{0, 0}, {1, 1}, {2, 2}}, {}}, 0}}, "truth.json");
  EXPECT_EQ(truth.rooms.size(), 1U);
  ASSERT_EQ(truth.notes.size(), 1U);
  EXPECT_TRUE(tells(truth.notes[0], {"truth.json: room 7", "no area"}));
}

TEST(TruthCheck, SmallLoopIsCutOffAndSaidSo) {
  // The left wall ends below the floor line and leaves a triangle of 0.01 m2 there.
  const Ring looped{{-0.1, 0}, {4, 0}, {4, 4}, {0, 4}, {0.1, -0.1}};
  const SoundTruth truth = soundTruth({{3, {looped, {}}, 0}}, "truth.json");
  ASSERT_EQ(truth.rooms.size(), 1U);
  EXPECT_EQ(truth.rooms[0].parts.size(), 1U);
  EXPECT_NEAR(area(truth.rooms[0]), 16.0, 0.2);
  ASSERT_EQ(truth.notes.size(), 1U);
  EXPECT_TRUE(tells(truth.notes[0], {"room 3", "crosses itself", "main piece"}));
}

TEST(TruthCheck, RoomThatFallsApartIsRefused) {
  const TruthRoom bow_tie{12, {{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {}}, 0};
  EXPECT_TRUE(tells(sentenceOf([&] { (void)soundTruth({bow_tie}, "truth.json"); }),
                    {"truth.json: room 12", "2 pieces"}));
}

TEST(TruthCheck, RoomDrawnTwiceIsLeftOutOnce) {
  const SoundTruth truth =
      soundTruth({{1, {box(0, 0, 4, 4), {}}, 0}, {2, {box(0, 0, 4, 4.01), {}}, 0}}, "truth.json");
  ASSERT_EQ(truth.rooms.size(), 1U);
  EXPECT_EQ(truth.rooms[0].id, 1);
  ASSERT_EQ(truth.notes.size(), 1U);
  EXPECT_TRUE(tells(truth.notes[0], {"room 2", "room 1 again"}));
}

TEST(TruthCheck, RoomWithinAnotherIsCutOutOfIt) {
  const SoundTruth truth =
      soundTruth({{1, {box(0, 0, 8, 4), {}}, 0}, {2, {box(1, 1, 3, 3), {}}, 0}}, "truth.json");
  ASSERT_EQ(truth.rooms.size(), 2U);
  EXPECT_NEAR(area(truth.rooms[0]), 28.0, 1e-6);
  EXPECT_NEAR(intersectionArea(truth.rooms[0], truth.rooms[1]), 0.0, 1e-6);
  ASSERT_EQ(truth.notes.size(), 1U);
  EXPECT_TRUE(tells(truth.notes[0], {"room 2", "within room 1"}));
}

TEST(TruthCheck, OverlapIsRefusedNamingBothRoomsAboveDrawingTolerance) {
  const auto overlapping = [](double depth_m) {
    return std::vector<TruthRoom>{{1, {box(0, 0, 4 + depth_m, 4), {}}, 0},
                                  {5, {box(4, 0, 8, 4), {}}, 0}};
  };
  const SoundTruth tolerated = soundTruth(overlapping(0.02), "truth.json");
  EXPECT_TRUE(tolerated.notes.empty());
  EXPECT_NEAR(area(tolerated.rooms[0]), 16.08, 1e-9);
  EXPECT_TRUE(tells(sentenceOf([&] { (void)soundTruth(overlapping(0.5), "truth.json"); }),
                    {"room 5", "overlaps room 1", "2.00 m2"}));
}

TEST(TruthCheck, StoreysMayLieAboveEachOther) {
  const SoundTruth truth =
      soundTruth({{1, {box(0, 0, 4, 4), {}}, 0}, {2, {box(0, 0, 4, 4), {}}, 1}}, "truth.json");
  EXPECT_EQ(truth.rooms.size(), 2U);
  EXPECT_TRUE(truth.notes.empty());
}

TEST(TruthCheck, RefusesCoordinatesThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(tells(sentenceOf([&] {
                      (void)soundTruth({{9, {box(0, 0, nan, 4), {}}, 0}}, "truth.json");
                    }),
                    {"truth.json: room 9"}));
}

TEST(TruthCheck, NoRoomsAreSound) { EXPECT_TRUE(soundTruth({}, "truth.json").rooms.empty()); }

}  // namespace
}  // namespace occusg
