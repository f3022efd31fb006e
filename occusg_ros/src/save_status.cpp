// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/save_status.hpp"

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <cmath>

namespace occusg_ros {

void SaveStatus::note(const std::string& folder, const std::string& problem, double now_s) {
  problem_ = problem;
  last_ = problem.empty() ? folder : "failed: " + problem;
  if (problem.empty()) saved_s_ = now_s;
}

void SaveStatus::describe(diagnostic_updater::DiagnosticStatusWrapper& status, double now_s) const {
  status.add("last save", last_);
  if (problem_.empty()) return;
  using Level = diagnostic_msgs::DiagnosticStatus;
  constexpr double kMinute_s = 60.0;
  const double age_s = now_s - saved_s_;
  const auto minutes = std::to_string(std::lround(age_s / kMinute_s));
  status.mergeSummary(age_s > kMinute_s ? Level::ERROR : Level::WARN,
                      "nothing saved for " + minutes + " min: " + problem_);
}

}  // namespace occusg_ros
