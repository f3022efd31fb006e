// SPDX-License-Identifier: BSD-3-Clause
#include "report/scene_result.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "occusg/error.hpp"

namespace occusg {
namespace {

std::vector<EvaluatedRoom> predictedRooms(const RoomsFile& file, std::vector<std::string>& notes) {
  std::vector<EvaluatedRoom> rooms;
  for (const RoomRecord& record : file.rooms) {
    std::optional<EvaluatedRoom> room = roomFrom(record.id, record.polygon, "predicted rooms");
    if (!room) {
      notes.push_back("predicted room " + std::to_string(record.id) +
                      " encloses no area and is left out");
      continue;
    }
    for (const Polygon& polygon : record.further_parts) {
      auto part = roomFrom(record.id, polygon, "predicted rooms");
      if (part) std::move(part->parts.begin(), part->parts.end(), std::back_inserter(room->parts));
    }
    rooms.push_back(*std::move(room));
  }
  return rooms;
}

std::vector<TruthRoom> truthRooms(const RoomsFile& file) {
  std::vector<TruthRoom> rooms;
  rooms.reserve(file.rooms.size());
  for (const RoomRecord& record : file.rooms)
    rooms.push_back({record.id, record.polygon, record.level, record.further_parts});
  return rooms;
}

std::vector<std::string> labelsOf(const std::vector<EvaluatedRoom>& rooms, const RoomsFile& file) {
  std::map<int, std::string> label_of;
  for (const RoomRecord& record : file.rooms) label_of[record.id] = record.label;
  std::vector<std::string> labels;
  labels.reserve(rooms.size());
  for (const EvaluatedRoom& room : rooms) labels.push_back(label_of[room.id]);
  return labels;
}

std::vector<RoomPair> pairsOf(const RoomsFile& file) {
  std::vector<RoomPair> pairs;
  pairs.reserve(file.doors.size());
  for (const DoorRecord& door : file.doors) pairs.push_back({door.room_a, door.room_b});
  return pairs;
}

std::vector<Segment2> segmentsOf(const RoomsFile& file, const Point2& shift) {
  std::vector<Segment2> segments;
  segments.reserve(file.doors.size());
  for (const DoorRecord& door : file.doors) {
    const Segment2& s = door.segment;
    segments.push_back({{s.a.x + shift.x, s.a.y + shift.y}, {s.b.x + shift.x, s.b.y + shift.y}});
  }
  return segments;
}

std::vector<PlacedObject> placed(const std::vector<ObjectRecord>& records, const Point2& shift) {
  std::vector<PlacedObject> objects;
  objects.reserve(records.size());
  for (const ObjectRecord& record : records) {
    objects.push_back(
        {record.label, {record.position.x + shift.x, record.position.y + shift.y}, record.room_id});
  }
  return objects;
}

void scoreRelations(const SceneFiles& files, double threshold, SceneResult& result) {
  const RoomMetrics& metrics = *result.metrics;
  const Point2 stay{0.0, 0.0};
  result.adjacency =
      adjacencyScore(pairsOf(files.predicted), pairsOf(*files.truth), metrics.matched, threshold);
  result.doors =
      doorScore(segmentsOf(files.predicted, stay), segmentsOf(*files.truth, metrics.shift));
  if (files.predicted_objects.empty() || files.truth_objects.empty()) return;
  result.objects =
      objectScore(placed(files.predicted_objects, stay), placed(files.truth_objects, metrics.shift),
                  metrics.matched, threshold);
}

/// Against the rooms that were seen; already in place, so nothing is aligned again.
void scoreObserved(const SeenFloor& floor, RoomMetricsOptions options, SceneResult& result) {
  const std::vector<EvaluatedRoom> observed = observedRooms(result.truth, floor);
  options.alignment = Alignment::kNone;
  result.observed = ObservedMetrics{result.truth.size() - observed.size(),
                                    evaluateRooms(result.predicted, observed, options)};
}

void score(const SceneFiles& files, const RoomMetricsOptions& options,
           const std::optional<SeenFloor>& seen_floor, SceneResult& result) {
  SoundTruth sound = soundTruth(truthRooms(*files.truth), "truth of " + files.scene);
  std::move(sound.notes.begin(), sound.notes.end(), std::back_inserter(result.notes));
  if (sound.rooms.empty()) return;
  result.metrics = evaluateRooms(result.predicted, sound.rooms, options);
  for (const EvaluatedRoom& room : sound.rooms)
    result.truth.push_back(translated(room, result.metrics->shift));
  result.truth_labels = labelsOf(result.truth, *files.truth);
  scoreRelations(files, options.thresholds.front(), result);
  const auto& floor = files.seen_floor ? files.seen_floor : seen_floor;
  if (floor) scoreObserved(*floor, options, result);
}

}  // namespace

SceneResult evaluateScene(const SceneFiles& files, const RoomMetricsOptions& options,
                          const std::optional<SeenFloor>& seen_floor) {
  SceneResult result;
  result.configuration = files.configuration;
  result.scene = files.scene;
  result.run = files.run;
  result.notes = files.notes;
  result.times = files.times;
  try {
    result.predicted = predictedRooms(files.predicted, result.notes);
  } catch (const Error& error) {
    result.run.status = RunStatus::kFailed;
    result.run.problem = error.what();
  }
  if (result.run.status == RunStatus::kMissing || !files.truth) return result;
  try {
    score(files, options, seen_floor, result);
  } catch (const Error& error) {
    result.metrics.reset();
    result.notes.emplace_back(error.what());
  }
  return result;
}

const SceneResult* resultOf(const BatchResults& batch, const std::string& configuration,
                            const std::string& scene) {
  const auto found =
      std::find_if(batch.results.begin(), batch.results.end(), [&](const SceneResult& result) {
        return result.configuration == configuration && result.scene == scene;
      });
  return found == batch.results.end() ? nullptr : &*found;
}

std::vector<RoomMetrics> metricsOf(const BatchResults& batch, const std::string& configuration) {
  std::vector<RoomMetrics> metrics;
  for (const std::string& scene : batch.scenes) {
    const SceneResult* result = resultOf(batch, configuration, scene);
    if (result != nullptr && result->metrics) metrics.push_back(*result->metrics);
  }
  return metrics;
}

}  // namespace occusg
