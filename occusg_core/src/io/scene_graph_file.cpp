// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/scene_graph_file.hpp"

#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>

#include "io/graph_json.hpp"
#include "io/json_text.hpp"
#include "io/node_json.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

using nlohmann::json;

json membersOf(const Node& node) {
  json members = jsonOf(node.attributes);
  members["id"] = node.id;
  members["type"] = nameOf(node.type());
  members["position"] = jsonOf(node.position);
  members["created_s"] = rounded(node.created_s, kStampDigits);
  members["last_seen_s"] = rounded(node.last_seen_s, kStampDigits);
  members["floor_id"] = node.floor_id;
  return members;
}

/// Writes what tells one edge of a type from another into its members.
void write(const Edge& edge, json& members) {
  members["source"] = edge.source;
  members["target"] = edge.target;
  if (edge.type == EdgeType::kRoomAdjacency) members["crossings"] = crossingsOf(edge);
}

constexpr const char* kGraphPlace = "scene graph";

void checkCount(const char* what, std::size_t count, std::size_t largest) {
  if (count <= largest) return;
  throw refuse(kGraphPlace, "has " + std::to_string(count) + " " + what,
               "at most " + std::to_string(largest) + " can be read back");
}

std::size_t verticesOf(const SceneGraph& graph) {
  std::size_t vertices = 0;
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const Polygon& polygon = std::get<RoomAttributes>(node.attributes).polygon;
    vertices += polygon.outer.size();
    for (const Ring& hole : polygon.holes) vertices += hole.size();
  }
  return vertices;
}

/// What the reader would refuse is not written.
void checkReadable(const SceneGraph& graph) {
  checkCount("nodes", graph.nodeCount(), kMaxGraphNodes);
  checkCount("edges", graph.edgeCount(), kMaxGraphEdges);
  checkCount("vertices of rooms", verticesOf(graph), kMaxGraphVertices);
}

}  // namespace

void writeJson(const SceneGraph& graph, const std::string& scene, const std::string& frame,
               std::ostream& out) {
  checkReadable(graph);
  JsonStream document(out, kGraphPlace, kMaxGraphValues);
  document.member("format", "occusg-scene-graph");
  document.member("version", kSceneGraphFileVersion);
  document.member("scene", scene);
  document.member("frame", frame);
  document.beginList("nodes");
  for (std::size_t type = 0; type < kNodeTypeCount; ++type) {
    for (const auto& [id, node] : graph.nodes(static_cast<NodeType>(type)))
      document.element(membersOf(node));
  }
  document.endList();
  document.beginList("edges");
  for (std::size_t type = 0; type < kEdgeTypeCount; ++type) {
    json members;  // of one edge after another: there are many, and each would be built anew
    for (const auto& [ends, edge] : graph.edges(static_cast<EdgeType>(type))) {
      if (members.is_null()) members["type"] = nameOf(edge.type);
      write(edge, members);
      document.element(members);
    }
  }
  document.endList();
  document.end();
}

std::string toJson(const SceneGraph& graph, const std::string& scene, const std::string& frame) {
  std::ostringstream text;
  writeJson(graph, scene, frame, text);
  return text.str();
}

RoomsFile roomsOf(const SceneGraph& graph, const std::string& scene, double floor_z_m) {
  RoomsFile file;
  file.scene = scene;
  file.floor_z_m = floor_z_m;
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const auto& room = std::get<RoomAttributes>(node.attributes);
    file.rooms.push_back({roomNumber(id), room.label, room.polygon, node.floor_id});
  }
  for (const auto& [ends, edge] : graph.edges(EdgeType::kRoomAdjacency)) {
    for (const Segment2& crossing : edge.crossings)
      file.doors.push_back({roomNumber(edge.source), roomNumber(edge.target), crossing});
  }
  const auto numberOf = [](NodeId room) { return room == 0 ? 0 : roomNumber(room); };
  for (const auto& [id, node] : graph.nodes(NodeType::kStairs)) {
    const auto& stairs = std::get<StairsAttributes>(node.attributes);
    file.stairs.push_back({nameOf(stairs.kind), numberOf(stairs.lower_room),
                           numberOf(stairs.upper_room), stairs.lower_storey, stairs.upper_storey,
                           stairs.risers, stairs.footprint});
  }
  return file;
}

}  // namespace occusg
