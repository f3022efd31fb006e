// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/geometry/polygon.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// How far a path keeps from obstacles, and how densely it is given.
struct DrivablePathConfig {
  double robot_radius_m = 0.2;  ///< Clearance the path keeps from all that is not free [m].
  double max_spacing_m = 0.25;  ///< Between two points of the path [m].
};

/// Where a path begins or ends: on the free cell nearest to a point, inside a polygon.
struct PathEnd {
  Point2 point;
  Polygon within;
  std::string name;  ///< For sentences: "room 3".
};

/// A path a robot can follow.
struct DrivablePath {
  std::vector<Point2> points;  ///< At most `max_spacing_m` apart; at least one.
  double length_m = 0.0;
};

/// The shortest path on the cells of the layer at which a disc of the robot's radius touches free
/// cells alone: A* (Hart, Nilsson and Raphael, 1968) on the eight neighbours, then straightened
/// where a straight line keeps the clearance too.
/// @throws Error that says why there is none: an end without a place for the robot, or where the
/// widest way is too narrow.
[[nodiscard]] DrivablePath drivablePath(const FreeSpace& layer, const PathEnd& from,
                                        const PathEnd& to, const DrivablePathConfig& config);

}  // namespace occusg
