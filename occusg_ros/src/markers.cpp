// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/markers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "marker_shapes.hpp"
#include "occusg/pipeline/building_pipeline.hpp"
#include "occusg_ros/graph_conversions.hpp"

namespace occusg_ros {
namespace {

using occusg::EdgeType;
using occusg::Node;
using occusg::NodeId;
using occusg::NodeType;
using occusg::SceneGraph;
using visualization_msgs::Marker;

constexpr double kFloorFill_m = 0.02;  // above the floor, so that it covers the map
constexpr double kOutline_m = 0.04;
constexpr double kSlice_m = 0.05;
constexpr double kDoorHeight_m = 2.0;
constexpr double kDoorThickness_m = 0.08;
constexpr int kDoorsPerRoomPair = 16;
constexpr double kSmallestBox_m = 0.05;
constexpr double kTextSize_m = 0.4;
constexpr double kStairs_m = 0.15;
constexpr double kNodeShare = 0.5;  // of a storey's height, where the nodes of its rooms float
constexpr double kOfNoRoom = 0.6;   // grey of what is in no room

geometry_msgs::Point raised(const Eigen::Vector3d& position, double height_m) {
  return toPointMsg({position.x(), position.y()}, position.z() + height_m);
}

/// Draws one graph into one set.
class Drawing {
 public:
  Drawing(const SceneGraph& graph, const MarkerLayout& layout, const std_msgs::Header& header)
      : graph_(graph), layout_(layout), header_(header) {}

  void drawRooms();
  void drawAdjacency();
  void drawObjects();
  void drawNavigation();
  void drawTrajectory();
  void drawStairs();
  void drawRegions(const StoreyRegions& storey);
  [[nodiscard]] MarkerSet take() { return std::move(set_); }

 private:
  Marker& add(const std::string& layer, NodeId id, std::int32_t type, double scale,
              const std_msgs::ColorRGBA& color);
  void addText(const std::string& layer, NodeId id, const geometry_msgs::Point& place,
               const std::string& text);
  void drawDoors(const occusg::Edge& adjacency);
  void drawContainment(const Node& room);
  [[nodiscard]] geometry_msgs::Point roomPlace(NodeId id) const {
    return raised(graph_.at(id).position, layout_.room_height_m);
  }
  [[nodiscard]] double heightOf(const Node& node) const {
    if (node.type() == NodeType::kObject) return layout_.object_height_m;
    return node.type() == NodeType::kNavigation ? layout_.navigation_height_m : 0.0;
  }
  [[nodiscard]] std_msgs::ColorRGBA colorOf(std::optional<NodeId> room, double opacity) const {
    return room ? colorOfRoom(occusg::roomNumber(*room), opacity) : grey(kOfNoRoom, opacity);
  }

  const SceneGraph& graph_;
  const MarkerLayout& layout_;
  const std_msgs::Header& header_;
  MarkerSet set_;
};

Marker& Drawing::add(const std::string& layer, NodeId id, std::int32_t type, double scale,
                     const std_msgs::ColorRGBA& color) {
  const auto marker_id = static_cast<std::int32_t>(id);
  Marker& marker = set_[{layer, marker_id}];
  marker.header = header_;
  marker.ns = layer;
  marker.id = marker_id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = scale;
  // Lines take their width from x alone and warn of anything else.
  const bool is_line = type == Marker::LINE_LIST || type == Marker::LINE_STRIP;
  marker.scale.y = marker.scale.z = is_line ? 0.0 : scale;
  marker.color = color;
  return marker;
}

void Drawing::addText(const std::string& layer, NodeId id, const geometry_msgs::Point& place,
                      const std::string& text) {
  Marker& marker = add(layer, id, Marker::TEXT_VIEW_FACING, kTextSize_m, grey(1.0, 1.0));
  marker.pose.position = place;
  marker.text = text;
}

void Drawing::drawRooms() {
  for (const auto& [id, node] : graph_.nodes(NodeType::kRoom)) {
    const auto& room = std::get<occusg::RoomAttributes>(node.attributes);
    const double floor_z = node.position.z();
    add("room_floors", id, Marker::TRIANGLE_LIST, 1.0, colorOf(id, layout_.room_opacity)).points =
        filled(room.polygon, floor_z + kFloorFill_m, kSlice_m);
    add("room_outlines", id, Marker::LINE_LIST, 0.06, colorOf(id, 1.0)).points =
        outlined(room.polygon, floor_z + kOutline_m);
    add("rooms", id, Marker::SPHERE, 0.6, colorOf(id, 1.0)).pose.position = roomPlace(id);
    add("room_stems", id, Marker::LINE_LIST, 0.03, colorOf(id, 0.8)).points = {
        roomPlace(id), raised(node.position, kOutline_m)};
    geometry_msgs::Point above = roomPlace(id);
    above.z += 0.6;
    addText("room_labels", id, above, room.label == "unknown" ? room.name : room.label);
    if (layout_.show_containment) drawContainment(node);
  }
}

void Drawing::drawContainment(const Node& room) {
  std::vector<geometry_msgs::Point> lines;
  for (const NodeId member : graph_.targets(EdgeType::kContains, room.id)) {
    const Node& node = graph_.at(member);
    // The way of the robot is drawn as one; a line to each of its nodes would hide the room.
    if (node.type() == NodeType::kAgent) continue;
    lines.push_back(roomPlace(room.id));
    lines.push_back(raised(node.position, heightOf(node)));
  }
  if (lines.empty()) return;
  add("containment", room.id, Marker::LINE_LIST, 0.01, colorOf(room.id, 0.35)).points =
      std::move(lines);
}

void Drawing::drawAdjacency() {
  std::vector<geometry_msgs::Point> lines;
  for (const auto& entry : graph_.edges(EdgeType::kRoomAdjacency)) {
    lines.push_back(roomPlace(entry.second.source));
    lines.push_back(roomPlace(entry.second.target));
    drawDoors(entry.second);
  }
  if (lines.empty()) return;
  add("adjacency", 0, Marker::LINE_LIST, 0.08, grey(0.95, 0.9)).points = std::move(lines);
}

void Drawing::drawDoors(const occusg::Edge& adjacency) {
  const int first = occusg::roomNumber(adjacency.source);
  const int second = occusg::roomNumber(adjacency.target);
  const double floor_z = graph_.at(adjacency.source).position.z();
  for (std::size_t i = 0; i < adjacency.crossings.size() && i < kDoorsPerRoomPair; ++i) {
    const occusg::Segment2& segment = adjacency.crossings[i];
    const occusg::Point2 middle = midpoint(segment);
    const NodeId id = (NodeId{first} * 4096 + second) * kDoorsPerRoomPair + static_cast<int>(i);
    Marker& door = add("doors", id, Marker::CUBE, 1.0, grey(0.95, 0.55));
    door.pose.position = toPointMsg(middle, floor_z + 0.5 * kDoorHeight_m);
    const double yaw = std::atan2(segment.b.y - segment.a.y, segment.b.x - segment.a.x);
    door.pose.orientation.z = std::sin(0.5 * yaw);
    door.pose.orientation.w = std::cos(0.5 * yaw);
    door.scale.x = std::max(length(segment), kDoorThickness_m);
    door.scale.y = kDoorThickness_m;
    door.scale.z = kDoorHeight_m;
  }
}

void Drawing::drawObjects() {
  for (const auto& [id, node] : graph_.nodes(NodeType::kObject)) {
    const auto& object = std::get<occusg::ObjectAttributes>(node.attributes);
    const geometry_msgs::Point place = raised(node.position, layout_.object_height_m);
    Marker& cube = add("objects", id, Marker::CUBE, 0.3, colorOf(graph_.roomOf(id), 0.9));
    cube.pose.position = place;
    if (!object.box.isEmpty()) {
      const Eigen::Vector3d size = object.box.sizes().cwiseMax(kSmallestBox_m);
      cube.pose.position = raised(object.box.center(), layout_.object_height_m);
      cube.scale.x = size.x();
      cube.scale.y = size.y();
      cube.scale.z = size.z();
    }
    geometry_msgs::Point above = place;
    above.z += 0.4;
    addText("object_labels", id, above, object.class_name.empty() ? "?" : object.class_name);
    set_[{"object_labels", static_cast<std::int32_t>(id)}].scale.z = 0.2;
  }
}

void Drawing::drawNavigation() {
  const SceneGraph::NodeMap& nodes = graph_.nodes(NodeType::kNavigation);
  if (nodes.empty()) return;
  Marker& points = add("navigation", 0, Marker::SPHERE_LIST, 0.12, grey(1.0, 1.0));
  for (const auto& [id, node] : nodes) {
    points.points.push_back(raised(node.position, layout_.navigation_height_m));
    points.colors.push_back(colorOf(graph_.roomOf(id), 1.0));
  }
  Marker& lines = add("navigation_edges", 0, Marker::LINE_LIST, 0.02, grey(0.8, 0.6));
  for (const auto& entry : graph_.edges(EdgeType::kTraversable)) {
    lines.points.push_back(
        raised(graph_.at(entry.second.source).position, layout_.navigation_height_m));
    lines.points.push_back(
        raised(graph_.at(entry.second.target).position, layout_.navigation_height_m));
  }
}

void Drawing::drawTrajectory() {
  const SceneGraph::NodeMap& nodes = graph_.nodes(NodeType::kAgent);
  if (nodes.size() < 2) return;
  std_msgs::ColorRGBA color = grey(1.0, 0.9);
  color.b = 0.3F;
  Marker& way = add("trajectory", 0, Marker::LINE_STRIP, 0.05, color);
  for (const auto& entry : nodes) way.points.push_back(raised(entry.second.position, 0.0));
}

void Drawing::drawStairs() {
  for (const auto& [id, node] : graph_.nodes(NodeType::kStairs)) {
    const auto& stairs = std::get<occusg::StairsAttributes>(node.attributes);
    std_msgs::ColorRGBA color = grey(1.0, 0.9);
    color.b = 0.1F;
    color.g = 0.6F;
    Marker& way = add("stairs", id, Marker::LINE_STRIP, kStairs_m, color);
    for (const Eigen::Vector3d& feet : stairs.path) way.points.push_back(raised(feet, kOutline_m));
  }
}

void Drawing::drawRegions(const StoreyRegions& storey) {
  for (const occusg::Region& region : storey.regions.decomposition.regions) {
    const NodeId id = storey.floor_id * occusg::kRegionsOfAStorey + region.id;
    add("regions", id, Marker::LINE_LIST, 0.03, grey(0.3, 0.9)).points =
        outlined(region.polygon, storey.floor_z_m + kOutline_m + 0.02);
  }
}

/// The layout, with the nodes of rooms below the floor above them.
MarkerLayout fittedTo(const std::vector<StoreyRegions>& storeys, MarkerLayout layout) {
  for (const StoreyRegions& lower : storeys) {
    for (const StoreyRegions& upper : storeys) {
      const double rise_m = upper.floor_z_m - lower.floor_z_m;
      if (rise_m > 0.0) layout.room_height_m = std::min(layout.room_height_m, kNodeShare * rise_m);
    }
  }
  return layout;
}

// The stamp alone is no difference: markers without a lifetime stay as they are.
bool looksLike(Marker a, const Marker& b) {
  a.header = b.header;
  return a == b;
}

}  // namespace

MarkerSet drawGraph(const SceneGraph& graph, const std::vector<StoreyRegions>& storeys,
                    const MarkerLayout& layout, const std_msgs::Header& header) {
  // Stamp zero: rviz shows a marker of the fixed frame whatever time it is.
  std_msgs::Header timeless = header;
  timeless.stamp = ros::Time();
  const MarkerLayout fitted = fittedTo(storeys, layout);
  Drawing drawing(graph, fitted, timeless);
  drawing.drawRooms();
  drawing.drawAdjacency();
  drawing.drawObjects();
  drawing.drawNavigation();
  drawing.drawTrajectory();
  drawing.drawStairs();
  if (layout.show_regions) {
    for (const StoreyRegions& storey : storeys) drawing.drawRegions(storey);
  }
  return drawing.take();
}

visualization_msgs::MarkerArray markerChanges(const MarkerSet& shown, const MarkerSet& wanted) {
  visualization_msgs::MarkerArray changes;
  for (const auto& [key, marker] : shown) {
    if (wanted.count(key) > 0) continue;
    Marker gone;
    gone.header = marker.header;
    gone.ns = key.first;
    gone.id = key.second;
    gone.action = Marker::DELETE;
    gone.pose.orientation.w = 1.0;
    changes.markers.push_back(std::move(gone));
  }
  for (const auto& [key, marker] : wanted) {
    const auto found = shown.find(key);
    if (found == shown.end() || !looksLike(found->second, marker))
      changes.markers.push_back(marker);
  }
  return changes;
}

visualization_msgs::MarkerArray allMarkers(const MarkerSet& set) {
  visualization_msgs::MarkerArray all;
  for (const auto& entry : set) all.markers.push_back(entry.second);
  return all;
}

}  // namespace occusg_ros
