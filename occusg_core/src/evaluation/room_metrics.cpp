// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/room_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "evaluation/assignment.hpp"
#include "evaluation/boundary_f1.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

/// Areas common to predicted (rows) and annotated rooms (columns), and their own [m2].
struct AreaTable {
  std::vector<std::vector<double>> common;
  std::vector<double> predicted;
  std::vector<double> truth;

  /// The common areas with annotated rooms as rows.
  [[nodiscard]] std::vector<std::vector<double>> byTruth() const {
    std::vector<std::vector<double>> rows(truth.size());
    for (std::size_t t = 0; t < truth.size(); ++t)
      for (const std::vector<double>& of_predicted : common) rows[t].push_back(of_predicted[t]);
    return rows;
  }
};

/// Relative slack of every "at least": 40 cells of 0.05 m are 0.1 m2 whatever was rounded.
constexpr double kRounding = 1e-9;

bool atLeast(double value, double limit) { return value >= limit * (1.0 - kRounding); }

double ratio(double a, double b) { return b > 0.0 ? a / b : 0.0; }

double harmonicMean(double a, double b) { return ratio(2.0 * a * b, a + b); }

double sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

void requireRange(const std::string& name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw refuse("room metrics option " + name, std::to_string(value),
               "must be in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
}

void check(const RoomMetricsOptions& options) {
  constexpr double kSmallest = 1e-9;
  constexpr double kLargest = 1e9;
  if (options.thresholds.empty())
    throw refuse("room metrics option thresholds", "none", "must be at least one");
  for (const double threshold : options.thresholds) requireRange("thresholds", threshold, 0.0, 1.0);
  requireRange("boundary_tolerance_m", options.boundary_tolerance_m, 0.0, kLargest);
  requireRange("boundary_step_m", options.boundary_step_m, kSmallest, kLargest);
  requireRange("contact_area_m2", options.contact_area_m2, kSmallest, kLargest);
  requireRange("contact_share", options.contact_share, kSmallest, 1.0);
  requireRange("severe", options.severe, 0.0, 1.0);
  requireRange("min_classic_area_m2", options.min_classic_area_m2, 0.0, kLargest);
}

/// Pairs of rooms, whose time grows with the square of the rooms: about ten seconds.
constexpr std::size_t kMaxComparedPairs = 100'000'000;

std::vector<double> areasOf(const std::vector<EvaluatedRoom>& rooms) {
  std::vector<double> areas;
  areas.reserve(rooms.size());
  for (const EvaluatedRoom& room : rooms) areas.push_back(area(room));
  return areas;
}

AreaTable tableOf(const std::vector<EvaluatedRoom>& predicted,
                  const std::vector<EvaluatedRoom>& truth) {
  if (predicted.size() * truth.size() > kMaxComparedPairs) {
    throw refuse("room metrics",
                 std::to_string(predicted.size()) + " predicted and " +
                     std::to_string(truth.size()) + " annotated rooms",
                 "at most " + std::to_string(kMaxComparedPairs) + " pairs can be compared");
  }
  AreaTable table{{}, areasOf(predicted), areasOf(truth)};
  for (const EvaluatedRoom& p : predicted) {
    table.common.emplace_back();
    for (const EvaluatedRoom& t : truth) table.common.back().push_back(intersectionArea(p, t));
  }
  return table;
}

std::vector<std::vector<double>> overlapsOf(const AreaTable& table) {
  auto iou = table.common;
  for (std::size_t p = 0; p < iou.size(); ++p) {
    for (std::size_t t = 0; t < iou[p].size(); ++t) {
      const double common = table.common[p][t];
      iou[p][t] = ratio(common, table.predicted[p] + table.truth[t] - common);
    }
  }
  return iou;
}

std::vector<MatchedRooms> matchedRooms(const AreaTable& table,
                                       const std::vector<EvaluatedRoom>& predicted,
                                       const std::vector<EvaluatedRoom>& truth,
                                       const RoomMetricsOptions& options) {
  const auto iou = overlapsOf(table);
  const std::vector<int> truth_of = maxSumAssignment(iou);
  std::vector<MatchedRooms> matched;
  for (std::size_t p = 0; p < predicted.size(); ++p) {
    if (truth_of[p] < 0) continue;
    const auto t = static_cast<std::size_t>(truth_of[p]);
    if (!(iou[p][t] > 0.0)) continue;
    const double boundary_f1 =
        boundaryF1(predicted[p], truth[t], options.boundary_tolerance_m, options.boundary_step_m);
    matched.push_back({predicted[p].id, truth[t].id, iou[p][t], boundary_f1});
  }
  return matched;
}

ThresholdMetrics metricsAt(double threshold, const std::vector<MatchedRooms>& matched,
                           double n_predicted, double n_truth) {
  ThresholdMetrics metrics;
  metrics.threshold = threshold;
  double iou_sum = 0.0;
  double boundary_f1_sum = 0.0;
  for (const MatchedRooms& pair : matched) {
    if (!isValidMatch(pair, threshold)) continue;
    metrics.matches += 1.0;
    iou_sum += pair.iou;
    boundary_f1_sum += pair.boundary_f1;
  }
  metrics.recall = ratio(metrics.matches, n_truth);
  metrics.precision = ratio(metrics.matches, n_predicted);
  metrics.f1 = harmonicMean(metrics.precision, metrics.recall);
  if (metrics.matches > 0.0) metrics.mean_iou = iou_sum / metrics.matches;
  metrics.mean_iou_gt = ratio(iou_sum, n_truth);
  metrics.mean_iou_full = ratio(iou_sum, n_predicted + n_truth - metrics.matches);
  metrics.boundary_f1 = ratio(boundary_f1_sum, metrics.matches);
  return metrics;
}

/// True when more than one of the common areas is a contact.
bool touchesSeveral(const std::vector<double>& common, double contact_area) {
  return std::count_if(common.begin(), common.end(), [contact_area](double area) {
           return area > 0.0 && atLeast(area, contact_area);
         }) > 1;
}

/// Share of rooms in contact with several of the other side.
struct SplitShares {
  double absolute = 0.0;  ///< A contact is an area.
  double relative = 0.0;  ///< A contact is a share of the room.
};

/// @param common for each room its common areas with the other side.
SplitShares splitShares(const std::vector<std::vector<double>>& common,
                        const std::vector<double>& own, const RoomMetricsOptions& options) {
  double absolute = 0.0;
  double relative = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (touchesSeveral(common[i], options.contact_area_m2)) absolute += 1.0;
    if (touchesSeveral(common[i], options.contact_share * own[i])) relative += 1.0;
  }
  const auto count = static_cast<double>(own.size());
  return {ratio(absolute, count), ratio(relative, count)};
}

void addSegmentation(const AreaTable& table, const RoomMetricsOptions& options,
                     RoomScores& scores) {
  const SplitShares truth = splitShares(table.byTruth(), table.truth, options);
  const SplitShares predicted = splitShares(table.common, table.predicted, options);
  scores.over_segmentation = truth.absolute;
  scores.over_segmentation_relative = truth.relative;
  scores.under_segmentation = predicted.absolute;
  scores.under_segmentation_relative = predicted.relative;
}

/// How much of the rooms of one side the best room of the other covers.
struct BestCovered {
  double mean_share = 0.0;    ///< Mean of best common / own area.
  double pooled_share = 0.0;  ///< Sum of best common areas / sum of own areas.
};

/// @param common for each room its common areas with the other side.
BestCovered bestCovered(const std::vector<std::vector<double>>& common,
                        const std::vector<double>& own) {
  double best_sum = 0.0;
  double share_sum = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double best = largest(common[i]);
    best_sum += best;
    share_sum += ratio(best, own[i]);
  }
  return {ratio(share_sum, static_cast<double>(own.size())), ratio(best_sum, sum(own))};
}

/// The table of the rooms larger than `min_area` on both sides.
AreaTable withoutSmallRooms(const AreaTable& table, double min_area) {
  const double floor = min_area * (1.0 + kRounding);
  AreaTable kept;
  for (const double area : table.truth)
    if (area > floor) kept.truth.push_back(area);
  for (std::size_t p = 0; p < table.predicted.size(); ++p) {
    if (!(table.predicted[p] > floor)) continue;
    kept.predicted.push_back(table.predicted[p]);
    kept.common.emplace_back();
    for (std::size_t t = 0; t < table.truth.size(); ++t)
      if (table.truth[t] > floor) kept.common.back().push_back(table.common[p][t]);
  }
  return kept;
}

void addClassic(const AreaTable& whole, double min_area, RoomScores& scores) {
  const AreaTable table = withoutSmallRooms(whole, min_area);
  if (table.predicted.empty() || table.truth.empty()) return;
  const BestCovered precision = bestCovered(table.common, table.predicted);
  const BestCovered recall = bestCovered(table.byTruth(), table.truth);
  scores.classic_precision = precision.mean_share;
  scores.pooled_precision = precision.pooled_share;
  scores.classic_recall = recall.mean_share;
  scores.pooled_recall = recall.pooled_share;
}

void addDude(const AreaTable& table, RoomScores& scores) {
  const auto meanLargestShare = [](std::vector<std::vector<double>> common) {
    const auto unlabelled = [](const std::vector<double>& row) { return !(sum(row) > 0.0); };
    common.erase(std::remove_if(common.begin(), common.end(), unlabelled), common.end());
    std::vector<double> labelled;
    labelled.reserve(common.size());
    for (const std::vector<double>& row : common) labelled.push_back(sum(row));
    return bestCovered(common, labelled).mean_share;
  };
  scores.dude_precision = meanLargestShare(table.byTruth());
  scores.dude_recall = meanLargestShare(table.common);
}

void addFlags(const RoomMetricsOptions& options, RoomMetrics& metrics) {
  const ThresholdMetrics& main = metrics.at.front();
  const bool has_truth = metrics.n_truth > 0;
  metrics.no_predictions = metrics.n_predicted == 0;
  metrics.no_valid_matches = has_truth && main.matches == 0.0;
  metrics.severe_under_segmentation =
      has_truth && (metrics.count_ratio < options.severe || main.recall < options.severe);
}

}  // namespace

bool isValidMatch(const MatchedRooms& pair, double threshold) {
  return atLeast(pair.iou, threshold);
}

RoomMetrics evaluateRooms(const std::vector<EvaluatedRoom>& predicted,
                          const std::vector<EvaluatedRoom>& truth,
                          const RoomMetricsOptions& options) {
  check(options);
  check(predicted, "predicted room");
  check(truth, "annotated room");
  RoomMetrics metrics;
  metrics.n_predicted = predicted.size();
  metrics.n_truth = truth.size();
  metrics.alignment = options.alignment;
  metrics.shift = alignmentShift(predicted, truth, options.alignment, options.first_robot_position);
  std::vector<EvaluatedRoom> aligned;
  aligned.reserve(truth.size());
  for (const EvaluatedRoom& room : truth) aligned.push_back(translated(room, metrics.shift));

  const AreaTable table = tableOf(predicted, aligned);
  const auto n_predicted = static_cast<double>(predicted.size());
  const auto n_truth = static_cast<double>(truth.size());
  metrics.predicted_area_m2 = sum(table.predicted);
  metrics.truth_area_m2 = sum(table.truth);
  metrics.matched = matchedRooms(table, predicted, aligned, options);
  for (const double threshold : options.thresholds)
    metrics.at.push_back(metricsAt(threshold, metrics.matched, n_predicted, n_truth));
  metrics.count_ratio = ratio(n_predicted, n_truth);
  addSegmentation(table, options, metrics);
  addClassic(table, options.min_classic_area_m2, metrics);
  addDude(table, metrics);
  addFlags(options, metrics);
  return metrics;
}

}  // namespace occusg
