// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/room_metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "occusg/error.hpp"
#include "rooms.hpp"

namespace occusg {
namespace {

using testing::box;
using testing::moved;
using testing::roomsOf;
using testing::twoRooms;

double f1(double a, double b) { return 2 * a * b / (a + b); }

TEST(RoomMetrics, PerfectPredictionScoresOneEverywhere) {
  const RoomMetrics metrics = evaluateRooms(twoRooms(), twoRooms());
  ASSERT_EQ(metrics.at.size(), 3U);
  for (const ThresholdMetrics& at : metrics.at) {
    EXPECT_EQ(at.matches, 2.0);
    EXPECT_DOUBLE_EQ(at.recall, 1.0);
    EXPECT_DOUBLE_EQ(at.precision, 1.0);
    EXPECT_DOUBLE_EQ(at.f1, 1.0);
    EXPECT_DOUBLE_EQ(at.mean_iou.value(), 1.0);
    EXPECT_DOUBLE_EQ(at.mean_iou_gt, 1.0);
    EXPECT_DOUBLE_EQ(at.mean_iou_full, 1.0);
    EXPECT_DOUBLE_EQ(at.boundary_f1, 1.0);
  }
  EXPECT_EQ(metrics.over_segmentation, 0.0);
  EXPECT_EQ(metrics.under_segmentation, 0.0);
  EXPECT_DOUBLE_EQ(metrics.classic_precision, 1.0);
  EXPECT_DOUBLE_EQ(metrics.classic_recall, 1.0);
  EXPECT_DOUBLE_EQ(metrics.pooled_precision, 1.0);
  EXPECT_DOUBLE_EQ(metrics.pooled_recall, 1.0);
  EXPECT_EQ(metrics.count_ratio, 1.0);
  EXPECT_FALSE(metrics.severe_under_segmentation);
  EXPECT_FALSE(metrics.no_predictions);
  EXPECT_FALSE(metrics.no_valid_matches);
  EXPECT_DOUBLE_EQ(metrics.predicted_area_m2, 32.0);
  EXPECT_DOUBLE_EQ(metrics.truth_area_m2, 32.0);
}

TEST(RoomMetrics, MergedRoomsLoseOne) {
  const RoomMetrics metrics = evaluateRooms(roomsOf({box(0, 0, 8, 4)}), twoRooms());
  const ThresholdMetrics& half = metrics.at[1];
  EXPECT_DOUBLE_EQ(half.recall, 0.5);
  EXPECT_DOUBLE_EQ(half.precision, 1.0);
  EXPECT_DOUBLE_EQ(half.f1, 2.0 / 3);
  EXPECT_DOUBLE_EQ(half.mean_iou.value(), 0.5);
  EXPECT_DOUBLE_EQ(half.mean_iou_gt, 0.25);
  EXPECT_DOUBLE_EQ(half.mean_iou_full, 0.25);
  EXPECT_EQ(metrics.at[2].matches, 0.0);
  EXPECT_FALSE(metrics.at[2].mean_iou.has_value());
  EXPECT_EQ(metrics.at[2].boundary_f1, 0.0);
  EXPECT_EQ(metrics.over_segmentation, 0.0);
  EXPECT_EQ(metrics.under_segmentation, 1.0);
  EXPECT_EQ(metrics.under_segmentation_relative, 1.0);
  EXPECT_DOUBLE_EQ(metrics.classic_precision, 0.5);
  EXPECT_DOUBLE_EQ(metrics.classic_recall, 1.0);
  EXPECT_DOUBLE_EQ(metrics.dude_precision, 1.0);
  EXPECT_DOUBLE_EQ(metrics.dude_recall, 0.5);
  // Of the 24 m around the prediction 12 m are shared with either room, and a tolerance more at
  // both ends; the room lacks its inner wall but for a tolerance at both ends.
  EXPECT_NEAR(metrics.at[0].boundary_f1, f1(12.5 / 24, 12.5 / 16), 0.02);
}

TEST(RoomMetrics, SplitRoomKeepsItsLargerPiece) {
  const RoomMetrics metrics =
      evaluateRooms(roomsOf({box(0, 0, 3, 4), box(3, 0, 4, 4)}), roomsOf({box(0, 0, 4, 4)}));
  EXPECT_EQ(metrics.at[2].recall, 1.0);
  EXPECT_EQ(metrics.at[2].precision, 0.5);
  EXPECT_DOUBLE_EQ(metrics.at[2].mean_iou.value(), 0.75);
  EXPECT_DOUBLE_EQ(metrics.at[2].mean_iou_full, 0.75 / 2);
  EXPECT_EQ(metrics.over_segmentation, 1.0);
  EXPECT_EQ(metrics.over_segmentation_relative, 1.0);
  EXPECT_EQ(metrics.under_segmentation, 0.0);
  EXPECT_DOUBLE_EQ(metrics.classic_precision, 1.0);
  EXPECT_DOUBLE_EQ(metrics.classic_recall, 0.75);
  EXPECT_DOUBLE_EQ(metrics.pooled_recall, 0.75);
  EXPECT_EQ(metrics.count_ratio, 2.0);
}

TEST(RoomMetrics, MatchingMaximisesTheSumOfOverlaps) {
  const auto predicted = roomsOf({box(0, 0, 8, 4), box(0, 0, 3, 4)});
  const RoomMetrics metrics = evaluateRooms(predicted, twoRooms());
  EXPECT_EQ(metrics.at[1].matches, 2.0);
  EXPECT_DOUBLE_EQ(metrics.at[1].mean_iou.value(), (0.5 + 0.75) / 2);
  ASSERT_EQ(metrics.matched.size(), 2U);
  EXPECT_EQ(metrics.matched[0].predicted_id, 1);
  EXPECT_EQ(metrics.matched[0].truth_id, 2);
  EXPECT_DOUBLE_EQ(metrics.matched[0].iou, 0.5);
  EXPECT_EQ(metrics.matched[1].predicted_id, 2);
  EXPECT_EQ(metrics.matched[1].truth_id, 1);
  // 35 of 140 points lie on the wrong wall and farther than 0.25 m from its ends; 55 of 160 of the
  // room lie more than 0.25 m beyond it.
  EXPECT_DOUBLE_EQ(metrics.matched[1].boundary_f1, f1(105.0 / 140, 105.0 / 160));
}

TEST(RoomMetrics, RaisingTheThresholdNeverReassigns) {
  RoomMetricsOptions options;
  options.thresholds = {0.6, 0.1};
  const auto predicted = roomsOf({box(0, 0, 8, 4), box(0, 0, 3, 4)});
  const RoomMetrics metrics = evaluateRooms(predicted, twoRooms(), options);
  EXPECT_EQ(metrics.at[0].matches, 1.0);
  EXPECT_DOUBLE_EQ(metrics.at[0].mean_iou.value(), 0.75);
  EXPECT_EQ(metrics.at[1].matches, 2.0);
}

TEST(RoomMetrics, OverlapAtTheThresholdIsAMatch) {
  const RoomMetrics metrics =
      evaluateRooms(roomsOf({box(0.05, 0.05, 0.2, 0.25)}), roomsOf({box(0.05, 0.05, 0.25, 0.25)}));
  EXPECT_EQ(metrics.at[2].matches, 1.0) << "12 of 16 cells";
}

TEST(RoomMetrics, ContactBeginsAtATenthOfASquareMetre) {
  const auto withWallAt = [](double x) {
    return evaluateRooms(roomsOf({box(0, 0, x, 4), box(x, 0, 8, 4)}), twoRooms());
  };
  EXPECT_EQ(withWallAt(4.02).over_segmentation, 0.0);
  EXPECT_EQ(withWallAt(4.02).under_segmentation, 0.0);
  EXPECT_EQ(withWallAt(4.03).over_segmentation, 0.5);
  EXPECT_EQ(withWallAt(4.03).under_segmentation, 0.5);
  EXPECT_EQ(withWallAt(4.03).over_segmentation_relative, 0.0);
  EXPECT_EQ(withWallAt(4.025).over_segmentation, 0.5) << "exactly 0.1 m2";
}

TEST(RoomMetrics, RelativeContactIsATenthOfTheRoom) {
  const auto withWallAt = [](double x) {
    return evaluateRooms(roomsOf({box(0, 0, x, 4), box(x, 0, 8, 4)}), twoRooms());
  };
  EXPECT_EQ(withWallAt(4.39).over_segmentation_relative, 0.0);
  EXPECT_EQ(withWallAt(4.40).over_segmentation_relative, 0.5);
  EXPECT_EQ(withWallAt(4.43).under_segmentation_relative, 0.0);
  EXPECT_EQ(withWallAt(4.45).under_segmentation_relative, 0.5);
}

TEST(RoomMetrics, NothingPredicted) {
  const RoomMetrics metrics = evaluateRooms({}, twoRooms());
  EXPECT_EQ(metrics.at[0].f1, 0.0);
  EXPECT_EQ(metrics.at[0].recall, 0.0);
  EXPECT_EQ(metrics.at[0].precision, 0.0);
  EXPECT_EQ(metrics.at[0].mean_iou_full, 0.0);
  EXPECT_FALSE(metrics.at[0].mean_iou.has_value());
  EXPECT_TRUE(metrics.no_predictions);
  EXPECT_TRUE(metrics.no_valid_matches);
  EXPECT_TRUE(metrics.severe_under_segmentation);
  EXPECT_EQ(metrics.classic_recall, 0.0);
}

TEST(RoomMetrics, NothingToFind) {
  const RoomMetrics metrics = evaluateRooms(twoRooms(), {});
  EXPECT_EQ(metrics.at[0].f1, 0.0);
  EXPECT_EQ(metrics.count_ratio, 0.0);
  EXPECT_FALSE(metrics.severe_under_segmentation);
  EXPECT_FALSE(metrics.no_valid_matches);
  EXPECT_FALSE(metrics.no_predictions);
  EXPECT_EQ(metrics.dude_recall, 0.0);
  const RoomMetrics nothing = evaluateRooms({}, {});
  EXPECT_TRUE(nothing.no_predictions);
  EXPECT_EQ(nothing.at[0].mean_iou_full, 0.0);
}

TEST(RoomMetrics, RoomsWithoutAreaDivideByNothing) {
  const std::vector<EvaluatedRoom> lines{{1, {{{{0, 0}, {1, 1}, {2, 2}}, {}}}},
                                         {2, {{{{0, 0}, {1, 0}, {2, 0}}, {}}}}};
  const RoomMetrics metrics = evaluateRooms(lines, lines);
  EXPECT_EQ(metrics.at[0].matches, 0.0);
  EXPECT_EQ(metrics.over_segmentation_relative, 0.0);
  EXPECT_EQ(metrics.classic_precision, 0.0);
  EXPECT_EQ(metrics.pooled_precision, 0.0);
  EXPECT_EQ(metrics.dude_precision, 0.0);
}

TEST(RoomMetrics, TooFewRoomsOrTooLittleRecallIsSevere) {
  const auto row = [](int count) {
    std::vector<Ring> rings;
    for (int i = 0; i < count; ++i) rings.push_back(box(4 * i, 0, 4 * i + 4, 4));
    return roomsOf(rings);
  };
  EXPECT_FALSE(evaluateRooms(row(2), row(8)).severe_under_segmentation);
  EXPECT_TRUE(evaluateRooms(row(1), row(8)).severe_under_segmentation);
  EXPECT_TRUE(evaluateRooms(moved(row(8), 0, 50), row(8)).severe_under_segmentation);
  EXPECT_TRUE(evaluateRooms(moved(row(8), 0, 50), row(8)).no_valid_matches);
}

TEST(RoomMetrics, ClassicMeasuresDropSmallRooms) {
  auto truth = twoRooms();
  truth.push_back({3, {{box(20, 0, 20.5, 0.5), {}}}});
  EXPECT_DOUBLE_EQ(evaluateRooms(twoRooms(), truth).classic_recall, 1.0) << "0.25 m2 is dropped";
  truth.back() = {3, {{box(20, 0, 20.5, 0.55), {}}}};
  EXPECT_DOUBLE_EQ(evaluateRooms(twoRooms(), truth).classic_recall, 2.0 / 3);
}

TEST(RoomMetrics, ConfettiHasClassicPrecisionOneAndOneRoomHasRecallOne) {
  std::vector<Ring> confetti;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 4; ++y) confetti.push_back(box(x, y, x + 1, y + 1));
  const RoomMetrics metrics = evaluateRooms(roomsOf(confetti), twoRooms());
  EXPECT_DOUBLE_EQ(metrics.classic_precision, 1.0);
  EXPECT_DOUBLE_EQ(metrics.classic_recall, 1.0 / 16);
  EXPECT_DOUBLE_EQ(metrics.dude_precision, 1.0 / 16) << "names are swapped there";
  EXPECT_DOUBLE_EQ(metrics.dude_recall, 1.0);
}

TEST(RoomMetrics, DudeCountsOnlyWhatIsLabelledOnBothSides) {
  const auto predicted = roomsOf({box(0, 0, 1, 4), box(50, 0, 54, 4)});
  const RoomMetrics metrics = evaluateRooms(predicted, twoRooms());
  EXPECT_DOUBLE_EQ(metrics.dude_precision, 1.0);
  EXPECT_DOUBLE_EQ(metrics.dude_recall, 1.0);
  EXPECT_DOUBLE_EQ(metrics.classic_precision, 0.5);
  EXPECT_DOUBLE_EQ(metrics.classic_recall, 0.125);
}

TEST(RoomMetrics, PillarIsAHoleInTheArea) {
  const std::vector<EvaluatedRoom> pillar{{1, {{box(0, 0, 4, 4), {box(1, 1, 3, 3)}}}}};
  const RoomMetrics metrics = evaluateRooms(roomsOf({box(0, 0, 4, 4)}), pillar);
  EXPECT_DOUBLE_EQ(metrics.truth_area_m2, 12.0);
  EXPECT_DOUBLE_EQ(metrics.at[0].mean_iou.value(), 0.75);
}

TEST(RoomMetrics, PartsOfARoomCountAsOne) {
  const std::vector<EvaluatedRoom> halves{{1, {{box(0, 0, 2, 4), {}}, {box(2, 0, 4, 4), {}}}}};
  const RoomMetrics metrics = evaluateRooms(halves, roomsOf({box(0, 0, 4, 4)}));
  EXPECT_DOUBLE_EQ(metrics.at[2].mean_iou.value(), 1.0);
  EXPECT_EQ(metrics.over_segmentation, 0.0);
}

TEST(RoomMetrics, ShiftOfOneSideLowersTheOverlapAsCalculated) {
  const RoomMetrics metrics =
      evaluateRooms(moved(roomsOf({box(0, 0, 4, 4)}), 0.35, 0), roomsOf({box(0, 0, 4, 4)}));
  EXPECT_NEAR(metrics.at[1].mean_iou.value(), 3.65 / 4.35, 1e-12);
}

TEST(RoomMetrics, AlignmentUndoesATranslation) {
  for (const Alignment alignment : {Alignment::kCentroid, Alignment::kSearch}) {
    RoomMetricsOptions options;
    options.alignment = alignment;
    const RoomMetrics metrics = evaluateRooms(moved(twoRooms(), 3, -1.5), twoRooms(), options);
    EXPECT_EQ(metrics.alignment, alignment);
    EXPECT_NEAR(metrics.shift.x, 3.0, 1e-9);
    EXPECT_NEAR(metrics.shift.y, -1.5, 1e-9);
    EXPECT_NEAR(metrics.at[2].mean_iou.value(), 1.0, 1e-6);
  }
}

TEST(RoomMetrics, SearchRecoversFromAMissingRoom) {
  const auto truth = roomsOf({box(0, 0, 4, 4), box(4, 0, 8, 4), box(0, 4, 4, 8)});
  RoomMetricsOptions options;
  options.alignment = Alignment::kSearch;
  EXPECT_DOUBLE_EQ(evaluateRooms(twoRooms(), truth, options).at[2].recall, 2.0 / 3);
}

TEST(RoomMetrics, RefusesOptionsOutOfRangeNamingThem) {
  const auto refused = [](const std::string& name, void (*change)(RoomMetricsOptions&)) {
    RoomMetricsOptions options;
    change(options);
    try {
      (void)evaluateRooms(twoRooms(), twoRooms(), options);
      ADD_FAILURE() << "accepted " << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  };
  refused("thresholds", [](RoomMetricsOptions& o) { o.thresholds.clear(); });
  refused("thresholds", [](RoomMetricsOptions& o) { o.thresholds = {0.5, 1.5}; });
  refused("thresholds", [](RoomMetricsOptions& o) { o.thresholds = {std::nan("")}; });
  refused("boundary_tolerance_m", [](RoomMetricsOptions& o) { o.boundary_tolerance_m = -0.1; });
  refused("boundary_step_m", [](RoomMetricsOptions& o) { o.boundary_step_m = 0.0; });
  refused("contact_area_m2", [](RoomMetricsOptions& o) { o.contact_area_m2 = 0.0; });
  refused("contact_share", [](RoomMetricsOptions& o) { o.contact_share = 1.5; });
  refused("severe", [](RoomMetricsOptions& o) { o.severe = -1.0; });
  refused("min_classic_area_m2", [](RoomMetricsOptions& o) { o.min_classic_area_m2 = -1.0; });
}

TEST(RoomMetrics, RefusesRoomsThatAreNotUsableNamingSideAndId) {
  const auto broken = roomsOf({box(0, 0, std::nan(""), 4)});
  for (const bool as_truth : {false, true}) {
    try {
      (void)(as_truth ? evaluateRooms(twoRooms(), broken) : evaluateRooms(broken, twoRooms()));
      FAIL() << "accepted";
    } catch (const Error& error) {
      const std::string expected = as_truth ? "annotated room 1" : "predicted room 1";
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW((void)evaluateRooms({{1, {}}}, twoRooms()), Error);
}

TEST(MacroMean, EverySceneCountsTheSame) {
  const RoomMetrics perfect = evaluateRooms(twoRooms(), twoRooms());
  const RoomMetrics merged = evaluateRooms(roomsOf({box(0, 0, 8, 4)}), twoRooms());
  const RoomMetrics missed = evaluateRooms({}, twoRooms());
  const RoomMetricsMean mean = macroMean({perfect, merged, missed});
  EXPECT_EQ(mean.n_scenes, 3U);
  EXPECT_DOUBLE_EQ(mean.n_predicted, 1.0);
  EXPECT_DOUBLE_EQ(mean.n_truth, 2.0);
  ASSERT_EQ(mean.at.size(), 3U);
  EXPECT_DOUBLE_EQ(mean.at[0].threshold, 0.15);
  EXPECT_DOUBLE_EQ(mean.at[0].recall, 0.5);
  EXPECT_DOUBLE_EQ(mean.at[0].matches, 1.0);
  EXPECT_DOUBLE_EQ(mean.at[0].f1, (1.0 + 2.0 / 3) / 3);
  EXPECT_DOUBLE_EQ(mean.at[0].mean_iou.value(), 0.75) << "the scene without a match is left out";
  EXPECT_DOUBLE_EQ(mean.at[2].mean_iou.value(), 1.0);
  EXPECT_DOUBLE_EQ(mean.under_segmentation, 1.0 / 3);
  EXPECT_DOUBLE_EQ(mean.classic_precision, 0.5);
  EXPECT_DOUBLE_EQ(mean.severe_under_segmentation, 1.0 / 3);
  EXPECT_DOUBLE_EQ(mean.no_predictions, 1.0 / 3);
  EXPECT_DOUBLE_EQ(mean.no_valid_matches, 1.0 / 3);
}

TEST(MacroMean, MeanOverlapIsUndefinedWhereNoSceneHasOne) {
  const RoomMetricsMean mean = macroMean({evaluateRooms({}, twoRooms())});
  EXPECT_FALSE(mean.at[0].mean_iou.has_value());
  EXPECT_EQ(mean.at[0].recall, 0.0);
}

TEST(MacroMean, OfNoScenesIsZero) {
  const RoomMetricsMean mean = macroMean({});
  EXPECT_EQ(mean.n_scenes, 0U);
  EXPECT_TRUE(mean.at.empty());
  EXPECT_EQ(mean.classic_recall, 0.0);
}

TEST(MacroMean, RefusesScenesWithDifferentThresholds) {
  RoomMetricsOptions options;
  options.thresholds = {0.3};
  EXPECT_THROW((void)macroMean({evaluateRooms({}, {}), evaluateRooms({}, {}, options)}), Error);
  options.thresholds = {0.15, 0.5, 0.7};
  EXPECT_THROW((void)macroMean({evaluateRooms({}, {}), evaluateRooms({}, {}, options)}), Error);
}

}  // namespace
}  // namespace occusg
