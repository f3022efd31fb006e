// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/room_pipeline.hpp"

#include <cstdint>
#include <utility>

namespace occusg {
namespace {

std::unique_ptr<Decomposer> givenOrConfigured(std::unique_ptr<Decomposer> given,
                                              const PipelineConfig& config) {
  check(config);
  return given ? std::move(given) : makeDecomposer(config);
}

}  // namespace

RoomPipeline::RoomPipeline(const PipelineConfig& config, std::unique_ptr<Decomposer> decomposer)
    : decomposer_(givenOrConfigured(std::move(decomposer), config)),
      tracker_(config.tracker),
      graph_(config.graph) {}

const SceneGraph& RoomPipeline::update(const FreeSpace& layer, const CellBox& changed,
                                       const Pose& T_map_robot, double stamp_s) {
  MapView map;
  map.layer = &layer;
  map.changed = changed;
  map.gaps_changed = layer.gaps_changed;
  return update(map, T_map_robot, stamp_s);
}

const SceneGraph& RoomPipeline::update(const MapView& map, const Pose& T_map_robot,
                                       double stamp_s) {
  const TrackedRegions& tracked = track(map);
  const SceneGraph& graph = timed(times_, Stage::kGraph, [&]() -> const SceneGraph& {
    return graph_.update(tracked, T_map_robot, stamp_s, map);
  });
  count(tracked, stamp_s);
  return graph;
}

const SceneGraph& RoomPipeline::updateUnattended(const MapView& map, double stamp_s) {
  const TrackedRegions& tracked = track(map);
  const SceneGraph& graph = timed(times_, Stage::kGraph, [&]() -> const SceneGraph& {
    return graph_.updateUnattended(tracked, stamp_s, map);
  });
  count(tracked, stamp_s);
  return graph;
}

const TrackedRegions& RoomPipeline::track(const MapView& map) {
  const Decomposition& decomposition =
      timed(times_, Stage::kDecomposition, [&]() -> const Decomposition& {
        return decomposer_->update(*map.layer, map.changed.including(map.gaps_changed));
      });
  return timed(times_, Stage::kTracking,
               [&]() -> const TrackedRegions& { return tracker_.update(decomposition); });
}

void RoomPipeline::count(const TrackedRegions& tracked, double stamp_s) {
  last_update_s_ = stamp_s;
  ++counts_.region_updates;
  counts_.rejected_region_updates += tracked.stale ? 1 : 0;
}

void RoomPipeline::skipIdsOf(const SceneGraph& other) {
  for (const NodeTypeInfo& type : kNodeTypes)
    graph_.mutableGraph().skipIdsBefore(type.type, other.nextId(type.type));
}

void RoomPipeline::observePose(const Pose& T_map_robot, double stamp_s) {
  graph_.observePose(T_map_robot, stamp_s);
}

void RoomPipeline::maintain(const Pose& T_map_robot, double stamp_s) {
  if (!last_update_s_) return;
  timed(times_, Stage::kGraph, [&]() -> const SceneGraph& {
    return graph_.update(tracker_.regions(), T_map_robot, stamp_s);
  });
}

void RoomPipeline::maintainUnattended(const FreeSpace& layer, double stamp_s) {
  if (!last_update_s_) return;
  MapView unchanged;
  unchanged.layer = &layer;
  timed(times_, Stage::kGraph, [&]() -> const SceneGraph& {
    return graph_.updateUnattended(tracker_.regions(), stamp_s, unchanged);
  });
}

void RoomPipeline::finish(double stamp_s) {
  timed(times_, Stage::kGraph, [&]() -> const SceneGraph& { return graph_.finish(stamp_s); });
}

void RoomPipeline::finish(double stamp_s, const MapView& map) {
  timed(times_, Stage::kGraph, [&]() -> const SceneGraph& { return graph_.finish(stamp_s, map); });
}

void RoomPipeline::observeObjects(const std::vector<Detection>& detections, double stamp_s) {
  graph_.observeObjects(detections, stamp_s);
}

RoomCounts RoomPipeline::counts() const {
  RoomCounts counts = counts_;
  counts.objects = graph_.objectCounts();
  counts.room_id_switches = graph_.roomIdSwitches();
  return counts;
}

RoomPipelineState RoomPipeline::state() const {
  return {last_update_s_, tracker_.state(), graph_.state()};
}

void RoomPipeline::resumeFrom(const RoomPipelineState& state, double stamp_s) {
  last_update_s_ = state.last_room_update_s;
  decomposer_->reset();
  tracker_.restore(state.tracker);
  graph_.restore(state.graph, stamp_s);
}

StageTimes RoomPipeline::times() const {
  StageTimes times = times_;
  times.setMemory(Stage::kTracking,
                  regions().decomposition.labels.values().size() * sizeof(std::int32_t));
  return times;
}

}  // namespace occusg
