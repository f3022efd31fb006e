// SPDX-License-Identifier: BSD-3-Clause
#include "report/scene_folder.hpp"

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "occusg/error.hpp"
#include "occusg/io/map_reader.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr const char* kRunFormat = "occusg-batch-run";
constexpr int kRunVersion = 1;
constexpr std::size_t kMaxFileBytes = std::size_t{256} << 20U;

constexpr std::array<RunStatus, 4> kStatuses{RunStatus::kDone, RunStatus::kFailed,
                                             RunStatus::kTimedOut, RunStatus::kMissing};

RunStatus statusNamed(const std::string& name, const std::string& where) {
  for (const RunStatus status : kStatuses)
    if (name == nameOf(status)) return status;
  throw refuse(where, "is '" + name + "'", "done, failed, timed out or missing is needed");
}

std::string pathIn(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

std::optional<std::string> bytesIfThere(const std::string& folder, const std::string& name) {
  std::error_code ignored;
  const std::string path = pathIn(folder, name);
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  return readFile(path, kMaxFileBytes);
}

std::optional<SeenFloor> seenFloorIn(const std::string& folder) {
  std::error_code ignored;
  const std::string path = pathIn(folder, "free_space.yaml");
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  const GridMap map = readMap(path);
  SeenFloor floor{map.free_space.frame, map.in_map.offset,
                  Grid<std::uint8_t>(map.free_space.cells.box(), 0)};
  const Grid<std::int8_t> cells = map.free_space.cells.dense();
  for (std::size_t i = 0; i < cells.values().size(); ++i)
    floor.seen.values()[i] = cells.values()[i] == kUnknown ? 0 : 1;
  return floor;
}

/// Runs `read`; what it refuses becomes a note.
template <typename Read>
void noted(std::vector<std::string>& notes, const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    notes.emplace_back(error.what());
  }
}

void readPrediction(const std::string& folder, SceneFiles& files) {
  files.predicted = readRooms(pathIn(folder, "rooms.json"), RingOrder::kAsWritten);
  noted(files.notes, [&] {
    if (const auto graph = bytesIfThere(folder, "scene_graph.json"))
      files.predicted_objects = parseGraphObjects(*graph, pathIn(folder, "scene_graph.json"));
  });
  noted(files.notes, [&] {
    if (const auto timing = bytesIfThere(folder, "timing.json"))
      files.times = parseTiming(*timing, pathIn(folder, "timing.json"));
  });
  noted(files.notes, [&] { files.seen_floor = seenFloorIn(folder); });
}

void readTruth(const std::string& folder, SceneFiles& files) {
  const auto text = bytesIfThere(folder, "truth.json");
  if (!text) return;
  const std::string where = pathIn(folder, "truth.json");
  files.truth = parseRooms(*text, where, RingOrder::kAsWritten);
  noted(files.notes, [&] {
    files.truth_objects =
        parseTruthObjects(*text, where, bytesIfThere(folder, "truth_objects.json"));
  });
}

}  // namespace

const char* nameOf(RunStatus status) {
  switch (status) {
    case RunStatus::kDone:
      return "done";
    case RunStatus::kFailed:
      return "failed";
    case RunStatus::kTimedOut:
      return "timed out";
    case RunStatus::kMissing:
      return "missing";
  }
  return "";
}

std::string toJson(const RunRecord& record) {
  return jsonDocument({{"format", kRunFormat},
                       {"version", kRunVersion},
                       {"recording", record.recording},
                       {"status", nameOf(record.status)},
                       {"problem", record.problem},
                       {"seconds", rounded(record.seconds, 2)}});
}

RunRecord parseRunRecord(const std::string& text, const std::string& where) {
  const json document = parseJson(text, where);
  if (stringOf(member(document, "format", where), where + ": format") != kRunFormat)
    throw refuse(where, "is of another format", std::string(kRunFormat) + " is needed");
  if (integerOf(member(document, "version", where), where + ": version") != kRunVersion)
    throw refuse(where, "is of another version", std::to_string(kRunVersion) + " is needed");
  RunRecord record;
  record.recording = stringOf(member(document, "recording", where), where + ": recording");
  record.status = statusNamed(stringOf(member(document, "status", where), where + ": status"),
                              where + ": status");
  record.problem = stringOf(member(document, "problem", where), where + ": problem");
  record.seconds = numberOf(member(document, "seconds", where), where + ": seconds");
  return record;
}

std::vector<StageTime> parseTiming(const std::string& text, const std::string& where) {
  const json document = parseJson(text, where);
  if (!document.is_object()) throw refuse(where, "is no object", "{stage: {...}} is needed");
  // The stages in the order data passes them, not that of their names.
  constexpr std::array<const char*, 7> kStageOrder{
      "point_cloud", "occupancy", "free_space", "decomposition", "tracking", "graph", "total"};
  std::vector<StageTime> times;
  for (const char* stage : kStageOrder) {
    const json* value = optionalMember(document, stage, where);
    if (value == nullptr) continue;
    const std::string at = where + ": " + stage;
    const auto number = [&](const char* key) { return numberOf(member(*value, key, at), at); };
    times.push_back({stage, number("count"), number("mean_ms"), number("std_ms"), number("max_ms"),
                     number("memory_mib")});
  }
  return times;
}

SceneFiles readSceneFolder(const std::string& folder, const std::string& configuration,
                           const std::string& scene) {
  SceneFiles files;
  files.configuration = configuration;
  files.scene = scene;
  noted(files.notes, [&] { readTruth(folder, files); });
  try {
    const auto record = bytesIfThere(folder, "run.json");
    if (record) files.run = parseRunRecord(*record, pathIn(folder, "run.json"));
    if (files.run.status == RunStatus::kDone) readPrediction(folder, files);
  } catch (const Error& error) {
    files.run.status = RunStatus::kFailed;
    files.run.problem = error.what();
  }
  return files;
}

}  // namespace occusg
