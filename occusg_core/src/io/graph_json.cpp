// SPDX-License-Identifier: BSD-3-Clause
#include "io/graph_json.hpp"

#include "io/json_text.hpp"

namespace occusg {

using nlohmann::json;

const char* nameOf(RoomReason reason) {
  switch (reason) {
    case RoomReason::kBootstrap:
      return "bootstrap";
    case RoomReason::kVisited:
      return "visited";
    case RoomReason::kPromoted:
      return "promoted";
  }
  return "";
}

const char* nameOf(RoomState state) {
  return state == RoomState::kConfirmed ? "confirmed" : "partial";
}

const char* nameOf(LabelSource source) {
  return source == LabelSource::kPerson ? "person" : "automatic";
}

const char* nameOf(StairsKind kind) {
  switch (kind) {
    case StairsKind::kStairs:
      return "stairs";
    case StairsKind::kRamp:
      return "ramp";
    case StairsKind::kLift:
      return "lift";
  }
  return "";
}

json jsonOf(const Eigen::Vector3d& point) {
  return json::array({rounded(point.x()), rounded(point.y()), rounded(point.z())});
}

json jsonOf(const Segment2& segment) { return jsonOf(Ring{segment.a, segment.b}); }

json histogramOf(const ObjectAttributes& object) {
  constexpr int kDigits = 6;
  json histogram = json::object();
  for (const auto& [name, sum] : object.class_histogram) histogram[name] = rounded(sum, kDigits);
  return histogram;
}

json cornersOf(const Eigen::AlignedBox3d& box) {
  return json::array({jsonOf(Eigen::Vector3d(box.min())), jsonOf(Eigen::Vector3d(box.max()))});
}

json crossingsOf(const Edge& edge) {
  json crossings = json::array();
  for (const Segment2& crossing : edge.crossings) crossings.push_back(jsonOf(crossing));
  return crossings;
}

Eigen::Quaterniond canonicalRotation(const Pose& pose) {
  constexpr int kDigits = 6;
  const Eigen::Quaterniond q(pose.linear());
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  return {rounded(sign * q.w(), kDigits), rounded(sign * q.x(), kDigits),
          rounded(sign * q.y(), kDigits), rounded(sign * q.z(), kDigits)};
}

}  // namespace occusg
