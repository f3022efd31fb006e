// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <occusg/DoorInfo.h>
#include <occusg/StairsInfo.h>
#include <std_msgs/Header.h>

#include <vector>

#include "occusg/graph/scene_graph.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg_ros {

/// A way from one room to another.
struct RoomPath {
  std::vector<std::int64_t> rooms;         ///< Both ends included.
  std::vector<occusg::DoorInfo> doors;     ///< In the order they are passed.
  std::vector<occusg::StairsInfo> stairs;  ///< In the order they are passed.
  nav_msgs::Path path;                     ///< Each pose looks to the next.
  double length_m = 0.0;                   ///< Of the path.
};

/// The shortest way through free space on which a robot of the radius touches nothing, as
/// `occusg::drivablePath` finds it; from storey to storey over the stairs, ramps and lifts of
/// `occusg::shortestRoute`.
/// @param layers of the storeys, by `Node::floor_id`.
/// @param from, to ids or numbers of rooms.
/// @param header of the path.
/// @throws occusg::Error when there is no such room, or no way, and why.
[[nodiscard]] RoomPath pathBetween(const occusg::SceneGraph& graph,
                                   const std::vector<occusg::FreeSpace>& layers, std::int64_t from,
                                   std::int64_t to, double robot_radius_m,
                                   const std_msgs::Header& header);

}  // namespace occusg_ros
