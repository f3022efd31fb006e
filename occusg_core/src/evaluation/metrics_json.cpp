// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <nlohmann/json.hpp>

#include "occusg/evaluation/room_metrics.hpp"

namespace occusg {
namespace {

using nlohmann::json;

const char* nameOf(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "none";
    case Alignment::kCentroid:
      return "centroid";
    case Alignment::kSearch:
      return "search";
  }
  return "";
}

std::string keyOf(double threshold) {
  char key[32];
  std::snprintf(key, sizeof key, "@%.2f", threshold);
  return key;
}

json toObject(const ThresholdMetrics& at) {
  return {{"matches", at.matches},
          {"R", at.recall},
          {"P", at.precision},
          {"F1", at.f1},
          {"mIoU", at.mean_iou ? json(*at.mean_iou) : json()},
          {"mIoU_gt", at.mean_iou_gt},
          {"mIoU_full", at.mean_iou_full},
          {"bF1", at.boundary_f1}};
}

}  // namespace

std::string toJson(const RoomMetrics& metrics) {
  json object = {{"n_gt", metrics.n_truth},
                 {"n_pred", metrics.n_predicted},
                 {"align", nameOf(metrics.alignment)},
                 {"shift", {metrics.shift.x, metrics.shift.y}},
                 {"pred_area", metrics.predicted_area_m2},
                 {"gt_area", metrics.truth_area_m2},
                 {"oS", metrics.over_segmentation},
                 {"uS", metrics.under_segmentation},
                 {"oS_rel", metrics.over_segmentation_relative},
                 {"uS_rel", metrics.under_segmentation_relative},
                 {"count_ratio", metrics.count_ratio},
                 {"severe_under_segmentation", metrics.severe_under_segmentation},
                 {"no_predictions", metrics.no_predictions},
                 {"no_valid_matches", metrics.no_valid_matches},
                 {"classic_P", metrics.classic_precision},
                 {"classic_R", metrics.classic_recall},
                 {"pooled_P", metrics.pooled_precision},
                 {"pooled_R", metrics.pooled_recall},
                 {"dude_P", metrics.dude_precision},
                 {"dude_R", metrics.dude_recall}};
  for (const ThresholdMetrics& at : metrics.at) object[keyOf(at.threshold)] = toObject(at);
  json pairs = json::array();
  for (const MatchedRooms& pair : metrics.matched) {
    pairs.push_back({{"pred", pair.predicted_id},
                     {"gt", pair.truth_id},
                     {"iou", pair.iou},
                     {"bF1", pair.boundary_f1}});
  }
  object["pairs"] = std::move(pairs);
  return object.dump(1) + "\n";
}

}  // namespace occusg
