// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Parts the graph's JSON formats share.

inline constexpr int kStampDigits = 6;  ///< Of a stamp [s], behind the point.
inline constexpr int kScoreDigits = 6;  ///< Of a score or share, behind the point.

/// "bootstrap", "visited" or "promoted".
[[nodiscard]] const char* nameOf(RoomReason reason);
/// "confirmed" or "partial".
[[nodiscard]] const char* nameOf(RoomState state);
/// "person" or "automatic".
[[nodiscard]] const char* nameOf(LabelSource source);
/// "stairs", "ramp" or "lift".
[[nodiscard]] const char* nameOf(StairsKind kind);
[[nodiscard]] nlohmann::json jsonOf(const Eigen::Vector3d& point);
[[nodiscard]] nlohmann::json jsonOf(const Segment2& segment);
/// {class: sum of scores}.
[[nodiscard]] nlohmann::json histogramOf(const ObjectAttributes& object);
/// [lowest corner, highest corner].
/// @pre not empty.
[[nodiscard]] nlohmann::json cornersOf(const Eigen::AlignedBox3d& box);
[[nodiscard]] nlohmann::json crossingsOf(const Edge& edge);
/// Rotation of the pose, rounded to 1e-6; of the two quaternions that mean it the one with w >= 0,
/// so that equal poses give equal bytes.
[[nodiscard]] Eigen::Quaterniond canonicalRotation(const Pose& pose);

}  // namespace occusg
