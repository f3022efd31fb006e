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

Point2 groundPosition(const Pose& T_map_agent) {
  return {T_map_agent.translation().x(), T_map_agent.translation().y()};
}

}  // namespace

/// The graph, and what keeps each part of it up to date.
struct GraphBuilder::Parts {
  explicit Parts(const GraphBuilderConfig& config)
      : agents(config.agents),
        rooms(config.rooms),
        objects(config.objects),
        navigation(config.navigation, config.rooms.floor_z_m),
        links(config.objects.max_link_distance_m),
        completeness(config.rooms.max_frontier_share),
        labeler(config.room_labels),
        config(config) {}

  AgentLayer agents;
  RoomLayer rooms;
  ObjectLayer objects;
  NavigationLayer navigation;
  FreeSpaceLinks links;
  RoomCompleteness completeness;
  RoomLabeler labeler;
  RoomHistory history;

  GraphBuilderConfig config;
  SceneGraph graph;
  std::optional<double> last_update_s;
  double last_maintenance_s = 0.0;  ///< Once there was an update: the first counts as one.
  std::size_t updates_back_in_time = 0;
};

GraphBuilder::GraphBuilder(const GraphBuilderConfig& config)
    : parts_(std::make_unique<Parts>(checked(config))) {}

GraphBuilder::GraphBuilder(GraphBuilder&&) noexcept = default;
GraphBuilder& GraphBuilder::operator=(GraphBuilder&&) noexcept = default;

GraphBuilder::~GraphBuilder() = default;

const SceneGraph& GraphBuilder::graph() const { return parts_->graph; }

SceneGraph& GraphBuilder::mutableGraph() { return parts_->graph; }

std::size_t GraphBuilder::updatesBackInTime() const { return parts_->updates_back_in_time; }

std::optional<NodeId> GraphBuilder::currentRoom() const { return parts_->rooms.currentRoom(); }

std::size_t GraphBuilder::posesBackInTime() const { return parts_->agents.posesBackInTime(); }

const ObjectCounts& GraphBuilder::objectCounts() const { return parts_->objects.counts(); }

std::size_t GraphBuilder::roomIdSwitches() const { return parts_->history.idSwitches(); }

const SceneGraph& GraphBuilder::update(const TrackedRegions& tracked, const Pose& T_map_agent,
                                       double stamp_s) {
  observePose(T_map_agent, stamp_s);
  return assemble(tracked, groundPosition(T_map_agent), stamp_s, nullptr);
}

const SceneGraph& GraphBuilder::update(const TrackedRegions& tracked, const Pose& T_map_agent,
                                       double stamp_s, const MapView& map) {
  observePose(T_map_agent, stamp_s);
  return assemble(tracked, groundPosition(T_map_agent), stamp_s, &map);
}

const SceneGraph& GraphBuilder::updateUnattended(const TrackedRegions& tracked, double stamp_s,
                                                 const MapView& map) {
  parts_->graph.setStamp(stamp_s);
  return assemble(tracked, std::nullopt, stamp_s, &map);
}

const SceneGraph& GraphBuilder::assemble(const TrackedRegions& tracked,
                                         const std::optional<Point2>& robot, double stamp_s,
                                         const MapView* map) {
  if (parts_->last_update_s && stamp_s < *parts_->last_update_s) {
    ++parts_->updates_back_in_time;
    return parts_->graph;
  }
  if (!parts_->last_update_s) parts_->last_maintenance_s = stamp_s;
  parts_->last_update_s = stamp_s;
  const bool is_due = stamp_s - parts_->last_maintenance_s >=
                      parts_->config.maintenance_period_s - kPeriodRoundingS;
  if (is_due) parts_->last_maintenance_s = stamp_s;
  if (map != nullptr) {
    parts_->navigation.update(parts_->graph, *map->layer, map->changed, stamp_s);
    if (robot && map->occupancy != nullptr)
      parts_->objects.removeGhosts(parts_->graph, *map->occupancy, *robot, map->max_range_m);
  }
  parts_->rooms.update(parts_->graph, tracked, robot, stamp_s,
                       is_due ? Maintenance::kDue : Maintenance::kNotDue);
  parts_->links.update(parts_->graph);
  if (map != nullptr) parts_->completeness.update(parts_->graph, *map->layer, map->changed);
  parts_->labeler.update(parts_->graph);
  parts_->history.update(parts_->graph);
  return parts_->graph;
}

void GraphBuilder::observePose(const Pose& T_map_agent, double stamp_s) {
  if (std::isfinite(stamp_s)) parts_->graph.setStamp(stamp_s);
  parts_->agents.observe(parts_->graph, T_map_agent, stamp_s);
}

void GraphBuilder::observeObjects(const std::vector<Detection>& detections, double stamp_s) {
  parts_->graph.setStamp(stamp_s);
  parts_->objects.observe(parts_->graph, detections, stamp_s);
}

void GraphBuilder::setRoomLabel(NodeId room, const std::string& label) {
  setLabelByPerson(parts_->graph, room, label);
  parts_->labeler.update(parts_->graph);
}

const SceneGraph& GraphBuilder::finish(double stamp_s) {
  maintainFinally(stamp_s, nullptr);
  return parts_->graph;
}

const SceneGraph& GraphBuilder::finish(double stamp_s, const MapView& map) {
  maintainFinally(stamp_s, &map);
  return parts_->graph;
}

void GraphBuilder::maintainFinally(double stamp_s, const MapView* map) {
  if (!std::isfinite(stamp_s))
    throw refuse("graph", "the last stamp is not finite", "seconds are expected");
  parts_->graph.setStamp(stamp_s);
  parts_->rooms.finish(parts_->graph, std::max(stamp_s, parts_->last_update_s.value_or(stamp_s)));
  parts_->links.update(parts_->graph);
  if (map != nullptr) parts_->completeness.update(parts_->graph, *map->layer, map->changed);
  parts_->labeler.update(parts_->graph);
  parts_->history.update(parts_->graph);
}

GraphBuilderState GraphBuilder::state() const {
  return {parts_->graph, parts_->rooms.state(), parts_->last_update_s, parts_->last_maintenance_s,
          parts_->objects.state()};
}

void GraphBuilder::restore(GraphBuilderState state, double stamp_s) {
  reset();
  parts_->graph = std::move(state.graph);
  parts_->agents.restore(parts_->graph, stamp_s);
  parts_->rooms.restore(parts_->graph, state.rooms);
  parts_->objects.restore(parts_->graph, state.objects);
  parts_->navigation.restore(parts_->graph);
  parts_->completeness.restore(parts_->graph);
  // The other layers find all of the graph in its log of changes; the history must know the rooms
  // before the first update removes one.
  parts_->history.update(parts_->graph);
  parts_->last_update_s = state.last_update_s;
  parts_->last_maintenance_s = state.last_maintenance_s;
}

void GraphBuilder::reset() { parts_ = std::make_unique<Parts>(parts_->config); }

}  // namespace occusg
