// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstddef>
#include <string>

#include "occusg/error.hpp"
#include "occusg/evaluation/room_metrics.hpp"

namespace occusg {
namespace {

constexpr std::array<double RoomScores::*, 13> kScores{&RoomScores::predicted_area_m2,
                                                       &RoomScores::truth_area_m2,
                                                       &RoomScores::over_segmentation,
                                                       &RoomScores::under_segmentation,
                                                       &RoomScores::over_segmentation_relative,
                                                       &RoomScores::under_segmentation_relative,
                                                       &RoomScores::count_ratio,
                                                       &RoomScores::classic_precision,
                                                       &RoomScores::classic_recall,
                                                       &RoomScores::pooled_precision,
                                                       &RoomScores::pooled_recall,
                                                       &RoomScores::dude_precision,
                                                       &RoomScores::dude_recall};

constexpr std::array<double ThresholdMetrics::*, 7> kThresholdScores{
    &ThresholdMetrics::matches,    &ThresholdMetrics::recall,      &ThresholdMetrics::precision,
    &ThresholdMetrics::f1,         &ThresholdMetrics::mean_iou_gt, &ThresholdMetrics::mean_iou_full,
    &ThresholdMetrics::boundary_f1};

/// Mean at threshold `index`; the mean IoU is averaged over the scenes that have one.
ThresholdMetrics meanAt(const std::vector<RoomMetrics>& scenes, std::size_t index) {
  ThresholdMetrics mean;
  mean.threshold = scenes.front().at[index].threshold;
  double iou_sum = 0.0;
  double defined = 0.0;
  for (const RoomMetrics& scene : scenes) {
    const ThresholdMetrics& metrics = scene.at[index];
    for (const auto score : kThresholdScores) mean.*score += metrics.*score;
    if (!metrics.mean_iou) continue;
    iou_sum += *metrics.mean_iou;
    defined += 1.0;
  }
  for (const auto score : kThresholdScores) mean.*score /= static_cast<double>(scenes.size());
  if (defined > 0.0) mean.mean_iou = iou_sum / defined;
  return mean;
}

}  // namespace

void requireSameThresholds(const RoomMetrics& scene, const RoomMetrics& first, std::size_t index) {
  bool same = scene.at.size() == first.at.size();
  for (std::size_t i = 0; same && i < scene.at.size(); ++i)
    same = scene.at[i].threshold == first.at[i].threshold;
  if (same) return;
  throw refuse("scene " + std::to_string(index), "thresholds differ from those of scene 0",
               "must be the same in all scenes to be averaged");
}

RoomMetricsMean macroMean(const std::vector<RoomMetrics>& scenes) {
  RoomMetricsMean mean;
  mean.n_scenes = scenes.size();
  if (scenes.empty()) return mean;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    requireSameThresholds(scenes[i], scenes.front(), i);
  const auto meanOf = [&scenes](const auto& valueOf) {
    double sum = 0.0;
    for (const RoomMetrics& scene : scenes) sum += static_cast<double>(valueOf(scene));
    return sum / static_cast<double>(scenes.size());
  };
  for (const auto score : kScores)
    mean.*score = meanOf([score](const RoomMetrics& scene) { return scene.*score; });
  mean.n_predicted = meanOf([](const RoomMetrics& scene) { return scene.n_predicted; });
  mean.n_truth = meanOf([](const RoomMetrics& scene) { return scene.n_truth; });
  mean.severe_under_segmentation =
      meanOf([](const RoomMetrics& scene) { return scene.severe_under_segmentation; });
  mean.no_predictions = meanOf([](const RoomMetrics& scene) { return scene.no_predictions; });
  mean.no_valid_matches = meanOf([](const RoomMetrics& scene) { return scene.no_valid_matches; });
  for (std::size_t i = 0; i < scenes.front().at.size(); ++i) mean.at.push_back(meanAt(scenes, i));
  return mean;
}

}  // namespace occusg
