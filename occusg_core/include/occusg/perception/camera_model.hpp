// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace occusg {

/// Pinhole intrinsics of a rectified image, in pixels (REP 103 optical frame: x right, y down,
/// z forward). A pixel (u, v) at depth z lies at ((u - cx) / fx * z, (v - cy) / fy * z, z).
struct CameraModel {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
};

/// Largest image side accepted [pixels].
inline constexpr int kMaxImageSide = 16384;

/// Focal lengths a camera can have, as shares of its image's side: from a field of view of 174
/// degrees to one of half a degree.
inline constexpr double kMinFocalShare = 0.025;
inline constexpr double kMaxFocalShare = 100.0;

/// @throws Error naming `where`, the field, its value and the range, for the first broken rule:
/// sides in [1, kMaxImageSide], focal lengths within the shares above of their side, principal
/// point in [0, width] x [0, height].
void check(const CameraModel& camera, const std::string& where);

}  // namespace occusg
