// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/building_graph.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "occusg/graph/graph_query.hpp"
#include "occusg/pipeline/building_pipeline.hpp"

namespace occusg {
namespace {

constexpr double kHalfWidth_m = 0.45;
/// The ends of a passage are so near to rooms and navigation nodes.
constexpr double kEndReach_m = 2.0;

/// Agents and objects have a height of their own: before a storey is found, those on it come to the
/// graph of the storey the robot came from.
const Storey& storeyOf(const Node& node, const StoreyGraph& from,
                       const std::vector<StoreyGraph>& storeys) {
  const bool has_height = node.type() == NodeType::kAgent || node.type() == NodeType::kObject;
  if (!has_height) return from.storey;
  for (const StoreyGraph& storey : storeys)
    if (storey.storey.span.holds(node.position.z())) return storey.storey;
  return from.storey;
}

/// A node of the building, before it is in its graph.
Node placed(Node node, const StoreyGraph& from, const std::vector<StoreyGraph>& storeys,
            double floor_z_m) {
  node.floor_id = storeyOf(node, from, storeys).id;
  const bool lies_on_the_floor = node.type() == NodeType::kRoom || node.type() == NodeType::kDoor ||
                                 node.type() == NodeType::kNavigation;
  if (lies_on_the_floor) node.position.z() += from.storey.floor_z_m - floor_z_m;
  if (auto* room = std::get_if<RoomAttributes>(&node.attributes))
    room->region_id += from.storey.id * kRegionsOfAStorey;
  return node;
}

void addNodes(NodeType type, const std::vector<StoreyGraph>& storeys, double floor_z_m,
              SceneGraph& building) {
  std::vector<std::pair<const Node*, const StoreyGraph*>> nodes;
  for (const StoreyGraph& storey : storeys)
    for (const auto& [id, node] : storey.graph->nodes(type)) nodes.emplace_back(&node, &storey);
  std::sort(nodes.begin(), nodes.end(),
            [](const auto& a, const auto& b) { return a.first->id < b.first->id; });
  for (const auto& [node, storey] : nodes)
    building.restore(placed(*node, *storey, storeys, floor_z_m));
  for (const StoreyGraph& storey : storeys)
    building.skipIdsBefore(type, storey.graph->nextId(type));
}

void joinAgents(SceneGraph& building) {
  const SceneGraph::NodeMap& agents = building.nodes(NodeType::kAgent);
  for (auto agent = agents.begin(); agent != agents.end(); ++agent) {
    const auto next = std::next(agent);
    if (next != agents.end())
      building.connect({EdgeType::kTemporal, agent->first, next->first, {}});
  }
}

/// Edges of one storey; a member that lies on another storey is no member here.
void addEdges(EdgeType type, const SceneGraph& storey, SceneGraph& building) {
  for (const auto& [ends, edge] : storey.edges(type)) {
    if (building.at(edge.source).floor_id == building.at(edge.target).floor_id)
      building.connect(edge);
  }
}

/// Agents and objects without a room get the one of their storey they lie in.
void assignToRooms(NodeType type, SceneGraph& building) {
  for (const auto& [id, member] : building.nodes(type)) {
    if (building.roomOf(id)) continue;
    for (const auto& [room_id, room] : building.nodes(NodeType::kRoom)) {
      const bool lies_in = room.floor_id == member.floor_id &&
                           contains(building.room(room_id).polygon, member.groundPosition());
      if (!lies_in) continue;
      building.connect({EdgeType::kContains, room_id, id, {}});
      break;
    }
  }
}

/// The stairs' outline: half a stair's width around its path.
Ring outlineOf(const std::vector<Eigen::Vector3d>& path) {
  Ring points;
  for (const Eigen::Vector3d& feet : path) {
    points.push_back({feet.x() - kHalfWidth_m, feet.y() - kHalfWidth_m});
    points.push_back({feet.x() + kHalfWidth_m, feet.y() - kHalfWidth_m});
    points.push_back({feet.x() - kHalfWidth_m, feet.y() + kHalfWidth_m});
    points.push_back({feet.x() + kHalfWidth_m, feet.y() + kHalfWidth_m});
  }
  return convexHull(points);
}

NodeId roomAtEnd(const SceneGraph& building, const Eigen::Vector3d& feet) {
  return roomAt(building, Place{feet.x(), feet.y(), feet.z()}, kEndReach_m).value_or(0);
}

std::optional<NodeId> navigationAtEnd(const SceneGraph& building, const Eigen::Vector3d& feet,
                                      int storey) {
  return building.nearest(NodeType::kNavigation, {feet.x(), feet.y()}, kEndReach_m,
                          [storey](const Node& node) { return node.floor_id == storey; });
}

void addPassage(const StoreyPassage& passage, double stamp_s, SceneGraph& building) {
  const Eigen::Vector3d& lower = passage.path.front();
  const Eigen::Vector3d& upper = passage.path.back();
  StairsAttributes stairs;
  stairs.kind = passage.kind;
  stairs.path = passage.path;
  stairs.footprint = outlineOf(passage.path);
  stairs.rise_m = upper.z() - lower.z();
  stairs.risers = passage.risers;
  stairs.lower_storey = passage.lower_storey;
  stairs.upper_storey = passage.upper_storey;
  stairs.lower_room = roomAtEnd(building, lower);
  stairs.upper_room = roomAtEnd(building, upper);
  const Eigen::Vector3d middle = passage.path[passage.path.size() / 2];
  building.add(middle, stamp_s, std::move(stairs), passage.lower_storey);
  const auto from = navigationAtEnd(building, lower, passage.lower_storey);
  const auto to = navigationAtEnd(building, upper, passage.upper_storey);
  if (from && to) building.connect({EdgeType::kTraversable, *from, *to, {}});
}

double lastStamp(const SceneGraph& building) {
  const SceneGraph::NodeMap& agents = building.nodes(NodeType::kAgent);
  return agents.empty() ? 0.0 : agents.rbegin()->second.last_seen_s;
}

}  // namespace

SceneGraph buildingGraph(const std::vector<StoreyGraph>& storeys,
                         const std::vector<StoreyPassage>& passages, double floor_z_m) {
  SceneGraph building;
  for (const NodeTypeInfo& type : kNodeTypes) addNodes(type.type, storeys, floor_z_m, building);
  joinAgents(building);
  for (const EdgeType type : {EdgeType::kContains, EdgeType::kTraversable,
                              EdgeType::kNearestFreeSpace, EdgeType::kRoomAdjacency}) {
    for (const StoreyGraph& storey : storeys) addEdges(type, *storey.graph, building);
  }
  for (const NodeType type : {NodeType::kAgent, NodeType::kObject}) assignToRooms(type, building);
  for (const StoreyPassage& passage : passages) addPassage(passage, lastStamp(building), building);
  return building;
}

}  // namespace occusg
