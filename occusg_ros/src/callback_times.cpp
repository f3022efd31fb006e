// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/callback_times.hpp"

namespace occusg_ros {

void CallbackTimes::add(const std::string& callback, double duration_ms) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (duration_ms > longest_.duration_ms) longest_ = {duration_ms, callback};
}

CallbackTimes::Longest CallbackTimes::longest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return longest_;
}

void CallbackTimes::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const Longest longest = this->longest();
  status.add("longest callback", longest.callback);
  status.add("longest callback [ms]", longest.duration_ms);
}

}  // namespace occusg_ros
