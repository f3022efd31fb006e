// SPDX-License-Identifier: BSD-3-Clause
#include "report/results_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "evaluation/score_estimates.hpp"
#include "io/json_text.hpp"
#include "occusg/evaluation/room_metrics.hpp"

namespace occusg {
namespace {

using nlohmann::json;

std::string keyOf(const char* name, double threshold) {
  char key[32];
  std::snprintf(key, sizeof key, "%s@%.2f", name, threshold);
  return key;
}

/// One column of the table: its name and value; no value where it is undefined.
using Field = std::pair<std::string, std::optional<double>>;

void appendThreshold(const std::string& head, const ThresholdMetrics& at,
                     std::vector<Field>& fields) {
  const auto add = [&](const char* name, std::optional<double> value) {
    fields.emplace_back(head + keyOf(name, at.threshold), value);
  };
  add("matches", at.matches);
  add("R", at.recall);
  add("P", at.precision);
  add("F1", at.f1);
  add("mIoU", at.mean_iou);
  add("mIoU_gt", at.mean_iou_gt);
  add("mIoU_full", at.mean_iou_full);
  add("bF1", at.boundary_f1);
}

void appendMetrics(const std::string& head, const RoomMetrics& metrics,
                   std::vector<Field>& fields) {
  fields.emplace_back(head + "n_gt", metrics.n_truth);
  fields.emplace_back(head + "n_pred", metrics.n_predicted);
  for (const ThresholdMetrics& at : metrics.at) appendThreshold(head, at, fields);
  fields.emplace_back(head + "oS", metrics.over_segmentation);
  fields.emplace_back(head + "uS", metrics.under_segmentation);
  fields.emplace_back(head + "oS_rel", metrics.over_segmentation_relative);
  fields.emplace_back(head + "uS_rel", metrics.under_segmentation_relative);
  fields.emplace_back(head + "severe", metrics.severe_under_segmentation ? 1.0 : 0.0);
}

void appendRelation(const std::string& head, const RelationScore& score,
                    std::vector<Field>& fields) {
  fields.emplace_back(head + "_R", score.recall());
  fields.emplace_back(head + "_P", score.precision());
  fields.emplace_back(head + "_F1", score.f1());
}

/// Without metrics the names of the columns alone.
std::vector<Field> fieldsOf(const SceneResult& result) {
  const RoomMetrics none = evaluateRooms({}, {});
  std::vector<Field> fields;
  appendMetrics("", result.metrics.value_or(none), fields);
  if (result.metrics) {
    fields.emplace_back("shift_x_m", result.metrics->shift.x);
    fields.emplace_back("shift_y_m", result.metrics->shift.y);
  } else {
    fields.emplace_back("shift_x_m", std::nullopt);
    fields.emplace_back("shift_y_m", std::nullopt);
    for (Field& field : fields) field.second.reset();
  }
  std::vector<Field> observed;
  appendMetrics("observed_", result.observed ? result.observed->metrics : none, observed);
  if (!result.observed)
    for (Field& field : observed) field.second.reset();
  fields.insert(fields.end(), observed.begin(), observed.end());
  appendRelation("adjacency", result.adjacency, fields);
  appendRelation("doors", result.doors, fields);
  const ObjectScore objects = result.objects.value_or(ObjectScore{});
  appendRelation("objects", objects.detection, fields);
  fields.emplace_back("containment", objects.containment());
  const auto total = std::find_if(result.times.begin(), result.times.end(),
                                  [](const StageTime& time) { return time.stage == "total"; });
  const bool is_timed = total != result.times.end();
  fields.emplace_back("frame_mean_ms", is_timed ? std::optional(total->mean_ms) : std::nullopt);
  fields.emplace_back("peak_mib", is_timed ? std::optional(total->memory_mib) : std::nullopt);
  return fields;
}

std::string csvText(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

json jsonOf(const RelationScore& score) {
  const auto value = [](std::optional<double> share) { return share ? json(*share) : json(); };
  return {{"n_gt", score.n_truth},      {"n_pred", score.n_predicted},   {"found", score.found},
          {"R", value(score.recall())}, {"P", value(score.precision())}, {"F1", value(score.f1())}};
}

json jsonOf(const ObjectScore& score) {
  json object = jsonOf(score.detection);
  object["in_a_room"] = score.in_a_room;
  object["in_right_room"] = score.in_right_room;
  object["containment"] = score.containment() ? json(*score.containment()) : json();
  object["mean_distance_m"] = score.mean_distance_m ? json(*score.mean_distance_m) : json();
  return object;
}

json jsonOf(const Estimate& estimate) {
  json object = {{"value", estimate.value ? json(*estimate.value) : json()}};
  if (estimate.confidence_95) {
    object["low"] = estimate.confidence_95->low;
    object["high"] = estimate.confidence_95->high;
  }
  return object;
}

json jsonOf(const ScoreEstimates& estimates) {
  json object = {{"oS", jsonOf(estimates.over_segmentation)},
                 {"uS", jsonOf(estimates.under_segmentation)}};
  for (const ThresholdEstimates& at : estimates.at) {
    object[keyOf("", at.threshold)] = {{"R", jsonOf(at.recall)},
                                       {"P", jsonOf(at.precision)},
                                       {"F1", jsonOf(at.f1)},
                                       {"mIoU", jsonOf(at.mean_iou)},
                                       {"mIoU_gt", jsonOf(at.mean_iou_gt)},
                                       {"bF1", jsonOf(at.boundary_f1)}};
  }
  return object;
}

json configurationJson(const BatchResults& batch, const std::string& name) {
  const auto metrics = metricsOf(batch, name);
  const auto count = [&](RunStatus status) {
    return std::count_if(batch.results.begin(), batch.results.end(), [&](const SceneResult& r) {
      return r.configuration == name && r.run.status == status;
    });
  };
  return {{"name", name},
          {"scenes", metrics.size()},
          {"failed", count(RunStatus::kFailed) + count(RunStatus::kTimedOut)},
          {"missing", count(RunStatus::kMissing)},
          {"macro", jsonOf(estimate(metrics, Averaging::kMacro))},
          {"micro", jsonOf(estimate(metrics, Averaging::kMicro))}};
}

json sceneJson(const SceneResult& result) {
  json object = {{"configuration", result.configuration}, {"scene", result.scene},
                 {"status", nameOf(result.run.status)},   {"problem", result.run.problem},
                 {"seconds", result.run.seconds},         {"notes", result.notes}};
  if (result.metrics) {
    object["metrics"] = json::parse(toJson(*result.metrics));
    object["adjacency"] = jsonOf(result.adjacency);
    object["doors"] = jsonOf(result.doors);
  }
  if (result.objects) object["objects"] = jsonOf(*result.objects);
  if (result.observed) {
    object["observed"] = json::parse(toJson(result.observed->metrics));
    object["observed"]["n_unseen"] = result.observed->n_unseen;
  }
  for (const StageTime& time : result.times) {
    object["timing"][time.stage] = {{"count", time.count},
                                    {"mean_ms", time.mean_ms},
                                    {"std_ms", time.std_ms},
                                    {"max_ms", time.max_ms},
                                    {"memory_mib", time.memory_mib}};
  }
  return object;
}

}  // namespace

std::string toCsv(const BatchResults& batch) {
  std::string text = "configuration,scene,status,problem,seconds";
  for (const Field& field : fieldsOf({})) text += "," + field.first;
  text += "\r\n";
  for (const SceneResult& result : batch.results) {
    text += csvText(result.configuration) + "," + csvText(result.scene) + "," +
            nameOf(result.run.status) + "," + csvText(result.run.problem) + "," +
            toText(result.run.seconds);
    for (const Field& field : fieldsOf(result))
      text += "," + (field.second ? toText(*field.second) : std::string());
    text += "\r\n";
  }
  return text;
}

std::string toJson(const BatchResults& batch) {
  json configurations = json::array();
  for (const std::string& name : batch.configurations)
    configurations.push_back(configurationJson(batch, name));
  json scenes = json::array();
  for (const SceneResult& result : batch.results) scenes.push_back(sceneJson(result));
  return jsonDocument({{"format", "occusg-batch-results"},
                       {"version", 1},
                       {"alignment", batch.alignment},
                       {"configurations", std::move(configurations)},
                       {"scenes", std::move(scenes)}});
}

}  // namespace occusg
