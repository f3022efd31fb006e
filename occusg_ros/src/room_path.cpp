// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/room_path.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/graph/drivable_path.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg_ros/graph_conversions.hpp"

namespace occusg_ros {
namespace {

occusg::PathEnd endIn(const occusg::SceneGraph& graph, std::int64_t room) {
  const occusg::Node& node = graph.at(occusg::roomWith(graph, room));
  const auto& attributes = std::get<occusg::RoomAttributes>(node.attributes);
  return {node.groundPosition(), attributes.polygon, attributes.name};
}

/// Each pose looks to the next one, the last one as the one before.
nav_msgs::Path toPathMsg(const std::vector<occusg::Point2>& points, double height_m,
                         const std_msgs::Header& header) {
  nav_msgs::Path path;
  path.header = header;
  double yaw_rad = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i + 1 < points.size())
      yaw_rad = std::atan2(points[i + 1].y - points[i].y, points[i + 1].x - points[i].x);
    geometry_msgs::PoseStamped pose;
    pose.header = header;
    pose.pose.position = toPointMsg(points[i], height_m);
    pose.pose.orientation.z = std::sin(yaw_rad / 2.0);
    pose.pose.orientation.w = std::cos(yaw_rad / 2.0);
    path.poses.push_back(std::move(pose));
  }
  return path;
}

}  // namespace

RoomPath pathBetween(const occusg::SceneGraph& graph, const occusg::FreeSpace& layer,
                     std::int64_t from, std::int64_t to, double robot_radius_m,
                     const std_msgs::Header& header) {
  occusg::DrivablePathConfig config;
  config.robot_radius_m = robot_radius_m;
  const occusg::DrivablePath drivable =
      occusg::drivablePath(layer, endIn(graph, from), endIn(graph, to), config);
  const occusg::RoomsOnTheWay on_the_way = occusg::roomsAlong(graph, drivable.points);
  RoomPath way;
  way.length_m = drivable.length_m;
  way.rooms = on_the_way.rooms;
  for (const occusg::NodeId door : on_the_way.doors) way.doors.push_back(toDoorMsg(graph, door));
  way.path =
      toPathMsg(drivable.points, graph.at(occusg::roomWith(graph, from)).position.z(), header);
  return way;
}

}  // namespace occusg_ros
