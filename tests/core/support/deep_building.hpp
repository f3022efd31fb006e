// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "box_world.hpp"
#include "occusg/perception/depth_frame.hpp"

namespace occusg::testing {

/// A hall of 60 m x 40 m and 3.2 m height with pillars, crates, two partitions and a row of offices
/// along one side: from most places the view is longer than the range of the map.
inline BoxWorld deepBuilding() {
  BoxWorld world;
  world.add({-0.3, -0.3, -0.3}, {60.3, 40.3, 0.0});  // floor
  world.add({-0.3, -0.3, 3.2}, {60.3, 40.3, 3.5});   // ceiling
  world.add({-0.3, -0.3, 0.0}, {60.3, 0.0, 3.2});    // walls
  world.add({-0.3, 40.0, 0.0}, {60.3, 40.3, 3.2});
  world.add({-0.3, 0.0, 0.0}, {0.0, 40.0, 3.2});
  world.add({60.0, 0.0, 0.0}, {60.3, 40.0, 3.2});
  for (double x = 5.83; x < 60.0; x += 9.7)  // pillars
    for (double y = 8.21; y < 40.0; y += 8.3) world.add({x, y, 0.0}, {x + 0.5, y + 0.5, 3.2});
  for (double x = 9.3; x < 58.0; x += 6.1)  // crates
    world.add({x, 13.0 + std::fmod(x, 3.0), 0.0}, {x + 1.2, 13.9 + std::fmod(x, 3.0), 1.1});
  world.add({21.0, 12.0, 0.0}, {21.2, 26.0, 3.2});  // partitions
  world.add({42.0, 24.0, 0.0}, {42.2, 40.0, 3.2});
  for (double x = 0.0; x < 60.0; x += 6.0) {  // offices, their doors in the middle
    world.add({x, 0.0, 0.0}, {x + 0.1, 5.0, 3.2});
    world.add({x, 5.0, 0.0}, {x + 2.5, 5.1, 3.2});
    world.add({x + 3.5, 5.0, 0.0}, {x + 6.0, 5.1, 3.2});
    world.add({x + 2.5, 5.0, 2.1}, {x + 3.5, 5.1, 3.2});
  }
  return world;
}

/// Where a depth camera of 640 x 480 pixels stands and looks in the building.
struct Viewpoint {
  Eigen::Vector3d position;
  double yaw_rad = 0.0;
  double pitch_down_rad = 0.0;
};

/// The `index`-th place of a drive along the hall and back at 0.1 m a frame, swaying as a robot
/// does.
inline Viewpoint driveThroughDeepBuilding(std::size_t index) {
  constexpr double kStep_m = 0.1;
  constexpr double kLoop_m = 100.0;
  const double way_m = std::fmod(kStep_m * static_cast<double>(index), kLoop_m);
  const bool back = way_m > kLoop_m / 2;
  const double x = back ? 54.0 - (way_m - kLoop_m / 2) : 4.0 + way_m;
  const double sway = std::sin(0.07 * static_cast<double>(index));
  return {{x, (back ? 29.0 : 9.5) + 0.4 * sway, 1.2 + 0.004 * sway},
          (back ? 3.14159265 : 0.0) + 0.5 * sway, 0.12};
}

/// Depth noise of a stereo camera [m]: sigma 0.0012 + 0.0019 (depth - 0.4)^2, as far as three sigma
/// and the same for the same pixel and frame.
inline double stereoNoise(double depth_m, std::size_t frame, int u, int v) {
  std::uint64_t bits = 0x9E3779B97F4A7C15U * (frame * 1000003U + static_cast<std::size_t>(v) * 4099U +
                                              static_cast<std::size_t>(u) + 1U);
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    bits ^= bits >> 29;
    bits *= 0xBF58476D1CE4E5B9U;
    sum += static_cast<double>(bits >> 40) / 16777216.0 - 0.5;
  }
  const double sigma_m = 0.0012 + 0.0019 * (depth_m - 0.4) * (depth_m - 0.4);
  return 1.732 * sum * sigma_m;
}

enum class DepthNoise { kNone, kStereo };

/// What a camera with a horizontal field of view of 57 degrees sees, in millimetres; only every
/// `stride`-th pixel is filled, the rest has no return.
inline DepthFrame deepFrame(const BoxWorld& world, std::size_t index, int stride,
                            DepthNoise noise = DepthNoise::kNone) {
  const Viewpoint view = driveThroughDeepBuilding(index);
  DepthFrame frame;
  frame.stamp_s = static_cast<double>(index) / 30.0;
  frame.camera = {640, 480, 585.0, 585.0, 319.5, 239.5};
  const Eigen::Vector3d level(std::cos(view.yaw_rad), std::sin(view.yaw_rad), 0.0);
  const Eigen::Vector3d right(std::sin(view.yaw_rad), -std::cos(view.yaw_rad), 0.0);
  const Eigen::Vector3d forward = std::cos(view.pitch_down_rad) * level -
                                  std::sin(view.pitch_down_rad) * Eigen::Vector3d::UnitZ();
  frame.T_map_camera.matrix().col(0).head<3>() = right;
  frame.T_map_camera.matrix().col(1).head<3>() = forward.cross(right);
  frame.T_map_camera.matrix().col(2).head<3>() = forward;
  frame.T_map_camera.translation() = view.position;
  frame.depth.pixels = cv::Mat(480, 640, CV_16UC1, cv::Scalar(0));
  for (int v = 0; v < 480; v += stride) {
    for (int u = 0; u < 640; u += stride) {
      const Eigen::Vector3d ray((u - frame.camera.cx) / frame.camera.fx,
                                (v - frame.camera.cy) / frame.camera.fy, 1.0);
      double depth_m = world.hit(view.position, frame.T_map_camera.linear() * ray);
      if (noise == DepthNoise::kStereo) depth_m += stereoNoise(depth_m, index, u, v);
      if (depth_m > 0.0 && depth_m < 65.0)
        frame.depth.pixels.at<std::uint16_t>(v, u) =
            static_cast<std::uint16_t>(std::lround(1000.0 * depth_m));
    }
  }
  return frame;
}

}  // namespace occusg::testing
