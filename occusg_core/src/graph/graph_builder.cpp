// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/graph_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr double kPeriodRoundingS = 1e-6;

}  // namespace

GraphBuilder::GraphBuilder(const GraphBuilderConfig& config)
    : config_(checked(config)),
      agents_(config.agents),
      rooms_(config.rooms),
      objects_(config.objects),
      navigation_(config.navigation, config.rooms.floor_z_m),
      links_(config.objects.max_link_distance_m),
      completeness_(config.rooms.max_frontier_share),
      labeler_(config.room_labels) {}

const SceneGraph& GraphBuilder::update(const TrackedRegions& tracked, const Pose& T_map_agent,
                                       double stamp_s) {
  return assemble(tracked, T_map_agent, stamp_s, nullptr);
}

const SceneGraph& GraphBuilder::update(const TrackedRegions& tracked, const Pose& T_map_agent,
                                       double stamp_s, const MapView& map) {
  return assemble(tracked, T_map_agent, stamp_s, &map);
}

const SceneGraph& GraphBuilder::assemble(const TrackedRegions& tracked, const Pose& T_map_agent,
                                         double stamp_s, const MapView* map) {
  observePose(T_map_agent, stamp_s);
  if (last_update_s_ && stamp_s < *last_update_s_) {
    ++updates_back_in_time_;
    return graph_;
  }
  if (!last_update_s_) last_maintenance_s_ = stamp_s;
  last_update_s_ = stamp_s;
  const bool is_due =
      stamp_s - last_maintenance_s_ >= config_.maintenance_period_s - kPeriodRoundingS;
  if (is_due) last_maintenance_s_ = stamp_s;
  const Point2 robot{T_map_agent.translation().x(), T_map_agent.translation().y()};
  if (map != nullptr) {
    navigation_.update(graph_, *map->layer, map->changed, stamp_s);
    if (map->occupancy != nullptr)
      objects_.removeGhosts(graph_, *map->occupancy, robot, map->max_range_m);
  }
  rooms_.update(graph_, tracked, robot, stamp_s, is_due ? Maintenance::kDue : Maintenance::kNotDue);
  links_.update(graph_);
  if (map != nullptr) completeness_.update(graph_, *map->layer, map->changed);
  labeler_.update(graph_);
  history_.update(graph_);
  return graph_;
}

void GraphBuilder::observePose(const Pose& T_map_agent, double stamp_s) {
  if (std::isfinite(stamp_s)) graph_.setStamp(stamp_s);
  agents_.observe(graph_, T_map_agent, stamp_s);
}

void GraphBuilder::observeObjects(const std::vector<Detection>& detections, double stamp_s) {
  graph_.setStamp(stamp_s);
  objects_.observe(graph_, detections, stamp_s);
}

void GraphBuilder::setRoomLabel(NodeId room, const std::string& label) {
  setLabelByPerson(graph_, room, label);
  labeler_.update(graph_);
}

const SceneGraph& GraphBuilder::finish(double stamp_s) {
  maintainFinally(stamp_s, nullptr);
  return graph_;
}

const SceneGraph& GraphBuilder::finish(double stamp_s, const MapView& map) {
  maintainFinally(stamp_s, &map);
  return graph_;
}

void GraphBuilder::maintainFinally(double stamp_s, const MapView* map) {
  if (!std::isfinite(stamp_s))
    throw refuse("graph", "the last stamp is not finite", "seconds are expected");
  graph_.setStamp(stamp_s);
  rooms_.finish(graph_, std::max(stamp_s, last_update_s_.value_or(stamp_s)));
  links_.update(graph_);
  if (map != nullptr) completeness_.update(graph_, *map->layer, map->changed);
  labeler_.update(graph_);
  history_.update(graph_);
}

GraphBuilderState GraphBuilder::state() const {
  return {graph_, rooms_.state(), last_update_s_, last_maintenance_s_, objects_.state()};
}

void GraphBuilder::restore(GraphBuilderState state, double stamp_s) {
  reset();
  graph_ = std::move(state.graph);
  agents_.restore(graph_, stamp_s);
  rooms_.restore(graph_, state.rooms);
  objects_.restore(graph_, state.objects);
  navigation_.restore(graph_);
  completeness_.restore(graph_);
  // The other layers find all of the graph in its log of changes; the history must know the rooms
  // before the first update removes one.
  history_.update(graph_);
  last_update_s_ = state.last_update_s;
  last_maintenance_s_ = state.last_maintenance_s;
}

void GraphBuilder::reset() { *this = GraphBuilder(config_); }

}  // namespace occusg
