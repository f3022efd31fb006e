// SPDX-License-Identifier: BSD-3-Clause
#include "marker_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "occusg/io/room_color.hpp"
#include "occusg_ros/graph_conversions.hpp"

namespace occusg_ros {
namespace {

using occusg::Point2;

constexpr int kMaxSlices = 4000;
constexpr occusg::ColorTone kRoomTone{70.0, 45.0};

void addCrossings(const occusg::Ring& ring, double y, std::vector<double>& xs) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2& a = ring[i];
    const Point2& b = ring[(i + 1) % ring.size()];
    if ((a.y > y) == (b.y > y)) continue;
    xs.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
}

// The stretches of the line at height y that lie inside.
std::vector<double> insideOf(const occusg::Polygon& polygon, double y) {
  std::vector<double> xs;
  addCrossings(polygon.outer, y, xs);
  for (const occusg::Ring& hole : polygon.holes) addCrossings(hole, y, xs);
  std::sort(xs.begin(), xs.end());
  return xs;
}

void addRectangle(double x0, double x1, double y0, double y1, double z_m,
                  std::vector<geometry_msgs::Point>& triangles) {
  const Point2 corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y0}, {x1, y1}, {x0, y1}};
  for (const Point2& corner : corners) triangles.push_back(toPointMsg(corner, z_m));
}

}  // namespace

std::vector<geometry_msgs::Point> filled(const occusg::Polygon& polygon, double z_m,
                                         double slice_m) {
  std::vector<geometry_msgs::Point> triangles;
  if (polygon.outer.empty()) return triangles;
  const occusg::Bounds2 bounds = occusg::bounds(polygon);
  const double height_m = bounds.max.y - bounds.min.y;
  const int slices =
      static_cast<int>(std::clamp(std::ceil(height_m / slice_m), 1.0, double{kMaxSlices}));
  for (int i = 0; i < slices; ++i) {
    const double y0 = bounds.min.y + height_m * i / slices;
    const double y1 = bounds.min.y + height_m * (i + 1) / slices;
    const std::vector<double> xs = insideOf(polygon, 0.5 * (y0 + y1));
    for (std::size_t j = 0; j + 1 < xs.size(); j += 2)
      addRectangle(xs[j], xs[j + 1], y0, y1, z_m, triangles);
  }
  return triangles;
}

std::vector<geometry_msgs::Point> outlined(const occusg::Polygon& polygon, double z_m) {
  std::vector<geometry_msgs::Point> lines;
  const auto add = [&](const occusg::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      lines.push_back(toPointMsg(ring[i], z_m));
      lines.push_back(toPointMsg(ring[(i + 1) % ring.size()], z_m));
    }
  };
  add(polygon.outer);
  for (const occusg::Ring& hole : polygon.holes) add(hole);
  return lines;
}

std_msgs::ColorRGBA colorOfRoom(int number, double opacity) {
  const occusg::RgbColor rgb = occusg::roomColor(number, kRoomTone);
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(rgb.r) / 255.0F;
  color.g = static_cast<float>(rgb.g) / 255.0F;
  color.b = static_cast<float>(rgb.b) / 255.0F;
  color.a = static_cast<float>(opacity);
  return color;
}

std_msgs::ColorRGBA grey(double brightness, double opacity) {
  std_msgs::ColorRGBA color;
  color.r = color.g = color.b = static_cast<float>(brightness);
  color.a = static_cast<float>(opacity);
  return color;
}

}  // namespace occusg_ros
