// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <mutex>
#include <string>

#include "node_handles.hpp"
#include "occusg_ros/clock_state.hpp"
#include "occusg_ros/input_health.hpp"
#include "occusg_ros/throttle.hpp"

namespace occusg_ros {

/// Says so when time stands still: everything would wait without a word.
class ClockCheck {
 public:
  /// Looks at the clock; to be called every second.
  void warn(const std::string& node) {
    std::string problem;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      state_.note(ros::Time::isSimTime(), ros::Time::now().toSec(), steadySeconds());
      problem = state_.problem();
    }
    if (!problem.empty() && warnings_.allows()) ROS_WARN_STREAM(node << ": " << problem);
  }

  /// What is wrong with the clock; empty when nothing is.
  [[nodiscard]] std::string problem() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return state_.problem();
  }

 private:
  mutable std::mutex mutex_;  ///< Of `state_`.
  ClockState state_;
  Throttle warnings_{kWarningPeriod_s};
};

}  // namespace occusg_ros
