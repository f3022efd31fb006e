// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "graph_question.hpp"
#include "io/result_index.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/io/scene_graph_file.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

CommandHelp showHelp() {
  return {"occusg show FILE [options]",
          "Reads a scene_graph.json back, checks it, and prints its rooms, objects and doors.\n"
          "Rooms are named by their number, as in rooms.json. --query answers one question:\n\n" +
              std::string(kGraphQuestions) +
              "\n  occusg show out/apartment/scene_graph.json\n"
              "  occusg show out/apartment/scene_graph.json --query \"room at 1.2 3.4\"\n"
              "  occusg show out/apartment/scene_graph.json --query \"nearest chair at 1.2 3.4\"\n",
          {"FILE"}};
}

po::options_description showOptions() {
  po::options_description options("Options");
  options.add_options()("query", po::value<std::string>(), "answer this instead of the tables");
  return options;
}

const RoomAttributes& roomIn(const Node& node) { return std::get<RoomAttributes>(node.attributes); }

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

/// A run that was killed while it wrote its results leaves some beside those of the run before.
void warnOfMixedRuns(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  const std::string folder = parent.empty() ? "." : parent;
  try {
    const auto others = filesOfOtherRuns(folder);
    if (!others || others->empty()) return;
    std::cerr << "occusg: " << folder
              << ": the files are of more than one run; not of the last that ended:";
    for (const std::string& name : *others) std::cerr << ' ' << name;
    std::cerr << '\n';
  } catch (const Error& error) {
    std::cerr << "occusg: " << error.what() << '\n';
  }
}

}  // namespace

ExitCode showCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, showHelp(), showOptions());
  if (helpWasPrinted(values)) return kFine;
  std::optional<GraphQuestion> asked;
  if (const auto query = given<std::string>(values, "query")) asked = questionIn(*query);

  const SceneGraphFile file = readSceneGraph(values["FILE"].as<std::string>());
  warnOfMixedRuns(values["FILE"].as<std::string>());
  const SceneGraph& graph = file.graph;
  std::cout << std::fixed << std::setprecision(2);
  if (asked) {
    std::cout << answerTo(*asked, graph);
    return kFine;
  }
  std::cout << "  " << cell(file.scene) << ": "
            << counted(graph.nodes(NodeType::kRoom).size(), "room") << ", "
            << counted(graph.nodes(NodeType::kObject).size(), "object") << ", "
            << counted(graph.nodes(NodeType::kNavigation).size(), "navigation node") << ", "
            << counted(graph.nodes(NodeType::kAgent).size(), "agent") << '\n';
  printRooms(graph);
  printObjects(graph);
  printDoors(graph);
  return kFine;
}

}  // namespace occusg::apps
