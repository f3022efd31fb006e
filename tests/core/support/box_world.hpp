// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <utility>
#include <vector>

#include "occusg/perception/depth_frame.hpp"

namespace occusg::testing {

/// Axis-aligned solid box [m].
struct SolidBox {
  Eigen::Vector3d min;
  Eigen::Vector3d max;
};

/// A world of boxes whose depth images are known exactly.
class BoxWorld {
 public:
  void add(const Eigen::Vector3d& min, const Eigen::Vector3d& max) { boxes_.push_back({min, max}); }

  /// Distance from `origin` along `direction` to the first box, in lengths of `direction`;
  /// infinite when there is none.
  [[nodiscard]] double hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    // Plain numbers: sanitizers make every call of Eigen's slow, and this is called a lot.
    const double* const from = origin.data();
    const double* const along = direction.data();
    double nearest = std::numeric_limits<double>::infinity();
    for (const SolidBox& box : boxes_) {
      const double* const low = box.min.data();
      const double* const high = box.max.data();
      double enter = 0.0;
      double leave = nearest;
      for (int axis = 0; axis < 3 && enter <= leave; ++axis) {
        const double a = (low[axis] - from[axis]) / along[axis];
        const double b = (high[axis] - from[axis]) / along[axis];
        enter = std::max(enter, a < b ? a : b);
        leave = std::min(leave, a < b ? b : a);
      }
      if (enter <= leave) nearest = enter;
    }
    return nearest;
  }

  /// Depth image in millimetres seen by a camera at `position`, looking along `yaw_rad`, level.
  [[nodiscard]] DepthFrame seenFrom(const Eigen::Vector3d& position, double yaw_rad,
                                    double stamp_s) const {
    DepthFrame frame;
    frame.stamp_s = stamp_s;
    frame.camera = {160, 120, 80.0, 80.0, 79.5, 59.5};
    const Eigen::Vector3d forward(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
    const Eigen::Vector3d right(std::sin(yaw_rad), -std::cos(yaw_rad), 0.0);
    frame.T_map_camera.matrix().col(0).head<3>() = right;
    frame.T_map_camera.matrix().col(1).head<3>() = -Eigen::Vector3d::UnitZ();
    frame.T_map_camera.matrix().col(2).head<3>() = forward;
    frame.T_map_camera.translation() = position;
    frame.depth.pixels = cv::Mat(frame.camera.height, frame.camera.width, CV_16UC1);
    for (int v = 0; v < frame.camera.height; ++v) {
      for (int u = 0; u < frame.camera.width; ++u) {
        const Eigen::Vector3d ray((u - frame.camera.cx) / frame.camera.fx,
                                  (v - frame.camera.cy) / frame.camera.fy, 1.0);
        const double depth_m = hit(position, frame.T_map_camera.linear() * ray);
        const bool returns = depth_m < 60.0;
        frame.depth.pixels.at<std::uint16_t>(v, u) =
            returns ? static_cast<std::uint16_t>(std::lround(1000.0 * depth_m)) : 0;
      }
    }
    return frame;
  }

 private:
  std::vector<SolidBox> boxes_;
};

/// Two rooms of 4 m by 4 m side by side along x, 0.2 m walls 2.5 m high, joined by a door 0.9 m
/// wide and 2 m high in the middle of the wall between them. Insides: [0, 4] and [4.2, 8.2] by
/// [0, 4].
inline BoxWorld twoRooms() {
  BoxWorld world;
  world.add({-0.2, -0.2, -0.2}, {8.4, 4.2, 0.0});  // floor
  world.add({-0.2, -0.2, 2.5}, {8.4, 4.2, 2.7});   // ceiling
  world.add({-0.2, -0.2, 0.0}, {8.4, 0.0, 2.5});   // south
  world.add({-0.2, 4.0, 0.0}, {8.4, 4.2, 2.5});    // north
  world.add({-0.2, 0.0, 0.0}, {0.0, 4.0, 2.5});    // west
  world.add({8.2, 0.0, 0.0}, {8.4, 4.0, 2.5});     // east
  world.add({4.0, 0.0, 0.0}, {4.2, 1.55, 2.5});    // between, south of the door
  world.add({4.0, 2.45, 0.0}, {4.2, 4.0, 2.5});    // between, north of the door
  world.add({4.0, 1.55, 2.0}, {4.2, 2.45, 2.5});   // lintel
  return world;
}

/// A drive through `twoRooms`: a turn in the west room, through the door, a turn in the east room,
/// 5 frames a second.
inline std::vector<DepthFrame> driveThroughTwoRooms() {
  const BoxWorld world = twoRooms();
  std::vector<DepthFrame> frames;
  const auto look = [&](double x, double y, double yaw_rad) {
    frames.push_back(
        world.seenFrom({x, y, 1.2}, yaw_rad, 0.2 * static_cast<double>(frames.size())));
  };
  constexpr double kTwoPi = 6.283185307179586;
  for (int i = 0; i < 16; ++i) look(1.9, 2.05, 0.01 + kTwoPi * i / 16.0);
  for (int i = 1; i < 11; ++i) look(1.9 + 0.43 * i, 2.05, 0.01);
  for (int i = 0; i < 16; ++i) look(6.2, 2.05, 0.01 + kTwoPi * i / 16.0);
  return frames;
}

}  // namespace occusg::testing
