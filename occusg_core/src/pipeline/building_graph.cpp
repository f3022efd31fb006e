// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/building_graph.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace occusg {
namespace {

/// Each storey numbers its regions from 1.
constexpr int kRegionsOfAStorey = 10'000'000;

bool holds(const Storey& storey, double z_m) {
  return z_m >= storey.span.bottom_m && z_m < storey.span.top_m;
}

/// Agents and objects have a height of their own: before a storey is found, those on it come to the
/// graph of the storey the robot came from.
const Storey& storeyOf(const Node& node, const StoreyGraph& from,
                       const std::vector<StoreyGraph>& storeys) {
  const bool has_height = node.type() == NodeType::kAgent || node.type() == NodeType::kObject;
  if (!has_height) return from.storey;
  for (const StoreyGraph& storey : storeys)
    if (holds(storey.storey, node.position.z())) return storey.storey;
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

}  // namespace

SceneGraph buildingGraph(const std::vector<StoreyGraph>& storeys, double floor_z_m) {
  SceneGraph building;
  for (const NodeTypeInfo& type : kNodeTypes) addNodes(type.type, storeys, floor_z_m, building);
  joinAgents(building);
  for (const EdgeType type : {EdgeType::kContains, EdgeType::kTraversable,
                              EdgeType::kNearestFreeSpace, EdgeType::kRoomAdjacency}) {
    for (const StoreyGraph& storey : storeys) addEdges(type, *storey.graph, building);
  }
  for (const NodeType type : {NodeType::kAgent, NodeType::kObject}) assignToRooms(type, building);
  return building;
}

}  // namespace occusg
