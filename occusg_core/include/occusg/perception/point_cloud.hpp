// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace occusg {

/// Point in the map frame [m], single precision as in PCL and OctoMap clouds.
struct Point3f {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
};

/// Why pixels of a depth image gave no point.
struct PixelDrops {
  std::size_t zero = 0;         ///< No return: zero.
  std::size_t nan = 0;          ///< NaN.
  std::size_t infinite = 0;     ///< +Inf or -Inf (REP 117: out of range).
  std::size_t negative = 0;     ///< Below zero.
  std::size_t too_near = 0;     ///< Nearer than the minimum depth.
  std::size_t too_far = 0;      ///< Beyond the maximum depth, dropped by configuration.
  std::size_t implausible = 0;  ///< Beyond what a sensor can measure.

  [[nodiscard]] std::size_t total() const {
    return zero + nan + infinite + negative + too_near + too_far + implausible;
  }
};

/// One depth frame in the map frame: where the sensor stood and what its rays met.
struct PointCloud {
  Point3f origin;               ///< Sensor position.
  std::vector<Point3f> points;  ///< Ray ends with a measured surface.
  std::vector<Point3f> misses;  ///< Points along rays known to be free up to there, nothing hit.
  PixelDrops drops;             ///< Pixels of the lattice that gave neither.
};

}  // namespace occusg
