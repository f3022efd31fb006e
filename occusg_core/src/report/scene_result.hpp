// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "occusg/evaluation/relation_metrics.hpp"
#include "occusg/evaluation/room_metrics.hpp"
#include "report/scene_folder.hpp"

namespace occusg {

/// The same metrics against those annotated rooms of which enough was seen.
struct ObservedMetrics {
  std::size_t n_unseen = 0;  ///< Annotated rooms that do not count.
  RoomMetrics metrics;
};

/// One scene under one configuration, evaluated: a row of every table.
struct SceneResult {
  std::string configuration;
  std::string scene;
  RunRecord run;
  std::vector<std::string> notes;  ///< Repairs of the truth and files left out, a sentence each.
  std::vector<StageTime> times;
  std::vector<EvaluatedRoom> predicted;
  std::vector<EvaluatedRoom> truth;       ///< Moved onto the prediction.
  std::vector<std::string> truth_labels;  ///< Of each room of `truth`.
  /// Undefined without a usable truth, and while the prediction is missing. A run that failed found
  /// no rooms.
  std::optional<RoomMetrics> metrics;
  std::optional<ObservedMetrics> observed;  ///< Undefined without a map of what was seen.
  RelationScore adjacency;
  RelationScore doors;
  std::optional<ObjectScore> objects;  ///< Undefined when no objects were predicted or annotated.
};

/// Evaluates what the folder of a scene holds.
/// @param seen_floor for predictions that come without a map: what another run of the scene saw.
[[nodiscard]] SceneResult evaluateScene(const SceneFiles& files, const RoomMetricsOptions& options,
                                        const std::optional<SeenFloor>& seen_floor);

/// All results of a batch.
struct BatchResults {
  std::vector<std::string> configurations;  ///< In the order of the tables.
  std::vector<std::string> scenes;
  std::string alignment;
  std::vector<SceneResult> results;  ///< Of each configuration and scene at most one.
};

/// Null when there is none.
[[nodiscard]] const SceneResult* resultOf(const BatchResults& batch,
                                          const std::string& configuration,
                                          const std::string& scene);

/// The metrics of one configuration's scenes that have any, in the order of the scenes.
[[nodiscard]] std::vector<RoomMetrics> metricsOf(const BatchResults& batch,
                                                 const std::string& configuration);

}  // namespace occusg
