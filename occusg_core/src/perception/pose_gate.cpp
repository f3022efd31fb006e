// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/pose_gate.hpp"

namespace occusg {
namespace {

/// By so much poses of a localisation are corrected from one to the next.
constexpr double kCorrection_m = 1.0;

}  // namespace

PoseGate::PoseGate(const PoseGateConfig& config) : config_(checked(config)) {}

bool PoseGate::believes(const Pose& T_map_camera, double stamp_s) {
  const Seen now{T_map_camera.translation(), stamp_s};
  const bool believed =
      !last_ || isReachable(*last_, now) || (last_used_ && isReachable(*last_used_, now));
  last_ = now;
  return believed;
}

bool PoseGate::isReachable(const Seen& from, const Seen& to) const {
  const double elapsed_s = to.stamp_s > from.stamp_s ? to.stamp_s - from.stamp_s : 1.0;
  return (to.position - from.position).norm() <= config_.max_speed_m_s * elapsed_s + kCorrection_m;
}

}  // namespace occusg
