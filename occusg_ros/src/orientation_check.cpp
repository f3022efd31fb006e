// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/orientation_check.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace occusg_ros {
namespace {

constexpr double kPeriod_s = 1.0;
/// From there on the map, or the camera, is upside down.
constexpr double kUpsideDown_deg = 150.0;
constexpr double kRadToDeg = 180.0 / 3.14159265358979323846;

template <typename Number>
std::string formatted(const char* format, Number value) {
  std::array<char, 200> text{};
  (void)std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

void OrientationCheck::add(const occusg::DepthFrame& frame) {
  const bool is_due = samples_ == 0 || std::abs(frame.stamp_s - last_s_) >= kPeriod_s;
  if (isDone() || !is_due) return;
  estimator_.add(frame);
  last_s_ = frame.stamp_s;
  ++samples_;
}

std::string OrientationCheck::doubt() const {
  if (samples_ == 0) return "";
  const occusg::MapOrientation map = estimator_.estimate();
  if (isTilted(map)) {
    const double off_deg = map.down_off_rad * kRadToDeg;
    std::string doubt = formatted(
        "down in the images is about %.0f degrees away from the map frame's -z: is z up there, and "
        "is the images' frame the camera's optical frame (z forward)?",
        off_deg);
    if (off_deg >= kUpsideDown_deg)
      doubt += " If the camera was mounted upside down, nothing is to be done.";
    return doubt;
  }
  if (hasFarFloor(map)) {
    return formatted(
        "the lowest floor that was seen is at z = %.1f m in the map frame: are the unit of the "
        "depth "
        "images (depth_units_per_m, --depth-scale) and the camera's mount right?",
        *floorAtMiddle_m(map));
  }
  return "";
}

}  // namespace occusg_ros
