// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Point.h>
#include <std_msgs/ColorRGBA.h>

#include <vector>

#include "occusg/geometry/polygon.hpp"

namespace occusg_ros {

/// Triangles that cover the polygon, three points each, up to steps of `slice_m` along its edges.
/// Slices along x, so that no triangulation is needed.
[[nodiscard]] std::vector<geometry_msgs::Point> filled(const occusg::Polygon& polygon, double z_m,
                                                       double slice_m);

/// The edges of all rings, two points each.
[[nodiscard]] std::vector<geometry_msgs::Point> outlined(const occusg::Polygon& polygon,
                                                         double z_m);

/// The colour of the n-th room.
[[nodiscard]] std_msgs::ColorRGBA colorOfRoom(int number, double opacity);
[[nodiscard]] std_msgs::ColorRGBA grey(double brightness, double opacity);

}  // namespace occusg_ros
