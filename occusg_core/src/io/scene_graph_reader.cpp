// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/graph_json.hpp"
#include "io/json_members.hpp"
#include "io/json_text.hpp"
#include "io/node_json.hpp"
#include "io/polygon_json.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/io/scene_graph_file.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxGraphFileBytes = std::size_t{256} << 20U;

Node nodeOf(const json& value, const std::string& file, std::size_t index, RingReader& rings) {
  const std::string at_index = file + ": nodes[" + std::to_string(index) + "]";
  Node node;
  node.id = integerOf(member(value, "id", at_index), at_index + " id");
  const Members members(value, file + ": node " + std::to_string(node.id));
  node.position = vectorOf(members, members.at("position"), "position");
  node.created_s = members.number("created_s");
  node.last_seen_s = members.number("last_seen_s");
  node.floor_id = members.integer("floor_id");
  node.attributes = attributesIn(members, node.position, rings);
  return node;
}

/// Runs `action` so that what the graph refuses is told with the place in the file.
template <typename Action>
void toldAt(const std::string& where, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    throw Error(where + ": " + error.what());
  }
}

void checkSize(const json& list, std::size_t largest, const std::string& where) {
  if (arrayOf(list, where).size() <= largest) return;
  throw refuse(where, "are " + std::to_string(list.size()),
               "at most " + std::to_string(largest) + " are read");
}

void readNodes(const json& list, const std::string& file, SceneGraph& graph) {
  checkSize(list, kMaxGraphNodes, file + ": nodes");
  RingReader rings(file, RingOrder::kOriented, kMaxGraphVertices);
  std::map<NodeId, Node> nodes;
  for (std::size_t i = 0; i < list.size(); ++i) {
    Node node = nodeOf(list[i], file, i, rings);
    const NodeId id = node.id;
    if (!nodes.emplace(id, std::move(node)).second) {
      throw refuse(file + ": node " + std::to_string(id), "appears twice", "ids must differ");
    }
  }
  std::set<int> regions;
  for (auto& [id, node] : nodes) {
    const std::string where = file + ": node " + std::to_string(id);
    if (const auto* room = std::get_if<RoomAttributes>(&node.attributes);
        room != nullptr && !regions.insert(room->region_id).second) {
      throw refuse(where,
                   "stands on region " + std::to_string(room->region_id) + " as another does",
                   "each room needs a region of its own");
    }
    Node& restored = node;
    toldAt(where, [&] { graph.restore(std::move(restored)); });
  }
}

Edge edgeOf(const Members& members) {
  Edge edge;
  edge.type =
      members.named("type", {EdgeType::kTemporal, EdgeType::kContains, EdgeType::kTraversable,
                             EdgeType::kNearestFreeSpace, EdgeType::kRoomAdjacency});
  edge.source = members.integer("source");
  edge.target = members.integer("target");
  if (const json* crossings = members.find("crossings"); crossings != nullptr) {
    for (const json& crossing : arrayOf(*crossings, members.placeOf("crossings")))
      edge.crossings.push_back(segmentOf(crossing, members.placeOf("crossings")));
  }
  return edge;
}

void readEdges(const json& list, const std::string& file, SceneGraph& graph) {
  checkSize(list, kMaxGraphEdges, file + ": edges");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = file + ": edges[" + std::to_string(i) + "]";
    Edge edge = edgeOf(Members(list[i], where));
    if (graph.findEdge(edge.type, edge.source, edge.target) != nullptr)
      throw refuse(where, "is there already", "each edge is needed once");
    const bool has_room = edge.type == EdgeType::kContains && graph.roomOf(edge.target).has_value();
    if (has_room) {
      throw refuse(where, "puts node " + std::to_string(edge.target) + " into a second room",
                   "a node is in one room at most");
    }
    toldAt(where, [&] { graph.connect(std::move(edge)); });
  }
}

void checkKind(const json& document, const std::string& where) {
  const std::string format = stringOf(member(document, "format", where), where + ": format");
  if (format != "occusg-scene-graph") {
    throw refuse(where, "has the format \"" + shown(format) + "\"",
                 "\"occusg-scene-graph\" is needed");
  }
  const int version = integerOf(member(document, "version", where), where + ": version");
  if (version != kSceneGraphFileVersion) {
    throw refuse(where, "has version " + std::to_string(version),
                 "version " + std::to_string(kSceneGraphFileVersion) + " is read");
  }
}

}  // namespace

SceneGraphFile parseSceneGraph(const std::string& text, const std::string& where) {
  const json document = parseJson(text, where, kMaxGraphValues);
  checkKind(document, where);
  SceneGraphFile file;
  file.scene = stringOf(member(document, "scene", where), where + ": scene");
  file.frame = stringOf(member(document, "frame", where), where + ": frame");
  readNodes(member(document, "nodes", where), where, file.graph);
  readEdges(member(document, "edges", where), where, file.graph);
  return file;
}

SceneGraphFile readSceneGraph(const std::string& path) {
  return parseSceneGraph(readFile(path, kMaxGraphFileBytes), path);
}

}  // namespace occusg
