// SPDX-License-Identifier: BSD-3-Clause
#include "io/node_json.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "io/graph_json.hpp"

namespace occusg {
namespace {

using nlohmann::json;

/// The members a node has by its type.
struct AttributeMembers {
  json operator()(const AgentAttributes& agent) const {
    const Eigen::Quaterniond q = canonicalRotation(agent.T_map_agent);
    return {{"orientation", json::array({q.x(), q.y(), q.z(), q.w()})}};
  }
  json operator()(const ObjectAttributes& object) const {
    json members = {{"class", object.class_name},
                    {"score", rounded(object.score, kScoreDigits)},
                    {"observations", object.observations},
                    {"class_histogram", histogramOf(object)}};
    if (!object.box.isEmpty()) members["box"] = cornersOf(object.box);
    return members;
  }
  json operator()(const NavigationAttributes& navigation) const {
    return {{"block", json::array({navigation.block.x, navigation.block.y})},
            {"free_cells", navigation.free_cells}};
  }
  json operator()(const RoomAttributes& room) const {
    json members = {{"name", room.name},
                    {"state", nameOf(room.state)},
                    {"frontier_share", rounded(room.frontier_share, kScoreDigits)},
                    {"label", room.label},
                    {"label_score", rounded(room.label_score, kScoreDigits)},
                    {"label_source", nameOf(room.label_source)},
                    {"region_id", room.region_id},
                    {"reason", nameOf(room.reason)},
                    {"area_m2", rounded(room.area_m2)},
                    {"polygon", jsonOf(room.polygon.outer)},
                    {"holes", holesOf(room.polygon)}};
    if (room.unsupported_since_s)
      members["unsupported_since_s"] = rounded(*room.unsupported_since_s, kStampDigits);
    return members;
  }
  json operator()(const DoorAttributes& door) const {
    return {{"segment", jsonOf(door.segment)},
            {"width_m", rounded(door.width_m)},
            {"rooms", json::array({door.room_a, door.room_b})}};
  }
  json operator()(const StairsAttributes& stairs) const {
    json path = json::array();
    for (const Eigen::Vector3d& feet : stairs.path) path.push_back(jsonOf(feet));
    return {{"kind", nameOf(stairs.kind)},
            {"path", std::move(path)},
            {"footprint", jsonOf(stairs.footprint)},
            {"rise_m", rounded(stairs.rise_m)},
            {"risers", stairs.risers},
            {"storeys", json::array({stairs.lower_storey, stairs.upper_storey})},
            {"rooms", json::array({stairs.lower_room, stairs.upper_room})}};
  }
};

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

/// Two whole numbers.
std::pair<int, int> pairOf(const Members& members, const char* key) {
  const json& values = arrayOf(members.at(key), members.placeOf(key));
  if (values.size() != 2) {
    throw refuse(members.placeOf(key), "has " + std::to_string(values.size()) + " elements",
                 "two whole numbers are needed");
  }
  return {integerOf(values[0], members.placeOf(key)), integerOf(values[1], members.placeOf(key))};
}

StairsAttributes stairsOf(const Members& members, RingReader& rings) {
  constexpr std::size_t kLongestPath = 100'000;
  StairsAttributes stairs;
  stairs.kind = members.named("kind", {StairsKind::kStairs, StairsKind::kRamp, StairsKind::kLift});
  const json& path = arrayOf(members.at("path"), members.placeOf("path"));
  if (path.size() < 2 || path.size() > kLongestPath) {
    throw refuse(members.placeOf("path"), "has " + std::to_string(path.size()) + " points",
                 "2 to " + std::to_string(kLongestPath) + " are needed");
  }
  for (const json& feet : path) stairs.path.push_back(vectorOf(members, feet, "path"));
  stairs.footprint = rings.read(members.at("footprint"), members.placeOf("footprint"));
  stairs.rise_m = members.number("rise_m");
  stairs.risers = members.integerOr("risers", 0);
  std::tie(stairs.lower_storey, stairs.upper_storey) = pairOf(members, "storeys");
  std::tie(stairs.lower_room, stairs.upper_room) = pairOf(members, "rooms");
  return stairs;
}

}  // namespace

json jsonOf(const NodeAttributes& attributes) { return std::visit(AttributeMembers{}, attributes); }

Eigen::Vector3d vectorOf(const Members& members, const json& value, const char* key) {
  const std::vector<double> numbers = members.numbers(value, key, 3);
  for (const double coordinate : numbers)
    (void)coordinateOf(json(coordinate), members.placeOf(key));
  return {numbers[0], numbers[1], numbers[2]};
}

NodeAttributes attributesIn(const Members& members, const Eigen::Vector3d& position,
                            RingReader& rings) {
  std::vector<NodeType> types;
  types.reserve(kNodeTypes.size());
  for (const NodeTypeInfo& info : kNodeTypes) types.push_back(info.type);
  switch (members.named("type", types)) {
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
    case NodeType::kStairs:
      return stairsOf(members, rings);
  }
  throw refuse(members.where(), "has an unknown type", "a node of this version is needed");
}

}  // namespace occusg
