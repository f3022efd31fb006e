// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/parameter.hpp"

namespace occusg {

/// How fast a camera may move.
struct PoseGateConfig {
  double max_speed_m_s = 20.0;  ///< No robot moves faster [m/s], positive.
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(PoseGateConfig& config);

/// Tells poses that jumped from poses a robot can have: at the speed allowed it must get there,
/// give or take a metre, from the last pose used or from the last one seen. So a single pose
/// that jumped costs one frame, and a localisation that found the robot somewhere else is believed
/// from its second pose on.
class PoseGate {
 public:
  /// @throws Error when the configuration breaks a rule.
  explicit PoseGate(const PoseGateConfig& config);

  /// Whether to believe the pose; remembers it as the last one seen.
  /// @param stamp_s after the stamps before; where it is not, the pose counts as a second later.
  [[nodiscard]] bool believes(const Pose& T_map_camera, double stamp_s);
  /// The last pose seen was used: the next ones may follow from it.
  void used() { last_used_ = last_; }

 private:
  struct Seen {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double stamp_s = 0.0;
  };
  [[nodiscard]] bool isReachable(const Seen& from, const Seen& to) const;

  PoseGateConfig config_;
  std::optional<Seen> last_;
  std::optional<Seen> last_used_;
};

}  // namespace occusg
