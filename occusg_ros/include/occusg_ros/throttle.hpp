// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "occusg_ros/input_health.hpp"

namespace occusg_ros {

/// Lets one of many equal warnings through every few seconds. By the steady clock: rosconsole's own
/// throttle follows the clock of ROS, and says nothing when that stands still.
class Throttle {
 public:
  explicit Throttle(double period_s) : period_s_(period_s) {}

  /// Whether it is time again; usable from all threads.
  [[nodiscard]] bool allows() {
    const double now_s = steadySeconds();
    double last_s = last_s_;
    return now_s - last_s >= period_s_ && last_s_.compare_exchange_strong(last_s, now_s);
  }

 private:
  double period_s_;
  std::atomic<double> last_s_{-1e9};
};

}  // namespace occusg_ros
