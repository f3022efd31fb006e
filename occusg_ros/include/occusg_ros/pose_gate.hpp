// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "occusg/geometry/pose.hpp"

namespace occusg_ros {

struct PoseGateConfig {
  double max_jump_m = 1.0;      ///< Farther from one frame to the next is no motion [m].
  double max_jump_rad = 0.79;   ///< Nor is a larger turn [rad].
  double max_interval_s = 1.0;  ///< Frames farther apart in time are not compared [s].
  int frames_to_accept = 5;     ///< So many frames in a row at the new place are a relocalisation.
};

enum class PoseVerdict { kUsual, kJump, kRelocalised };

/// Holds back frames whose pose jumps: a glitch of the localisation must not smear the map, while a
/// relocalisation, a jump that stays, must go through.
class PoseGate {
 public:
  explicit PoseGate(const PoseGateConfig& config) : config_(config) {}

  PoseVerdict take(const occusg::Pose& T_map_camera, double stamp_s);
  void reset() { *this = PoseGate(config_); }
  void configure(const PoseGateConfig& config) { config_ = config; }

 private:
  struct Sample {
    occusg::Pose pose;
    double stamp_s = 0.0;
  };
  [[nodiscard]] bool follows(const Sample& before, const Sample& sample) const;

  PoseGateConfig config_;
  std::optional<Sample> accepted_;
  std::optional<Sample> held_;  ///< The last one held back.
  int held_in_a_row_ = 0;       ///< That follow each other.
};

}  // namespace occusg_ros
