// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "occusg/evaluation/alignment.hpp"
#include "occusg/evaluation/evaluated_room.hpp"

namespace occusg {

/// How predicted rooms are matched with annotated ones.
struct RoomMetricsOptions {
  Alignment alignment = Alignment::kNone;
  std::optional<Point2> first_robot_position;  ///< A start for Alignment::kSearch [m].
  /// IoU from which a matched pair is valid, in [0, 1]; the first is the main one.
  std::vector<double> thresholds{0.15, 0.50, 0.75};
  double boundary_tolerance_m = 0.25;  ///< Boundary samples nearer than this agree, >= 0 [m].
  double boundary_step_m = 0.10;       ///< Distance of boundary samples, > 0 [m].
  double contact_area_m2 = 0.1;        ///< Common area that counts as contact, > 0 [m2].
  double contact_share = 0.1;  ///< Share of a room that counts as relative contact, in (0, 1].
  double severe = 0.25;        ///< Count ratio or recall below this is severe, in [0, 1].
  /// The classic measures drop rooms up to this area: 100 cells of 0.05 m [m2], >= 0.
  double min_classic_area_m2 = 0.25;
};

/// Detection measures at one IoU threshold.
struct ThresholdMetrics {
  double threshold = 0.0;
  double matches = 0.0;            ///< Valid matches: pairs with IoU >= threshold.
  double recall = 0.0;             ///< Matches / annotated rooms.
  double precision = 0.0;          ///< Matches / predicted rooms.
  double f1 = 0.0;                 ///< Harmonic mean of both.
  std::optional<double> mean_iou;  ///< Mean IoU of the matches; undefined without one.
  double mean_iou_gt = 0.0;        ///< Sum of IoU / annotated rooms: a missed room counts 0.
  double mean_iou_full = 0.0;      ///< Sum of IoU / (matches + missed + surplus rooms).
  double boundary_f1 = 0.0;        ///< Mean over the matches, 0 without one.
};

/// What is computed for a scene and averaged over scenes. All 0 when there is nothing to divide by.
struct RoomScores {
  double predicted_area_m2 = 0.0;
  double truth_area_m2 = 0.0;
  std::vector<ThresholdMetrics> at;  ///< In the order of the thresholds asked for.
  double over_segmentation = 0.0;    ///< Share of annotated rooms in contact with > 1 prediction.
  double under_segmentation = 0.0;   ///< Share of predictions in contact with > 1 annotated room.
  double over_segmentation_relative = 0.0;   ///< Contact: a share of the annotated room.
  double under_segmentation_relative = 0.0;  ///< Contact: a share of the prediction.
  double count_ratio = 0.0;                  ///< Predicted / annotated rooms.
  /// Mean over predictions of the best covered share (Bormann et al., ICRA 2016).
  double classic_precision = 0.0;
  double classic_recall = 0.0;    ///< The same over annotated rooms.
  double pooled_precision = 0.0;  ///< Best covered area over all predictions / their area.
  double pooled_recall = 0.0;     ///< The same over annotated rooms.
  /// The same ratios named and counted as in the DuDe paper (Fermin-Leon et al., ICRA 2017), there
  /// without truncation: precision per annotated room, only where both sides have a label.
  double dude_precision = 0.0;
  double dude_recall = 0.0;  ///< Per predicted room.
};

/// A pair of the assignment that maximises the sum of IoU.
struct MatchedRooms {
  int predicted_id = 0;
  int truth_id = 0;
  double iou = 0.0;
  double boundary_f1 = 0.0;
};

/// Whether the pair's IoU reaches `threshold`, whatever was rounded.
[[nodiscard]] bool isValidMatch(const MatchedRooms& pair, double threshold);

/// Metrics of one scene.
struct RoomMetrics : RoomScores {
  std::size_t n_predicted = 0;
  std::size_t n_truth = 0;
  Alignment alignment = Alignment::kNone;
  Point2 shift;  ///< By which the annotated rooms were moved [m].
  /// Count ratio or recall at the main threshold is below `severe`.
  bool severe_under_segmentation = false;
  bool no_predictions = false;
  bool no_valid_matches = false;      ///< None at the main threshold, though there is a truth.
  std::vector<MatchedRooms> matched;  ///< Pairs with common area, in the order of the predictions.
};

/// Plain means over scenes.
struct RoomMetricsMean : RoomScores {
  std::size_t n_scenes = 0;
  double n_predicted = 0.0;
  double n_truth = 0.0;
  double severe_under_segmentation = 0.0;  ///< Share of the scenes.
  double no_predictions = 0.0;             ///< Share of the scenes.
  double no_valid_matches = 0.0;           ///< Share of the scenes.
};

/// Compares predicted with annotated rooms: one assignment of largest sum of IoU, of which each
/// threshold keeps the pairs above it; contacts and classic measures are independent of it.
/// Rooms come from `roomFrom`. O(n m) polygon intersections and an O(n^3) assignment.
/// @throws Error for options out of range, rooms without vertices and coordinates that are not
/// finite.
[[nodiscard]] RoomMetrics evaluateRooms(const std::vector<EvaluatedRoom>& predicted,
                                        const std::vector<EvaluatedRoom>& truth,
                                        const RoomMetricsOptions& options = {});

/// @throws Error naming scene `index` unless it has the thresholds of `first`, scene 0.
void requireSameThresholds(const RoomMetrics& scene, const RoomMetrics& first, std::size_t index);

/// Macro mean: every scene counts the same. A mean IoU is averaged over the scenes that have one.
/// @throws Error when the scenes differ in their thresholds.
[[nodiscard]] RoomMetricsMean macroMean(const std::vector<RoomMetrics>& scenes);

/// All metrics of a scene as JSON: {"n_gt", "n_pred", "align", "shift", "@0.15": {"matches", "R",
/// "P", "F1", "mIoU", "mIoU_gt", "mIoU_full", "bF1"}, ..., "oS", "uS", "oS_rel", "uS_rel", ...,
/// "pairs": [{"pred", "gt", "iou", "bF1"}]}. An undefined value is null.
[[nodiscard]] std::string toJson(const RoomMetrics& metrics);

}  // namespace occusg
