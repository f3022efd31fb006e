// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <occusg/DoorInfo.h>
#include <occusg/SceneGraphStamped.h>

#include <cstdint>
#include <vector>

namespace occusg_ros {

/// The way from one room to another.
struct RoomPath {
  std::vector<std::int64_t> rooms;      ///< Both ends included.
  std::vector<occusg::DoorInfo> doors;  ///< Between them, in the order they are passed.
  nav_msgs::Path path;                  ///< From room node through the doors to room node.
  double length_m = 0.0;
};

/// The shortest way along the lines from rooms to their doors (Dijkstra 1959).
/// @throws occusg::Error when one of the rooms does not exist or no way leads there.
[[nodiscard]] RoomPath pathBetween(const occusg::SceneGraphStamped& graph, std::int64_t from,
                                   std::int64_t to);

}  // namespace occusg_ros
