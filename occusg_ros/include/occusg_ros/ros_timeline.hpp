// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "occusg_ros/stamp_gate.hpp"

namespace occusg_ros {

/// The clock of ROS and the stamps of messages as one time that never goes back: what the stages of
/// the pipeline take. Equals the stamps until the clock jumps back.
class RosTimeline {
 public:
  /// Logical time of the clock; a step back by more than a second is a jump.
  double now(double clock_s) {
    if (clock_s < last_clock_s_ - kJump_s) offset_s_ = last_s_ - clock_s;
    last_clock_s_ = clock_s;
    return at(clock_s);
  }

  /// Logical time of a message, never before what was asked for earlier: a finished map may be
  /// older than the node. One stamp from the future does not stop time: the clock bounds it.
  double at(double stamp_s) {
    const double latest_s = last_clock_s_ > 0.0 ? last_clock_s_ + kFuture_s : stamp_s;
    last_s_ = std::max(last_s_, std::min(stamp_s, latest_s) + offset_s_);
    return last_s_;
  }

  /// The newest time there was.
  [[nodiscard]] double last() const { return last_s_; }

  /// Goes on after `logical_s`, when that is later than the clock: for a session that was saved
  /// under another clock.
  void goOnAfter(double logical_s, double clock_s) {
    last_s_ = std::max(last_s_, logical_s);
    offset_s_ = std::max(offset_s_, last_s_ - clock_s);
    last_clock_s_ = clock_s;
  }

 private:
  static constexpr double kJump_s = 1.0;
  double last_clock_s_ = 0.0;
  double offset_s_ = 0.0;  ///< Logical time minus stamp.
  double last_s_ = 0.0;
};

}  // namespace occusg_ros
