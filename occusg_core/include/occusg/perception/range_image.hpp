// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/perception/camera_model.hpp"
#include "occusg/perception/point_cloud.hpp"

namespace occusg {

/// What the ray through a pixel met.
enum class RayEnd : std::uint8_t {
  kNone,  ///< Nothing is known: there is no ray.
  kHit,   ///< A surface.
  kMiss,  ///< Nothing up to its end.
};

/// One depth frame in the map frame that keeps its pixel lattice: the points of a `PointCloud`, and
/// which pixel each belongs to.
struct RangeImage {
  CameraModel camera;  ///< Of the lattice: one pixel is one ray. Sides are 0 when there is none.
  Pose T_map_camera = Pose::Identity();
  Point3f origin;             ///< Sensor position, that of the pose.
  std::vector<Point3f> ends;  ///< Where the rays end; row-major, width * height.
  std::vector<RayEnd> kinds;  ///< Of each ray; `ends` means nothing where it is kNone.
  std::size_t hits = 0;       ///< Rays of kind kHit.
  PixelDrops drops;           ///< Why the pixels without a ray have none.
};

/// The same rays without the lattice, in row-major order.
[[nodiscard]] PointCloud toPointCloud(const RangeImage& image);

}  // namespace occusg
