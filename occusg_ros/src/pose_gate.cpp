// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/pose_gate.hpp"

#include <cmath>

namespace occusg_ros {

bool PoseGate::follows(const Sample& before, const Sample& sample) const {
  if (sample.stamp_s - before.stamp_s > config_.max_interval_s) return true;
  const occusg::Pose motion = before.pose.inverse() * sample.pose;
  const double turn_rad = Eigen::AngleAxisd(motion.linear()).angle();
  return motion.translation().norm() <= config_.max_jump_m &&
         std::abs(turn_rad) <= config_.max_jump_rad;
}

PoseVerdict PoseGate::take(const occusg::Pose& T_map_camera, double stamp_s) {
  const Sample sample{T_map_camera, stamp_s};
  if (!accepted_ || follows(*accepted_, sample)) {
    accepted_ = sample;
    held_.reset();
    held_in_a_row_ = 0;
    return PoseVerdict::kUsual;
  }
  held_in_a_row_ = held_ && follows(*held_, sample) ? held_in_a_row_ + 1 : 1;
  held_ = sample;
  if (held_in_a_row_ < config_.frames_to_accept) return PoseVerdict::kJump;
  accepted_ = sample;
  held_.reset();
  held_in_a_row_ = 0;
  return PoseVerdict::kRelocalised;
}

}  // namespace occusg_ros
