// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "occusg/io/scene_graph_file.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

CommandHelp help() {
  return {"occusg show FILE [options]",
          "Reads a scene_graph.json back, checks it, and prints its rooms, objects and doors.\n"
          "Rooms are named by their number, as in rooms.json. --query answers one question:\n\n"
          "  room at X Y      the room that holds this point [m, map frame], or 'none'\n\n"
          "  occusg show out/apartment/scene_graph.json\n"
          "  occusg show out/apartment/scene_graph.json --query \"room at 1.2 3.4\"\n",
          {"FILE"}};
}

po::options_description options() {
  po::options_description options("Options");
  options.add_options()("query", po::value<std::string>(), "answer this instead of the tables");
  return options;
}

const RoomAttributes& roomIn(const Node& node) { return std::get<RoomAttributes>(node.attributes); }

/// Fit for a terminal and a column: files may hold anything.
std::string cell(const std::string& text) {
  constexpr std::size_t kLongest = 24;
  std::string printed = text.substr(0, kLongest);
  std::replace_if(
      printed.begin(), printed.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }, '?');
  return printed.empty() ? "-" : printed;
}

std::string roomOf(const SceneGraph& graph, NodeId member) {
  const std::optional<NodeId> room = graph.roomOf(member);
  return room ? std::to_string(roomNumber(*room)) : "-";
}

std::size_t membersOf(const SceneGraph& graph, NodeId room, NodeType type) {
  const std::vector<NodeId> members = graph.targets(EdgeType::kContains, room);
  return static_cast<std::size_t>(std::count_if(members.begin(), members.end(), [&](NodeId member) {
    return graph.at(member).type() == type;
  }));
}

void printRooms(const SceneGraph& graph) {
  std::cout << "\n  room  label                     state         area m2  objects  adjacent to\n";
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const RoomAttributes& room = roomIn(node);
    std::cout << std::setw(6) << roomNumber(id) << "  " << std::left << std::setw(26)
              << cell(room.label) << std::setw(10)
              << (room.state == RoomState::kConfirmed ? "confirmed" : "partial") << std::right
              << std::setw(11) << room.area_m2 << std::setw(9)
              << membersOf(graph, id, NodeType::kObject) << "  ";
    for (const NodeId other : graph.targets(EdgeType::kRoomAdjacency, id))
      std::cout << roomNumber(other) << ' ';
    std::cout << '\n';
  }
}

void printObjects(const SceneGraph& graph) {
  if (graph.nodes(NodeType::kObject).empty()) return;
  std::cout << "\n  object  class                      room         x         y         z   seen\n";
  for (const auto& [id, node] : graph.nodes(NodeType::kObject)) {
    const auto& object = std::get<ObjectAttributes>(node.attributes);
    std::cout << std::setw(8) << id - firstId(NodeType::kObject) << "  " << std::left
              << std::setw(26) << cell(object.class_name) << std::right << std::setw(5)
              << roomOf(graph, id) << std::setw(10) << node.position.x() << std::setw(10)
              << node.position.y() << std::setw(10) << node.position.z() << std::setw(7)
              << object.observations << '\n';
  }
}

void printDoor(NodeId room_a, NodeId room_b, const Segment2& segment) {
  const Point2 middle = midpoint(segment);
  std::cout << std::setw(7) << roomNumber(room_a) << std::setw(6) << roomNumber(room_b)
            << std::setw(10) << length(segment) << std::setw(10) << middle.x << std::setw(10)
            << middle.y << '\n';
}

/// Door nodes, or the crossings of adjacent rooms in a graph that has none.
void printDoors(const SceneGraph& graph) {
  std::cout << "\n  doors between   width m         x         y\n";
  for (const auto& [id, node] : graph.nodes(NodeType::kDoor)) {
    const auto& door = std::get<DoorAttributes>(node.attributes);
    printDoor(door.room_a, door.room_b, door.segment);
  }
  if (!graph.nodes(NodeType::kDoor).empty()) return;
  for (const auto& [ends, edge] : graph.edges(EdgeType::kRoomAdjacency))
    for (const Segment2& crossing : edge.crossings) printDoor(edge.source, edge.target, crossing);
}

Point2 pointIn(const std::string& query) {
  std::istringstream stream(query);
  stream.imbue(std::locale::classic());
  std::string room;
  std::string at;
  Point2 point;
  const bool is_known = stream >> room >> at >> point.x >> point.y && room == "room" && at == "at";
  if (!is_known || !(stream >> std::ws).eof())
    throw UsageError("--query is '" + query + "'; allowed is 'room at X Y' in metres");
  return point;
}

void answerRoomAt(const SceneGraph& graph, const Point2& point) {
  const Node* smallest = nullptr;  // of nested rooms the inner one
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const bool is_smaller = smallest == nullptr || roomIn(node).area_m2 < roomIn(*smallest).area_m2;
    if (is_smaller && contains(roomIn(node).polygon, point)) smallest = &node;
  }
  if (smallest == nullptr) {
    std::cout << "none\n";
    return;
  }
  std::cout << cell(roomIn(*smallest).name) << ' ' << cell(roomIn(*smallest).label) << ' '
            << roomIn(*smallest).area_m2 << " m2\n";
}

}  // namespace

ExitCode showCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, help(), options());
  if (helpWasPrinted(values)) return kFine;
  std::optional<Point2> asked;
  if (const auto query = given<std::string>(values, "query")) asked = pointIn(*query);

  const SceneGraphFile file = readSceneGraph(values["FILE"].as<std::string>());
  const SceneGraph& graph = file.graph;
  std::cout << std::fixed << std::setprecision(2);
  if (asked) {
    answerRoomAt(graph, *asked);
    return kFine;
  }
  std::cout << "  " << cell(file.scene) << ": " << graph.nodes(NodeType::kRoom).size() << " rooms, "
            << graph.nodes(NodeType::kObject).size() << " objects, "
            << graph.nodes(NodeType::kNavigation).size() << " navigation nodes, "
            << graph.nodes(NodeType::kAgent).size() << " agents\n";
  printRooms(graph);
  printObjects(graph);
  printDoors(graph);
  return kFine;
}

}  // namespace occusg::apps
