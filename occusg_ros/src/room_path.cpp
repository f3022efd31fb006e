// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/room_path.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/graph/drivable_path.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg_ros/graph_conversions.hpp"
#include "occusg_ros/storey_conversions.hpp"

namespace occusg_ros {
namespace {

using occusg::Node;
using occusg::NodeId;
using occusg::SceneGraph;
using occusg::StairsAttributes;

/// So far from the middle of a room is a place in it that the robot could be at.
constexpr double kRoomReach_m = 5.0;

/// Each pose looks to the next one, the last one as the one before.
nav_msgs::Path toPathMsg(const std::vector<Eigen::Vector3d>& points,
                         const std_msgs::Header& header) {
  nav_msgs::Path path;
  path.header = header;
  double yaw_rad = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i + 1 < points.size()) {
      const Eigen::Vector2d step = (points[i + 1] - points[i]).head<2>();
      if (!step.isZero()) yaw_rad = std::atan2(step.y(), step.x());
    }
    geometry_msgs::PoseStamped pose;
    pose.header = header;
    pose.pose.position = toPointMsg({points[i].x(), points[i].y()}, points[i].z());
    pose.pose.orientation.z = std::sin(yaw_rad / 2.0);
    pose.pose.orientation.w = std::cos(yaw_rad / 2.0);
    path.poses.push_back(std::move(pose));
  }
  return path;
}

/// Puts a way together from pieces on storeys and stairs between them.
class WayBuilder {
 public:
  WayBuilder(const SceneGraph& graph, const std::vector<occusg::FreeSpace>& layers,
             double robot_radius_m)
      : graph_(graph), layers_(layers) {
    config_.robot_radius_m = robot_radius_m;
  }

  /// From place to place on a storey.
  void addOnStorey(int floor_id, double floor_z_m, const occusg::PathEnd& from,
                   const occusg::PathEnd& to) {
    const auto storey = static_cast<std::size_t>(floor_id);
    if (storey >= layers_.size()) {
      throw occusg::refuse(
          "path from " + from.name + " to " + to.name,
          "the free space of storey " + std::to_string(floor_id) + " is not known any more",
          "its map is needed");
    }
    const occusg::DrivablePath piece = occusg::drivablePath(layers_[storey], from, to, config_);
    std::vector<occusg::Place> places;
    for (const occusg::Point2& point : piece.points) {
      places.emplace_back(point.x, point.y, floor_z_m);
      points_.emplace_back(point.x, point.y, floor_z_m);
    }
    const occusg::RoomsOnTheWay on_the_way = occusg::roomsAlong(graph_, places);
    for (const NodeId room : on_the_way.rooms)
      if (way_.rooms.empty() || way_.rooms.back() != room) way_.rooms.push_back(room);
    for (const NodeId door : on_the_way.doors) way_.doors.push_back(toDoorMsg(graph_, door));
  }

  /// @param path in the direction of travel.
  void addStairs(NodeId stairs, const std::vector<Eigen::Vector3d>& path) {
    way_.stairs.push_back(toStairsMsg(graph_, stairs));
    points_.insert(points_.end(), path.begin(), path.end());
  }

  [[nodiscard]] RoomPath take(const std_msgs::Header& header) {
    for (std::size_t i = 1; i < points_.size(); ++i)
      way_.length_m += (points_[i] - points_[i - 1]).norm();
    way_.path = toPathMsg(points_, header);
    return std::move(way_);
  }

 private:
  const SceneGraph& graph_;
  const std::vector<occusg::FreeSpace>& layers_;
  occusg::DrivablePathConfig config_;
  RoomPath way_;
  std::vector<Eigen::Vector3d> points_;
};

occusg::PathEnd endIn(const SceneGraph& graph, const Node& room) {
  return {room.groundPosition(), graph.room(room.id).polygon, graph.room(room.id).name};
}

occusg::Place placeOf(const Node& room) {
  return {room.position.x(), room.position.y(), room.position.z()};
}

/// The foot or the head of stairs: a place in the room there.
occusg::PathEnd endAt(const SceneGraph& graph, const StairsAttributes& stairs,
                      const Eigen::Vector3d& feet, NodeId room) {
  const occusg::Point2 point{feet.x(), feet.y()};
  if (room == 0) return {point, {stairs.footprint, {}}, "the stairs"};
  return {point, graph.room(room).polygon, "the stairs in " + graph.room(room).name};
}

}  // namespace

RoomPath pathBetween(const SceneGraph& graph, const std::vector<occusg::FreeSpace>& layers,
                     std::int64_t from, std::int64_t to, double robot_radius_m,
                     const std_msgs::Header& header) {
  const Node& first = graph.at(occusg::roomWith(graph, from));
  const Node& last = graph.at(occusg::roomWith(graph, to));
  WayBuilder way(graph, layers, robot_radius_m);
  occusg::PathEnd here = endIn(graph, first);
  int floor_id = first.floor_id;
  double floor_z_m = first.position.z();
  if (floor_id != last.floor_id) {
    const std::optional<occusg::Route> route =
        occusg::shortestRoute(graph, placeOf(first), placeOf(last), kRoomReach_m);
    if (!route) {
      throw occusg::refuse("path from " + here.name + " to " + endIn(graph, last).name,
                           "no stairs, ramp or lift that the robot took leads there",
                           "the way has to be seen, by driving it once");
    }
    for (const NodeId id : route->stairs) {
      const auto& stairs = std::get<StairsAttributes>(graph.at(id).attributes);
      const bool leads_up = stairs.lower_storey == floor_id;
      std::vector<Eigen::Vector3d> path = stairs.path;
      if (!leads_up) std::reverse(path.begin(), path.end());
      const NodeId entered_from = leads_up ? stairs.lower_room : stairs.upper_room;
      const NodeId leads_to = leads_up ? stairs.upper_room : stairs.lower_room;
      way.addOnStorey(floor_id, floor_z_m, here, endAt(graph, stairs, path.front(), entered_from));
      way.addStairs(id, path);
      here = endAt(graph, stairs, path.back(), leads_to);
      floor_id = leads_up ? stairs.upper_storey : stairs.lower_storey;
      floor_z_m = leads_to == 0 ? path.back().z() : graph.at(leads_to).position.z();
    }
  }
  way.addOnStorey(floor_id, floor_z_m, here, endIn(graph, last));
  return way.take(header);
}

}  // namespace occusg_ros
