// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/building_pipeline.hpp"

#include <algorithm>
#include <utility>

#include "pipeline/building_graph.hpp"

namespace occusg {
namespace {

/// Regions and rooms follow a change of the layer within this time.
constexpr double kSettling_s = 10.0;

RoomCounts operator+(RoomCounts sum, const RoomCounts& counts) {
  sum.region_updates += counts.region_updates;
  sum.rejected_region_updates += counts.rejected_region_updates;
  sum.objects.detections += counts.objects.detections;
  sum.objects.refused += counts.objects.refused;
  sum.objects.over_limit += counts.objects.over_limit;
  sum.objects.merged += counts.objects.merged;
  sum.objects.ghosts += counts.objects.ghosts;
  sum.room_id_switches += counts.room_id_switches;
  return sum;
}

/// Storeys and ways of a building are only ever added, so their numbers and floors tell it all.
bool isSame(const Building& a, const Building& b) {
  return a.passages.size() == b.passages.size() && a.current == b.current &&
         std::equal(a.storeys.begin(), a.storeys.end(), b.storeys.begin(), b.storeys.end(),
                    [](const Storey& one, const Storey& other) {
                      return one.floor_z_m == other.floor_z_m && one.span == other.span;
                    });
}

}  // namespace

BuildingPipeline::BuildingPipeline(const PipelineConfig& config,
                                   std::unique_ptr<Decomposer> decomposer)
    : config_(config), building_{std::vector<Storey>(1), {}, 0, 0.0}, changed_at_s_(1, 0.0) {
  rooms_.emplace_back(config, std::move(decomposer));
}

void BuildingPipeline::addStoreys(std::size_t count) {
  while (rooms_.size() < count) {
    rooms_.emplace_back(config_);
    changed_at_s_.push_back(0.0);
  }
}

void BuildingPipeline::follow(const Building& building) {
  building_.sensor_height_m = building.sensor_height_m;
  if (isSame(building, building_)) return;
  const std::size_t storeys = std::max<std::size_t>(1, building.storeys.size());
  while (rooms_.size() > storeys) {
    rooms_.pop_back();
    changed_at_s_.pop_back();
  }
  addStoreys(storeys);
  building_ = building;
  if (building_.storeys.empty()) building_.storeys.resize(1);
  building_.current = std::min(building_.current, storeys - 1);
  merged_.reset();
}

std::size_t BuildingPipeline::storeyAtHeight(double z_m) const {
  for (std::size_t storey = 0; storey < building_.storeys.size(); ++storey)
    if (building_.storeys[storey].span.holds(z_m)) return storey;
  return building_.current;
}

void BuildingPipeline::skipIdsOfOthers(std::size_t storey) {
  for (std::size_t other = 0; other < rooms_.size(); ++other)
    if (other != storey) rooms_[storey].skipIdsOf(rooms_[other].graph());
}

bool BuildingPipeline::isAtRest(std::size_t storey, double stamp_s) const {
  return storey != building_.current && stamp_s - changed_at_s_[storey] > kSettling_s;
}

void BuildingPipeline::update(std::size_t storey, const MapView& map, const Pose& T_map_robot,
                              double stamp_s) {
  if (!map.changed.empty() || !map.gaps_changed.empty()) changed_at_s_[storey] = stamp_s;
  if (isAtRest(storey, stamp_s)) return;
  merged_.reset();
  skipIdsOfOthers(storey);
  if (storey == building_.current) {
    rooms_[storey].update(map, T_map_robot, stamp_s);
  } else {
    rooms_[storey].updateUnattended(map, stamp_s);
  }
}

void BuildingPipeline::observeObjects(const std::vector<Detection>& detections, double stamp_s) {
  merged_.reset();
  if (rooms_.size() == 1) {
    rooms_.front().observeObjects(detections, stamp_s);
    return;
  }
  std::vector<std::vector<Detection>> by_storey(rooms_.size());
  for (const Detection& detection : detections)
    by_storey[storeyAtHeight(detection.centroid.z())].push_back(detection);
  for (std::size_t storey = 0; storey < rooms_.size(); ++storey) {
    if (by_storey[storey].empty()) continue;
    skipIdsOfOthers(storey);
    rooms_[storey].observeObjects(by_storey[storey], stamp_s);
  }
}

void BuildingPipeline::observePose(const Pose& T_map_robot, double stamp_s) {
  merged_.reset();
  skipIdsOfOthers(building_.current);
  rooms_[building_.current].observePose(T_map_robot, stamp_s);
}

void BuildingPipeline::maintain(const Pose& T_map_robot, double stamp_s,
                                const std::vector<FreeSpace>& layers) {
  merged_.reset();
  for (std::size_t storey = 0; storey < rooms_.size(); ++storey) {
    if (isAtRest(storey, stamp_s)) continue;
    skipIdsOfOthers(storey);
    if (storey == building_.current) {
      rooms_[storey].maintain(T_map_robot, stamp_s);
    } else if (storey < layers.size() && !layers[storey].cells.empty()) {
      rooms_[storey].maintainUnattended(layers[storey], stamp_s);
    }
  }
}

void BuildingPipeline::finish(std::size_t storey, double stamp_s, const MapView& map) {
  merged_.reset();
  skipIdsOfOthers(storey);
  rooms_[storey].finish(stamp_s, map);
}

void BuildingPipeline::setRoomLabel(NodeId room, const std::string& label) {
  merged_.reset();
  for (RoomPipeline& rooms : rooms_)
    if (rooms.graph().find(room) != nullptr) return rooms.setRoomLabel(room, label);
  rooms_.front().setRoomLabel(room, label);
}

void BuildingPipeline::saveTo(SessionState& state) const {
  static_cast<RoomPipelineState&>(state) = rooms_.front().state();
  state.building = building_;
  state.further_storeys.clear();
  for (std::size_t storey = 1; storey < rooms_.size(); ++storey)
    state.further_storeys.push_back(rooms_[storey].state());
}

void BuildingPipeline::resumeFrom(const SessionState& state) {
  follow(state.building);
  rooms_.front().resumeFrom(state, state.stamp_s);
  for (std::size_t storey = 1; storey < rooms_.size(); ++storey)
    rooms_[storey].resumeFrom(state.further_storeys[storey - 1], state.stamp_s);
  changed_at_s_.assign(rooms_.size(), state.stamp_s);
}

const SceneGraph& BuildingPipeline::graph() const {
  if (rooms_.size() == 1) return rooms_.front().graph();
  if (!merged_) {
    std::vector<StoreyGraph> graphs;
    for (std::size_t storey = 0; storey < rooms_.size(); ++storey)
      graphs.push_back({&rooms_[storey].graph(), building_.storeys[storey]});
    merged_ = buildingGraph(graphs, building_.passages, config_.graph.rooms.floor_z_m);
  }
  return *merged_;
}

std::optional<double> BuildingPipeline::lastUpdate() const {
  std::optional<double> last_s;
  for (const RoomPipeline& rooms : rooms_) last_s = std::max(last_s, rooms.lastUpdate());
  return last_s;
}

RoomCounts BuildingPipeline::counts() const {
  RoomCounts sum;
  for (const RoomPipeline& rooms : rooms_) sum = sum + rooms.counts();
  return sum;
}

StageTimes BuildingPipeline::times() const {
  StageTimes times;
  for (const RoomPipeline& rooms : rooms_) times.merge(rooms.times());
  return times;
}

StageTimes BuildingPipeline::durations() const {
  StageTimes times;
  for (const RoomPipeline& rooms : rooms_) times.merge(rooms.durations());
  return times;
}

}  // namespace occusg
