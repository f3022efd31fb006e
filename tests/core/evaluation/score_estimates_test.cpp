// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/score_estimates.hpp"

#include <gtest/gtest.h>

#include "occusg/error.hpp"
#include "rooms.hpp"

namespace occusg {
namespace {

using testing::box;
using testing::roomsOf;
using testing::twoRooms;

/// One scene with two rooms found of two, one with one of four, one without any prediction.
std::vector<RoomMetrics> scenes() {
  const auto four = roomsOf({box(0, 0, 4, 4), box(4, 0, 8, 4), box(0, 4, 4, 8), box(4, 4, 8, 8)});
  return {evaluateRooms(twoRooms(), twoRooms()), evaluateRooms(roomsOf({box(0, 0, 4, 4)}), four),
          evaluateRooms({}, twoRooms())};
}

TEST(ScoreEstimates, MacroCountsScenesAndLeavesOutWhatIsUndefined) {
  const ScoreEstimates macro = estimate(scenes(), Averaging::kMacro);
  EXPECT_DOUBLE_EQ(macro.at[0].recall.value.value(), (1.0 + 0.25 + 0.0) / 3);
  EXPECT_DOUBLE_EQ(macro.at[0].mean_iou.value.value(), 1.0) << "the third scene has none";
}

TEST(ScoreEstimates, MicroCountsRooms) {
  const ScoreEstimates micro = estimate(scenes(), Averaging::kMicro);
  EXPECT_DOUBLE_EQ(micro.at[0].recall.value.value(), 3.0 / 8);
  EXPECT_DOUBLE_EQ(micro.at[0].precision.value.value(), 1.0);
  EXPECT_DOUBLE_EQ(micro.at[0].f1.value.value(), 6.0 / 11);
  EXPECT_DOUBLE_EQ(micro.at[0].mean_iou_gt.value.value(), 3.0 / 8);
}

TEST(ScoreEstimates, IntervalHoldsTheValueAndTheScenes) {
  for (const Averaging averaging : {Averaging::kMacro, Averaging::kMicro}) {
    const Estimate recall = estimate(scenes(), averaging).at[0].recall;
    ASSERT_TRUE(recall.confidence_95.has_value());
    EXPECT_LT(recall.confidence_95->low, *recall.value);
    EXPECT_GT(recall.confidence_95->high, *recall.value);
    EXPECT_GE(recall.confidence_95->low, 0.0);
    EXPECT_LE(recall.confidence_95->high, 1.0);
  }
}

TEST(ScoreEstimates, EqualScenesLeaveNoDoubt) {
  const RoomMetrics scene = evaluateRooms(roomsOf({box(0, 0, 8, 4)}), twoRooms());
  const Estimate iou = estimate({scene, scene, scene}, Averaging::kMacro).at[0].mean_iou;
  EXPECT_DOUBLE_EQ(iou.confidence_95->low, 0.5);
  EXPECT_DOUBLE_EQ(iou.confidence_95->high, 0.5);
}

TEST(ScoreEstimates, SameScenesGiveTheSameInterval) {
  const auto first = estimate(scenes(), Averaging::kMicro).at[1].f1.confidence_95;
  const auto second = estimate(scenes(), Averaging::kMicro).at[1].f1.confidence_95;
  EXPECT_EQ(first->low, second->low);
  EXPECT_EQ(first->high, second->high);
}

TEST(ScoreEstimates, OneSceneHasNoInterval) {
  const Estimate recall = estimate({scenes().front()}, Averaging::kMacro).at[0].recall;
  EXPECT_TRUE(recall.value.has_value());
  EXPECT_FALSE(recall.confidence_95.has_value());
}

TEST(ScoreEstimates, NoScenesAndNoRoomsDivideByNothing) {
  EXPECT_TRUE(estimate({}, Averaging::kMicro).at.empty());
  const RoomMetrics empty = evaluateRooms({}, {});
  for (const Averaging averaging : {Averaging::kMacro, Averaging::kMicro}) {
    const ScoreEstimates estimates = estimate({empty, empty}, averaging);
    EXPECT_EQ(estimates.at[0].f1.value, 0.0);
    EXPECT_FALSE(estimates.at[0].mean_iou.value.has_value());
    EXPECT_FALSE(estimates.at[0].mean_iou.confidence_95.has_value());
    EXPECT_EQ(estimates.over_segmentation.value, 0.0);
  }
}

TEST(ScoreEstimates, MixedThresholdsAreRefused) {
  RoomMetricsOptions other;
  other.thresholds = {0.5};
  EXPECT_THROW((void)estimate({evaluateRooms(twoRooms(), twoRooms()),
                               evaluateRooms(twoRooms(), twoRooms(), other)},
                              Averaging::kMacro),
               Error);
}

TEST(ScoreEstimates, DifferenceIsPairedByScene) {
  // Every scene gains 0.1, however different the scenes are.
  const Estimate gain = pairedDifference({0.1, 0.5, 0.8}, {0.2, 0.6, 0.9});
  EXPECT_NEAR(*gain.value, 0.1, 1e-12);
  EXPECT_NEAR(gain.confidence_95->low, 0.1, 1e-12);
  EXPECT_NEAR(gain.confidence_95->high, 0.1, 1e-12);
  EXPECT_FALSE(pairedDifference({}, {}).value.has_value());
  EXPECT_THROW((void)pairedDifference({0.1}, {}), Error);
}

}  // namespace
}  // namespace occusg
