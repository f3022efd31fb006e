// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/observed_rooms.hpp"
#include "evaluation/truth_check.hpp"
#include "io/object_records.hpp"
#include "occusg/io/rooms_file.hpp"

namespace occusg {

/// How the run of one scene ended.
enum class RunStatus {
  kDone,
  kFailed,    ///< Refused its input, or crashed.
  kTimedOut,  ///< Took longer than allowed and was ended.
  kMissing    ///< There is no prediction: not run yet, or not among external predictions.
};

[[nodiscard]] const char* nameOf(RunStatus status);

/// `run.json`, what a batch remembers of one run:
/// {"format": "occusg-batch-run", "version", "recording", "status", "problem", "seconds"}.
struct RunRecord {
  std::string recording;  ///< Absolute path of the folder.
  RunStatus status = RunStatus::kMissing;
  std::string problem;   ///< One sentence unless done.
  double seconds = 0.0;  ///< Wall time of the whole run.
};

[[nodiscard]] std::string toJson(const RunRecord& record);
/// @throws Error naming the value that cannot be used.
[[nodiscard]] RunRecord parseRunRecord(const std::string& text, const std::string& where);

/// A line of `timing.json`.
struct StageTime {
  std::string stage;
  double count = 0.0;
  double mean_ms = 0.0;
  double std_ms = 0.0;
  double max_ms = 0.0;
  double memory_mib = 0.0;
};

/// @throws Error naming the value that cannot be used.
[[nodiscard]] std::vector<StageTime> parseTiming(const std::string& text, const std::string& where);

/// What the folder of one scene holds after its run: `run.json`, `rooms.json`, and if present
/// `truth.json` (the recording's rooms.json), `truth_objects.json` (its objects.json),
/// `scene_graph.json`, `timing.json` and `free_space.yaml`.
struct SceneFiles {
  std::string configuration;
  std::string scene;
  RunRecord run;
  RoomsFile predicted;
  std::vector<ObjectRecord> predicted_objects;
  std::optional<RoomsFile> truth;
  std::vector<ObjectRecord> truth_objects;
  std::vector<StageTime> times;
  std::optional<SeenFloor> seen_floor;
  std::vector<std::string> notes;  ///< Files that could not be used, one sentence each.
};

/// Reads the folder of a scene. What cannot be read of the run makes it a failed one, with the
/// sentence as its problem; a truth that cannot be read, a note. Never throws `Error`.
[[nodiscard]] SceneFiles readSceneFolder(const std::string& folder,
                                         const std::string& configuration,
                                         const std::string& scene);

}  // namespace occusg
