// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <occusg/DoorInfo.h>
#include <std_msgs/Header.h>

#include <vector>

#include "occusg/graph/scene_graph.hpp"

namespace occusg_ros {

/// A way from one room to another.
struct RoomPath {
  std::vector<std::int64_t> rooms;      ///< Both ends included.
  std::vector<occusg::DoorInfo> doors;  ///< In the order they are passed.
  nav_msgs::Path path;                  ///< From room node to room node through free space.
  double length_m = 0.0;                ///< Of the path.
};

/// The shortest way through free space, as `occusg::shortestRoute` finds it.
/// @param header of the path.
/// @throws occusg::Error when there is no such room or no way.
[[nodiscard]] RoomPath pathBetween(const occusg::SceneGraph& graph, occusg::NodeId from,
                                   occusg::NodeId to, const std_msgs::Header& header);

}  // namespace occusg_ros
