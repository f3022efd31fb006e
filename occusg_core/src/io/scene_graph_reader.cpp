// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/graph_json.hpp"
#include "io/json_text.hpp"
#include "io/polygon_json.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/io/scene_graph_file.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxGraphFileBytes = std::size_t{256} << 20U;

/// The members of one object of the file.
class Members {
 public:
  Members(const json& object, std::string where) : object_(object), where_(std::move(where)) {}

  [[nodiscard]] const json& at(const char* key) const { return member(object_, key, where_); }
  [[nodiscard]] const json* find(const char* key) const {
    return optionalMember(object_, key, where_);
  }
  [[nodiscard]] std::string placeOf(const char* key) const { return where_ + " " + key; }
  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] const json& object() const { return object_; }

  [[nodiscard]] double number(const char* key) const { return numberOf(at(key), placeOf(key)); }
  [[nodiscard]] double numberOr(const char* key, double absent) const {
    const json* value = find(key);
    return value == nullptr ? absent : numberOf(*value, placeOf(key));
  }
  [[nodiscard]] int integer(const char* key) const { return integerOf(at(key), placeOf(key)); }
  [[nodiscard]] int integerOr(const char* key, int absent) const {
    const json* value = find(key);
    return value == nullptr ? absent : integerOf(*value, placeOf(key));
  }
  [[nodiscard]] std::string text(const char* key) const { return stringOf(at(key), placeOf(key)); }

  /// The numbers of an array of that length.
  [[nodiscard]] std::vector<double> numbers(const json& value, const char* key,
                                            std::size_t count) const {
    if (arrayOf(value, placeOf(key)).size() != count) {
      throw refuse(placeOf(key), "has " + std::to_string(value.size()) + " values",
                   std::to_string(count) + " are needed");
    }
    std::vector<double> numbers;
    for (const json& number : value) numbers.push_back(numberOf(number, placeOf(key)));
    return numbers;
  }

  /// The value whose name stands there.
  template <typename Value>
  [[nodiscard]] Value named(const char* key, std::initializer_list<Value> values) const {
    const std::string name = text(key);
    std::string names;
    for (const Value value : values) {
      if (name == nameOf(value)) return value;
      names += (names.empty() ? "" : ", ") + std::string(nameOf(value));
    }
    throw refuse(placeOf(key), "is \"" + shown(name) + "\"", "one of " + names + " is needed");
  }

 private:
  const json& object_;
  std::string where_;
};

Eigen::Vector3d vectorOf(const Members& members, const json& value, const char* key) {
  const std::vector<double> numbers = members.numbers(value, key, 3);
  for (const double coordinate : numbers)
    (void)coordinateOf(json(coordinate), members.placeOf(key));
  return {numbers[0], numbers[1], numbers[2]};
}

AgentAttributes agentOf(const Members& members, const Eigen::Vector3d& position) {
  const std::vector<double> q = members.numbers(members.at("orientation"), "orientation", 4);
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  if (std::abs(rotation.norm() - 1.0) > kUnitQuaternionTolerance) {
    throw refuse(members.placeOf("orientation"), "has the norm " + toText(rotation.norm()),
                 "a unit quaternion [x, y, z, w] is needed");
  }
  AgentAttributes agent;
  agent.T_map_agent.linear() = rotation.normalized().toRotationMatrix();
  agent.T_map_agent.translation() = position;
  return agent;
}

ObjectAttributes objectOf(const Members& members) {
  ObjectAttributes object;
  object.class_name = members.text("class");
  object.score = members.number("score");
  object.observations = members.integerOr("observations", 0);
  if (const json* histogram = members.find("class_histogram"); histogram != nullptr) {
    if (!histogram->is_object())
      throw refuse(members.placeOf("class_histogram"), "is no object", "{class: sum} is needed");
    for (const auto& [name, sum] : histogram->items())
      object.class_histogram[name] = numberOf(sum, members.placeOf("class_histogram"));
  }
  if (const json* box = members.find("box"); box != nullptr) {
    if (arrayOf(*box, members.placeOf("box")).size() != 2)
      throw refuse(members.placeOf("box"), "is no box", "two corners are needed");
    object.box = Eigen::AlignedBox3d(vectorOf(members, (*box)[0], "box"),
                                     vectorOf(members, (*box)[1], "box"));
  }
  return object;
}

NavigationAttributes navigationOf(const Members& members) {
  const json& block = members.at("block");
  if (arrayOf(block, members.placeOf("block")).size() != 2)
    throw refuse(members.placeOf("block"), "is no block", "[x, y] is needed");
  NavigationAttributes navigation;
  navigation.block = {integerOf(block[0], members.placeOf("block")),
                      integerOf(block[1], members.placeOf("block"))};
  navigation.free_cells = members.integer("free_cells");
  return navigation;
}

RoomAttributes roomOf(const Members& members, RingReader& rings) {
  RoomAttributes room;
  room.name = members.text("name");
  room.label = members.text("label");
  room.region_id = members.integer("region_id");
  room.reason = members.named(
      "reason", {RoomReason::kBootstrap, RoomReason::kVisited, RoomReason::kPromoted});
  room.polygon = rings.polygonOf(members.object(), members.where());
  room.area_m2 = members.number("area_m2");
  if (members.find("state") != nullptr)
    room.state = members.named("state", {RoomState::kPartial, RoomState::kConfirmed});
  room.frontier_share = members.numberOr("frontier_share", room.frontier_share);
  room.label_score = members.numberOr("label_score", room.label_score);
  if (members.find("label_source") != nullptr) {
    room.label_source =
        members.named("label_source", {LabelSource::kAutomatic, LabelSource::kPerson});
  }
  if (members.find("unsupported_since_s") != nullptr)
    room.unsupported_since_s = members.number("unsupported_since_s");
  return room;
}

DoorAttributes doorOf(const Members& members) {
  DoorAttributes door;
  door.segment = segmentOf(members.at("segment"), members.placeOf("segment"));
  door.width_m = members.numberOr("width_m", length(door.segment));
  if (const json* rooms = members.find("rooms"); rooms != nullptr) {
    if (arrayOf(*rooms, members.placeOf("rooms")).size() != 2)
      throw refuse(members.placeOf("rooms"), "are no two rooms", "two ids are needed");
    door.room_a = integerOf((*rooms)[0], members.placeOf("rooms"));
    door.room_b = integerOf((*rooms)[1], members.placeOf("rooms"));
  }
  return door;
}

NodeAttributes attributesOf(NodeType type, const Members& members, const Eigen::Vector3d& position,
                            RingReader& rings) {
  switch (type) {
    case NodeType::kAgent:
      return agentOf(members, position);
    case NodeType::kObject:
      return objectOf(members);
    case NodeType::kNavigation:
      return navigationOf(members);
    case NodeType::kRoom:
      return roomOf(members, rings);
    case NodeType::kDoor:
      return doorOf(members);
  }
  throw refuse(members.where(), "has an unknown type", "a node of this version is needed");
}

Node nodeOf(const json& value, const std::string& file, std::size_t index, RingReader& rings) {
  const std::string at_index = file + ": nodes[" + std::to_string(index) + "]";
  Node node;
  node.id = integerOf(member(value, "id", at_index), at_index + " id");
  const Members members(value, file + ": node " + std::to_string(node.id));
  node.position = vectorOf(members, members.at("position"), "position");
  node.created_s = members.number("created_s");
  node.last_seen_s = members.number("last_seen_s");
  node.floor_id = members.integer("floor_id");
  const auto type =
      members.named("type", {NodeType::kAgent, NodeType::kObject, NodeType::kNavigation,
                             NodeType::kRoom, NodeType::kDoor});
  node.attributes = attributesOf(type, members, node.position, rings);
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
