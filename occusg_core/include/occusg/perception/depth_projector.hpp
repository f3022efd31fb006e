// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/parameter.hpp"
#include "occusg/perception/camera_model.hpp"
#include "occusg/perception/point_cloud.hpp"
#include "occusg/perception/range_image.hpp"

namespace occusg {

/// What a pixel deeper than `max_depth_m` means.
enum class BeyondMaxDepth {
  kDrop,   ///< Nothing: no ray at all (the published system).
  kClear,  ///< Free space up to the maximum depth, nothing hit.
};

/// Which pixels of a depth image become points.
struct DepthProjectorConfig {
  int stride = 2;             ///< Every n-th pixel in both directions, from (0, 0) [pixels].
  double min_depth_m = 0.01;  ///< Nearer pixels are dropped, along the optical axis [m].
  double max_depth_m = 10.0;  ///< Farther pixels carry no surface, along the optical axis [m].
  BeyondMaxDepth beyond_max_depth = BeyondMaxDepth::kClear;
  /// Values beyond it, and beyond `max_depth_m`, no sensor measures: they mean nothing [m].
  double max_plausible_depth_m = 100.0;
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(DepthProjectorConfig& config);

/// A depth image as it comes from a file or a message.
struct DepthImage {
  /// CV_16UC1 or CV_32FC1. The largest 16-bit value is "out of range", as +Inf is in a float image.
  cv::Mat pixels;
  double units_per_m = 1000.0;  ///< Pixel value of one metre; 1 for CV_32FC1 in metres.
};

/// Depth image and pose -> points in the map frame (paper, Sec. 3.2; REP 117, REP 118).
class DepthProjector {
 public:
  /// @throws Error naming the field, its value and the range: stride in [1, kMaxImageSide],
  /// 0 <= min_depth_m < max_depth_m, both finite.
  explicit DepthProjector(const DepthProjectorConfig& config);

  /// Back-projects the pixel lattice, in double precision and rounded once. The ray tables are kept
  /// while the camera stays the same.
  /// @return valid until the next call.
  /// @throws Error when the camera is not valid, the image's type, size or unit does not fit, or
  /// the pose is not finite.
  [[nodiscard]] const RangeImage& projectLattice(const DepthImage& image, const CameraModel& camera,
                                                 const Pose& T_map_camera);

  /// The same points without the lattice they belong to, in row-major pixel order.
  [[nodiscard]] PointCloud project(const DepthImage& image, const CameraModel& camera,
                                   const Pose& T_map_camera);

 private:
  void prepareRays(const CameraModel& camera);

  DepthProjectorConfig config_;
  CameraModel camera_;         ///< Camera the ray tables below belong to.
  std::vector<double> ray_x_;  ///< (u - cx) / fx per lattice column.
  std::vector<double> ray_y_;  ///< (v - cy) / fy per lattice row.
  RangeImage image_;           ///< Reused between frames.
};

}  // namespace occusg
