// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace occusg_ros {

/// Whether simulated time goes on.
class ClockState {
 public:
  /// @param now_s the clock of ROS.
  /// @param steady_s a clock that cannot stand still.
  void note(bool is_simulated, double now_s, double steady_s) {
    if (!is_simulated || now_s != now_s_ || !has_been_noted_) since_s_ = steady_s;
    has_been_noted_ = true;
    is_simulated_ = is_simulated;
    now_s_ = now_s;
    steady_s_ = steady_s;
  }

  /// A sentence; empty while time goes on.
  [[nodiscard]] std::string problem() const {
    constexpr double kPatience_s = 5.0;
    if (!is_simulated_) return "";
    if (now_s_ == 0.0) return "use_sim_time is set but no /clock comes; start the bag with --clock";
    const double standing_s = steady_s_ - since_s_;
    if (standing_s < kPatience_s) return "";
    return "time stands still: use_sim_time is set and /clock has not moved for " +
           std::to_string(static_cast<int>(standing_s)) + " s";
  }

 private:
  bool has_been_noted_ = false;
  bool is_simulated_ = false;
  double now_s_ = 0.0;
  double steady_s_ = 0.0;
  double since_s_ = 0.0;
};

}  // namespace occusg_ros
