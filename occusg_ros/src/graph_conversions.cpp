// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/graph_conversions.hpp"

#include <ros/time.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <variant>

#include "occusg/perception/class_names.hpp"
#include "occusg/pipeline/building_pipeline.hpp"
#include "occusg_ros/pose_conversions.hpp"
#include "occusg_ros/storey_conversions.hpp"

namespace occusg_ros {
namespace {

using occusg::EdgeType;
using occusg::Node;
using occusg::NodeId;
using occusg::NodeType;
using occusg::SceneGraph;

// A stamp of a graph may be logical time that began at zero, but never before.
ros::Time stampOf(double stamp_s) {
  constexpr double kLatest_s = 4294967295.0;
  return ros::Time(std::clamp(std::isfinite(stamp_s) ? stamp_s : 0.0, 0.0, kLatest_s));
}

geometry_msgs::Point pointOf(const Eigen::Vector3d& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  point.z = position.z();
  return point;
}

geometry_msgs::Polygon ringOf(const occusg::Ring& ring, double z_m) {
  geometry_msgs::Polygon polygon;
  for (const occusg::Point2& vertex : ring) {
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(vertex.x);
    point.y = static_cast<float>(vertex.y);
    point.z = static_cast<float>(z_m);
    polygon.points.push_back(point);
  }
  return polygon;
}

occusg::Ring ringOf(const geometry_msgs::Polygon& polygon) {
  occusg::Ring ring;
  for (const geometry_msgs::Point32& point : polygon.points) ring.push_back({point.x, point.y});
  return ring;
}

const char* nameOf(occusg::RoomReason reason) {
  switch (reason) {
    case occusg::RoomReason::kBootstrap:
      return "bootstrap";
    case occusg::RoomReason::kVisited:
      return "visited";
    case occusg::RoomReason::kPromoted:
      return "promoted";
  }
  return "unknown";
}

occusg::AgentInfo agentMsg(const SceneGraph& graph, const Node& node) {
  occusg::AgentInfo msg;
  msg.id = node.id;
  msg.floor_id = node.floor_id;
  msg.pose = toPoseMsg(std::get<occusg::AgentAttributes>(node.attributes).T_map_agent);
  msg.room = graph.roomOf(node.id).value_or(kNone);
  msg.stamp = stampOf(node.created_s);
  return msg;
}

occusg::ObjectInfo objectMsg(const SceneGraph& graph, const Node& node) {
  const auto& object = std::get<occusg::ObjectAttributes>(node.attributes);
  const std::vector<NodeId> blocks = graph.targets(EdgeType::kNearestFreeSpace, node.id);
  occusg::ObjectInfo msg;
  msg.id = node.id;
  msg.class_name = object.class_name;
  msg.score = object.score;
  msg.observations = object.observations;
  msg.floor_id = node.floor_id;
  msg.position = pointOf(node.position);
  if (!object.box.isEmpty()) {
    const Eigen::Vector3d size = object.box.sizes();
    msg.size.x = size.x();
    msg.size.y = size.y();
    msg.size.z = size.z();
  }
  msg.room = graph.roomOf(node.id).value_or(kNone);
  msg.nearest_free_space = blocks.empty() ? kNone : blocks.front();
  msg.created = stampOf(node.created_s);
  msg.last_seen = stampOf(node.last_seen_s);
  return msg;
}

occusg::NavigationInfo navigationMsg(const SceneGraph& graph, const Node& node) {
  const auto& block = std::get<occusg::NavigationAttributes>(node.attributes);
  occusg::NavigationInfo msg;
  msg.id = node.id;
  msg.floor_id = node.floor_id;
  msg.position = pointOf(node.position);
  msg.block = {block.block.x, block.block.y};
  msg.free_cells = block.free_cells;
  msg.room = graph.roomOf(node.id).value_or(kNone);
  return msg;
}

occusg::DoorInfo doorMsg(std::int64_t id, const std::pair<NodeId, NodeId>& rooms,
                         const occusg::Segment2& segment, int floor_id = 0,
                         double floor_z_m = 0.0) {
  occusg::DoorInfo msg;
  msg.id = id;
  msg.floor_id = floor_id;
  msg.room_a = rooms.first;
  msg.room_b = rooms.second;
  msg.ends = {toPointMsg(segment.a, floor_z_m), toPointMsg(segment.b, floor_z_m)};
  msg.width = length(segment);
  return msg;
}

std::vector<occusg::EdgeInfo> edgeMsgs(const SceneGraph& graph) {
  std::vector<occusg::EdgeInfo> msgs;
  msgs.reserve(graph.edgeCount());
  for (std::size_t type = 0; type < occusg::kEdgeTypeCount; ++type) {
    for (const auto& [ends, edge] : graph.edges(static_cast<EdgeType>(type))) {
      occusg::EdgeInfo msg;
      msg.type = static_cast<std::uint8_t>(type);
      msg.source = edge.source;
      msg.target = edge.target;
      msgs.push_back(msg);
    }
  }
  return msgs;
}

/// Nodes that are new or different, in the order of `after`; ids that are gone join `removed`.
template <typename Msg>
std::vector<Msg> changedNodes(const std::vector<Msg>& before, const std::vector<Msg>& after,
                              std::vector<std::int64_t>& removed) {
  std::map<std::int64_t, const Msg*> known;
  for (const Msg& msg : before) known[msg.id] = &msg;
  std::vector<Msg> changed;
  for (const Msg& msg : after) {
    const auto found = known.find(msg.id);
    if (found == known.end() || !(*found->second == msg)) changed.push_back(msg);
    if (found != known.end()) known.erase(found);
  }
  for (const auto& entry : known) removed.push_back(entry.first);
  return changed;
}

std::vector<occusg::EdgeInfo> missingFrom(const std::vector<occusg::EdgeInfo>& edges,
                                          const std::vector<occusg::EdgeInfo>& others) {
  const auto key = [](const occusg::EdgeInfo& edge) {
    return std::make_tuple(edge.type, edge.source, edge.target);
  };
  std::set<std::tuple<std::uint8_t, std::int64_t, std::int64_t>> known;
  for (const occusg::EdgeInfo& edge : others) known.insert(key(edge));
  std::vector<occusg::EdgeInfo> missing;
  std::copy_if(edges.begin(), edges.end(), std::back_inserter(missing),
               [&](const occusg::EdgeInfo& edge) { return known.count(key(edge)) == 0; });
  return missing;
}

std::string problemOf(const occusg::DetectionInfo& msg) {
  const double numbers[] = {msg.score,     msg.centroid.x, msg.centroid.y, msg.centroid.z,
                            msg.box_min.x, msg.box_min.y,  msg.box_min.z,  msg.box_max.x,
                            msg.box_max.y, msg.box_max.z};
  if (!std::all_of(std::begin(numbers), std::end(numbers),
                   [](double number) { return std::isfinite(number); }))
    return "a number of it is not finite";
  if (msg.score < 0.0 || msg.score > 1.0) return "its score is not in 0..1";
  if (msg.class_name.size() > occusg::kMaxClassNameLength) return "its class name is too long";
  if (msg.box_min.x > msg.box_max.x || msg.box_min.y > msg.box_max.y ||
      msg.box_min.z > msg.box_max.z)
    return "its box is inside out";
  return {};
}

}  // namespace

geometry_msgs::Point toPointMsg(const occusg::Point2& point, double z_m) {
  return pointOf({point.x, point.y, z_m});
}

occusg::PolygonWithHoles toPolygonMsg(const occusg::Polygon& polygon, double z_m) {
  occusg::PolygonWithHoles msg;
  msg.outer = ringOf(polygon.outer, z_m);
  for (const occusg::Ring& hole : polygon.holes) msg.holes.push_back(ringOf(hole, z_m));
  return msg;
}

occusg::Polygon toPolygon(const occusg::PolygonWithHoles& msg) {
  occusg::Polygon polygon{ringOf(msg.outer), {}};
  for (const geometry_msgs::Polygon& hole : msg.holes) polygon.holes.push_back(ringOf(hole));
  return polygon;
}

std::vector<occusg::RegionInfo> toRegionMsgs(const std::vector<occusg::Region>& regions,
                                             int floor_id, double floor_z_m) {
  const int first = floor_id * occusg::kRegionsOfAStorey;
  std::vector<occusg::RegionInfo> msgs;
  for (const occusg::Region& region : regions) {
    occusg::RegionInfo msg;
    msg.id = first + region.id;
    msg.floor_id = floor_id;
    msg.polygon = toPolygonMsg(region.polygon, floor_z_m);
    msg.area = region.area_m2;
    msg.centroid = toPointMsg(region.centroid, floor_z_m);
    for (const int beside : region.adjacent) msg.adjacent.push_back(first + beside);
    msgs.push_back(std::move(msg));
  }
  return msgs;
}

occusg::RegionArray toRegionArray(const std::vector<StoreyRegions>& storeys, std::uint64_t sequence,
                                  const std_msgs::Header& header) {
  occusg::RegionArray msg;
  msg.header = header;
  msg.sequence = sequence;
  for (const StoreyRegions& storey : storeys) {
    const occusg::TrackedRegions& tracked = storey.regions;
    const std::vector<occusg::RegionInfo> regions =
        toRegionMsgs(tracked.decomposition.regions, storey.floor_id, storey.floor_z_m);
    msg.regions.insert(msg.regions.end(), regions.begin(), regions.end());
    for (const int missed : tracked.missed)
      msg.missing.push_back(storey.floor_id * occusg::kRegionsOfAStorey + missed);
    msg.stale = msg.stale || tracked.stale;
  }
  return msg;
}

occusg::RoomInfo toRoomMsg(const SceneGraph& graph, NodeId id) {
  const Node& node = graph.at(id);
  const occusg::RoomAttributes& room = graph.room(id);
  occusg::RoomInfo msg;
  msg.id = id;
  msg.number = static_cast<std::uint32_t>(occusg::roomNumber(id));
  msg.name = room.name;
  msg.label = room.label;
  msg.label_score = room.label_score;
  msg.label_by_person = room.label_source == occusg::LabelSource::kPerson;
  msg.floor_id = node.floor_id;
  msg.region_id = room.region_id;
  msg.reason = nameOf(room.reason);
  msg.state = room.state == occusg::RoomState::kPartial ? "partial" : "confirmed";
  msg.frontier_share = room.frontier_share;
  msg.position = pointOf(node.position);
  msg.polygon = toPolygonMsg(room.polygon, node.position.z());
  msg.area = room.area_m2;
  msg.adjacent = graph.targets(EdgeType::kRoomAdjacency, id);
  msg.created = stampOf(node.created_s);
  msg.last_seen = stampOf(node.last_seen_s);
  return msg;
}

occusg::DoorInfo toDoorMsg(const SceneGraph& graph, NodeId door) {
  const Node& node = graph.at(door);
  const auto& attributes = std::get<occusg::DoorAttributes>(node.attributes);
  return doorMsg(door, {attributes.room_a, attributes.room_b}, attributes.segment, node.floor_id,
                 node.position.z());
}

std::vector<occusg::DoorInfo> toDoorMsgs(const SceneGraph& graph) {
  std::vector<occusg::DoorInfo> msgs;
  for (const auto& entry : graph.nodes(NodeType::kDoor))
    msgs.push_back(toDoorMsg(graph, entry.first));
  if (!msgs.empty()) return msgs;
  // A graph without door nodes has them on its edges.
  for (const auto& [ends, edge] : graph.edges(EdgeType::kRoomAdjacency)) {
    const Node& room = graph.at(ends.first);
    for (const occusg::Segment2& segment : edge.crossings)
      msgs.push_back(doorMsg(kNone, ends, segment, room.floor_id, room.position.z()));
  }
  return msgs;
}

std::vector<occusg::DoorInfo> toDoorMsgs(const std::vector<occusg::Crossing>& crossings) {
  std::vector<occusg::DoorInfo> msgs;
  msgs.reserve(crossings.size());
  for (const occusg::Crossing& crossing : crossings)
    msgs.push_back(doorMsg(kNone, {crossing.region_a, crossing.region_b}, crossing.segment));
  return msgs;
}

occusg::RoomArray toRoomArray(const GraphView& view) {
  occusg::RoomArray msg;
  msg.header = view.header;
  msg.sequence = view.sequence;
  for (const auto& entry : view.graph.nodes(NodeType::kRoom))
    msg.rooms.push_back(toRoomMsg(view.graph, entry.first));
  return msg;
}

occusg::CurrentRoom toCurrentRoom(const GraphView& view) {
  occusg::CurrentRoom msg;
  msg.header = view.header;
  msg.id = view.current_room.value_or(kNone);
  msg.floor_id = view.floor_id;
  if (view.current_room && view.graph.find(*view.current_room) != nullptr) {
    msg.name = view.graph.room(*view.current_room).name;
    msg.label = view.graph.room(*view.current_room).label;
  }
  return msg;
}

occusg::SceneGraphStamped toGraphMsg(const GraphView& view) {
  const SceneGraph& graph = view.graph;
  occusg::SceneGraphStamped msg;
  msg.header = view.header;
  msg.sequence = view.sequence;
  msg.scene = view.scene;
  msg.current_room = view.current_room.value_or(kNone);
  msg.rooms = toRoomArray(view).rooms;
  msg.doors = toDoorMsgs(graph);
  msg.stairs = toStairsMsgs(graph);
  for (const auto& entry : graph.nodes(NodeType::kObject))
    msg.objects.push_back(objectMsg(graph, entry.second));
  for (const auto& entry : graph.nodes(NodeType::kAgent))
    msg.agents.push_back(agentMsg(graph, entry.second));
  for (const auto& entry : graph.nodes(NodeType::kNavigation))
    msg.navigation.push_back(navigationMsg(graph, entry.second));
  msg.edges = edgeMsgs(graph);
  return msg;
}

occusg::SceneGraphUpdate difference(const occusg::SceneGraphStamped& before,
                                    const occusg::SceneGraphStamped& after) {
  occusg::SceneGraphUpdate update;
  update.header = after.header;
  update.previous_sequence = before.sequence;
  update.sequence = after.sequence;
  update.current_room = after.current_room;
  update.room_changed = before.current_room != after.current_room;
  update.rooms = changedNodes(before.rooms, after.rooms, update.removed_nodes);
  update.objects = changedNodes(before.objects, after.objects, update.removed_nodes);
  update.agents = changedNodes(before.agents, after.agents, update.removed_nodes);
  update.navigation = changedNodes(before.navigation, after.navigation, update.removed_nodes);
  std::sort(update.removed_nodes.begin(), update.removed_nodes.end());
  update.doors_changed = !(before.doors == after.doors);
  if (update.doors_changed) update.doors = after.doors;
  update.stairs_changed = !(before.stairs == after.stairs);
  if (update.stairs_changed) update.stairs = after.stairs;
  update.added_edges = missingFrom(after.edges, before.edges);
  update.removed_edges = missingFrom(before.edges, after.edges);
  return update;
}

bool isEmpty(const occusg::SceneGraphUpdate& update) {
  return update.rooms.empty() && update.objects.empty() && update.agents.empty() &&
         update.navigation.empty() && !update.doors_changed && !update.stairs_changed &&
         update.removed_nodes.empty() && update.added_edges.empty() &&
         update.removed_edges.empty() && !update.room_changed;
}

occusg::DetectionArray toDetectionMsg(const std::vector<occusg::Detection>& detections,
                                      const std_msgs::Header& header) {
  occusg::DetectionArray msg;
  msg.header = header;
  for (const occusg::Detection& detection : detections) {
    occusg::DetectionInfo info;
    info.class_id = detection.class_id;
    info.class_name = detection.class_name;
    info.score = detection.score;
    info.centroid = pointOf(detection.centroid);
    info.box_min = pointOf(detection.box.min());
    info.box_max = pointOf(detection.box.max());
    info.point_count =
        static_cast<std::uint32_t>(std::min<std::size_t>(detection.point_count, 0xFFFFFFFFU));
    msg.detections.push_back(info);
  }
  return msg;
}

ReceivedDetections toDetections(const occusg::DetectionArray& msg) {
  ReceivedDetections received;
  const auto refuse = [&](const std::string& reason, std::size_t count) {
    if (received.refused == 0) received.first_refusal = reason;
    received.refused += count;
  };
  const std::size_t taken = std::min(msg.detections.size(), kMaxDetections);
  for (std::size_t i = 0; i < taken; ++i) {
    const occusg::DetectionInfo& info = msg.detections[i];
    const std::string problem = problemOf(info);
    if (!problem.empty()) {
      refuse("detection " + std::to_string(i) + ": " + problem, 1);
      continue;
    }
    occusg::Detection detection;
    detection.stamp_s = msg.header.stamp.toSec();
    detection.class_id = info.class_id;
    detection.class_name = info.class_name;
    detection.score = info.score;
    detection.centroid = {info.centroid.x, info.centroid.y, info.centroid.z};
    detection.box.min() = Eigen::Vector3d(info.box_min.x, info.box_min.y, info.box_min.z);
    detection.box.max() = Eigen::Vector3d(info.box_max.x, info.box_max.y, info.box_max.z);
    detection.point_count = info.point_count;
    received.detections.push_back(std::move(detection));
  }
  if (msg.detections.size() > taken) {
    refuse("a message has " + std::to_string(msg.detections.size()) + " detections; the first " +
               std::to_string(kMaxDetections) + " are taken",
           msg.detections.size() - taken);
  }
  return received;
}

}  // namespace occusg_ros
