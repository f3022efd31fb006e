// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/graph_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "graph/agent_layer.hpp"
#include "graph/free_space_links.hpp"
#include "graph/navigation_layer.hpp"
#include "graph/object_layer.hpp"
#include "graph/room_completeness.hpp"
#include "graph/room_history.hpp"
#include "graph/room_labels.hpp"
#include "graph/room_layer.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr double kPeriodRoundingS = 1e-6;

}  // namespace

/// What each part of the graph is kept up to date by.
struct GraphBuilder::Layers {
  explicit Layers(const GraphBuilderConfig& config)
      : agents(config.agents),
        rooms(config.rooms),
        objects(config.objects),
        navigation(config.navigation, config.rooms.floor_z_m),
        links(config.objects.max_link_distance_m),
        completeness(config.rooms.max_frontier_share),
        labeler(config.room_labels) {}

  AgentLayer agents;
  RoomLayer rooms;
  ObjectLayer objects;
  NavigationLayer navigation;
  FreeSpaceLinks links;
  RoomCompleteness completeness;
  RoomLabeler labeler;
  RoomHistory history;
};

GraphBuilder::GraphBuilder(const GraphBuilderConfig& config)
    : config_(checked(config)), layers_(std::make_unique<Layers>(config)) {}

GraphBuilder::GraphBuilder(GraphBuilder&&) noexcept = default;
GraphBuilder& GraphBuilder::operator=(GraphBuilder&&) noexcept = default;
GraphBuilder::~GraphBuilder() = default;

std::optional<NodeId> GraphBuilder::currentRoom() const { return layers_->rooms.currentRoom(); }

std::size_t GraphBuilder::posesBackInTime() const { return layers_->agents.posesBackInTime(); }

const ObjectCounts& GraphBuilder::objectCounts() const { return layers_->objects.counts(); }

std::size_t GraphBuilder::roomIdSwitches() const { return layers_->history.idSwitches(); }

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
    layers_->navigation.update(graph_, *map->layer, map->changed, stamp_s);
    if (map->occupancy != nullptr)
      layers_->objects.removeGhosts(graph_, *map->occupancy, robot, map->max_range_m);
  }
  layers_->rooms.update(graph_, tracked, robot, stamp_s,
                        is_due ? Maintenance::kDue : Maintenance::kNotDue);
  layers_->links.update(graph_);
  if (map != nullptr) layers_->completeness.update(graph_, *map->layer, map->changed);
  layers_->labeler.update(graph_);
  layers_->history.update(graph_);
  return graph_;
}

void GraphBuilder::observePose(const Pose& T_map_agent, double stamp_s) {
  if (std::isfinite(stamp_s)) graph_.setStamp(stamp_s);
  layers_->agents.observe(graph_, T_map_agent, stamp_s);
}

void GraphBuilder::observeObjects(const std::vector<Detection>& detections, double stamp_s) {
  graph_.setStamp(stamp_s);
  layers_->objects.observe(graph_, detections, stamp_s);
}

void GraphBuilder::setRoomLabel(NodeId room, const std::string& label) {
  setLabelByPerson(graph_, room, label);
  layers_->labeler.update(graph_);
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
  layers_->rooms.finish(graph_, std::max(stamp_s, last_update_s_.value_or(stamp_s)));
  layers_->links.update(graph_);
  if (map != nullptr) layers_->completeness.update(graph_, *map->layer, map->changed);
  layers_->labeler.update(graph_);
  layers_->history.update(graph_);
}

GraphBuilderState GraphBuilder::state() const {
  return {graph_, layers_->rooms.state(), last_update_s_, last_maintenance_s_,
          layers_->objects.state()};
}

void GraphBuilder::restore(GraphBuilderState state, double stamp_s) {
  reset();
  graph_ = std::move(state.graph);
  layers_->agents.restore(graph_, stamp_s);
  layers_->rooms.restore(graph_, state.rooms);
  layers_->objects.restore(graph_, state.objects);
  layers_->navigation.restore(graph_);
  layers_->completeness.restore(graph_);
  // The other layers find all of the graph in its log of changes; the history must know the rooms
  // before the first update removes one.
  layers_->history.update(graph_);
  last_update_s_ = state.last_update_s;
  last_maintenance_s_ = state.last_maintenance_s;
}

void GraphBuilder::reset() { *this = GraphBuilder(config_); }

}  // namespace occusg
