// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>
#include <ros/time.h>

#include <string>

#include "node_handles.hpp"
#include "occusg_ros/throttle.hpp"

namespace occusg_ros {

/// Says so when time is simulated but nobody simulates it: everything would wait without a word.
class ClockCheck {
 public:
  void warn(const std::string& node) {
    if (!ros::Time::isSimTime() || !ros::Time::now().isZero() || !warnings_.allows()) return;
    ROS_WARN_STREAM(
        node << ": use_sim_time is set but no /clock comes; start the bag with --clock");
  }

 private:
  Throttle warnings_{kWarningPeriod_s};
};

}  // namespace occusg_ros
