// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "occusg/geometry/pose.hpp"
#include "occusg/perception/camera_model.hpp"
#include "occusg/perception/depth_projector.hpp"

namespace occusg {

/// One depth image with what is needed to place it in space and time.
struct DepthFrame {
  double stamp_s = 0.0;
  DepthImage depth;
  CameraModel camera;
  Pose T_map_camera = Pose::Identity();  ///< Camera optical frame in the map (REP 103, REP 105).
};

}  // namespace occusg
