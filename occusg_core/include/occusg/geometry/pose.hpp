// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace occusg {

/// Rigid transform in metres. `T_map_camera` maps camera coordinates into the map frame (REP 105).
/// Unaligned, so that it may live in any container.
using Pose = Eigen::Transform<double, 3, Eigen::Isometry, Eigen::DontAlign>;

/// Largest deviation of a quaternion's norm from one that still counts as rounding of a file.
inline constexpr double kUnitQuaternionTolerance = 1e-3;

/// True when translation and rotation are finite.
[[nodiscard]] bool isFinite(const Pose& pose);

}  // namespace occusg
