// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/room_path.hpp"

#include <optional>
#include <string>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg_ros/graph_conversions.hpp"

namespace occusg_ros {
namespace {

occusg::Point2 placeOf(const occusg::SceneGraph& graph, occusg::NodeId room) {
  const occusg::Node* const node = graph.find(room);
  if (node == nullptr || node->type() != occusg::NodeType::kRoom) {
    throw occusg::refuse("path", "there is no room of id " + std::to_string(room),
                         "list_rooms tells the ids");
  }
  return node->groundPosition();
}

void append(nav_msgs::Path& path, const Eigen::Vector3d& position) {
  geometry_msgs::PoseStamped pose;
  pose.header = path.header;
  pose.pose.position = toPointMsg({position.x(), position.y()}, position.z());
  pose.pose.orientation.w = 1.0;
  path.poses.push_back(std::move(pose));
}

}  // namespace

RoomPath pathBetween(const occusg::SceneGraph& graph, occusg::NodeId from, occusg::NodeId to,
                     const std_msgs::Header& header) {
  const std::optional<occusg::Route> route =
      occusg::shortestRoute(graph, placeOf(graph, from), placeOf(graph, to));
  if (!route) {
    throw occusg::refuse(
        "path",
        "no free space leads from room " + std::to_string(from) + " to room " + std::to_string(to),
        "drive there once, so that the way is seen");
  }
  RoomPath way;
  way.length_m = route->length_m;
  way.rooms = route->rooms;
  for (const occusg::NodeId door : route->doors) way.doors.push_back(toDoorMsg(graph, door));
  way.path.header = header;
  append(way.path, graph.at(from).position);
  for (const occusg::NodeId id : route->nodes) append(way.path, graph.at(id).position);
  append(way.path, graph.at(to).position);
  return way;
}

}  // namespace occusg_ros
