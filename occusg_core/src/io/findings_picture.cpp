// SPDX-License-Identifier: BSD-3-Clause
#include "io/findings_picture.hpp"

#include <functional>
#include <iomanip>
#include <locale>
#include <opencv2/core/mat.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "io/overview_picture.hpp"
#include "io/storeys_picture.hpp"

namespace occusg {
namespace {

/// Whether a node is to be drawn: of a building, those of one storey are.
using IsDrawn = std::function<bool(const Node&)>;

std::vector<Point2> trajectoryOf(const SceneGraph& graph, const IsDrawn& isDrawn) {
  std::vector<Point2> trajectory;
  for (const auto& [id, agent] : graph.nodes(NodeType::kAgent))
    if (isDrawn(agent)) trajectory.push_back(agent.groundPosition());
  return trajectory;
}

std::vector<DrawnObject> objectsOf(const SceneGraph& graph, const IsDrawn& isDrawn) {
  std::vector<DrawnObject> objects;
  for (const auto& [id, node] : graph.nodes(NodeType::kObject)) {
    const auto& object = std::get<ObjectAttributes>(node.attributes);
    if (object.box.isEmpty() || !isDrawn(node)) continue;
    const Eigen::Vector3d& low = object.box.min();
    const Eigen::Vector3d& high = object.box.max();
    objects.push_back({object.class_name, {{low.x(), low.y()}, {high.x(), high.y()}}});
  }
  return objects;
}

/// Stairs are drawn like objects, on both of their storeys.
std::vector<DrawnObject> stairsOf(const RoomsFile& file, int storey) {
  std::vector<DrawnObject> drawn;
  for (const StairsRecord& stairs : file.stairs) {
    if (stairs.lower_storey != storey && stairs.upper_storey != storey) continue;
    const std::string way = stairs.lower_storey == storey ? " up" : " down";
    drawn.push_back({stairs.kind + way, bounds({stairs.footprint, {}})});
  }
  return drawn;
}

std::vector<RoomLink> linksOf(const SceneGraph& graph, const IsDrawn& isDrawn) {
  std::vector<RoomLink> links;
  for (const auto& [ends, edge] : graph.edges(EdgeType::kRoomAdjacency)) {
    if (!isDrawn(graph.at(ends.first))) continue;
    for (const Segment2& crossing : edge.crossings) {
      links.push_back({graph.at(ends.first).groundPosition(), midpoint(crossing),
                       graph.at(ends.second).groundPosition()});
    }
  }
  return links;
}

cv::Mat overviewOf(const Findings& findings, const RoomsFile& rooms) {
  const SceneGraph& graph = findings.graph;
  const auto all = [](const Node& /*node*/) { return true; };
  return drawOverview(findings.free_space,
                      {rooms.scene, rooms.rooms, rooms.doors, trajectoryOf(graph, all),
                       objectsOf(graph, all), linksOf(graph, all)});
}

/// The rooms of one storey and what joins them.
cv::Mat overviewOf(const Findings& findings, const RoomsFile& file, const StoreyLayer& storey) {
  const int id = storey.storey.id;
  OverviewContent content;
  std::ostringstream title;
  title.imbue(std::locale::classic());
  title << file.scene << ", storey " << id << ", floor at " << std::fixed << std::setprecision(2)
        << storey.storey.floor_z_m << " m";
  content.title = title.str();
  std::set<int> rooms;
  for (const RoomRecord& room : file.rooms) {
    if (room.level != id) continue;
    content.rooms.push_back(room);
    rooms.insert(room.id);
  }
  for (const DoorRecord& door : file.doors)
    if (rooms.count(door.room_a) > 0) content.crossings.push_back(door);
  const auto isOnIt = [id](const Node& node) { return node.floor_id == id; };
  content.trajectory = trajectoryOf(findings.graph, isOnIt);
  content.objects = objectsOf(findings.graph, isOnIt);
  const std::vector<DrawnObject> stairs = stairsOf(file, id);
  content.objects.insert(content.objects.end(), stairs.begin(), stairs.end());
  content.links = linksOf(findings.graph, isOnIt);
  return drawOverview(*storey.layer, content);
}

}  // namespace

std::string overviewPng(const Findings& findings, const RoomsFile& rooms) {
  if (findings.storeys.empty())
    return encodePng(overviewOf(findings, rooms), effortFor(rooms.rooms.size()));
  std::vector<cv::Mat> panels;
  for (const StoreyLayer& storey : findings.storeys)
    if (panels.size() < kMostPanels) panels.push_back(overviewOf(findings, rooms, storey));
  return encodePng(besideEachOther(panels), PngEffort::kFast);
}

}  // namespace occusg
