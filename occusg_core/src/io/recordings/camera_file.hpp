// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "io/recordings/folder_names.hpp"
#include "occusg/perception/camera_model.hpp"

namespace occusg {

/// A camera as a file tells it.
struct CameraFile {
  CameraModel camera;                       ///< Width and height 0 when the file has none.
  std::optional<double> depth_units_per_m;  ///< If the file says so.
  bool has_distortion = false;              ///< Coefficients other than zero.
};

/// Reads a camera file by its content: JSON with width, height, fx, fy, cx, cy, depth_scale (ours),
/// with "camera" {w, h, fx, fy, cx, cy, scale} (NICE-SLAM), or with intrinsic_matrix (Open3D); YAML
/// with camera_matrix, image_width and image_height (ROS camera_calibration, OpenCV, RTAB-Map); a
/// 3 x 3 or 4 x 4 matrix of numbers (ScanNet).
/// @throws Error naming file and value.
[[nodiscard]] CameraFile readCameraFile(const std::string& path);

/// The camera with the size of the images where its file has none.
/// @throws Error when it is then no camera; `where` opens the sentence.
[[nodiscard]] CameraModel completed(CameraModel camera, const ImageSize& size,
                                    const std::string& where);

/// The value in `units_per_m`, checked.
/// @throws Error when it is not above 0 and at most 1e6.
[[nodiscard]] double checkedDepthUnits(double units_per_m, const std::string& where);

}  // namespace occusg
