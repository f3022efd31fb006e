// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <mutex>
#include <string>
#include <utility>

#include "occusg_ros/input_health.hpp"

namespace occusg_ros {

/// How long a node's callbacks keep a thread of ROS from other work; usable from all threads.
/// Services are left out: those that save or load wait for it, on threads of their own.
class CallbackTimes {
 public:
  struct Longest {
    double duration_ms = 0.0;
    std::string callback;
  };

  /// Measures from its beginning to its end.
  class Timing {
   public:
    Timing(CallbackTimes& times, std::string callback)
        : times_(times), callback_(std::move(callback)) {}
    Timing(const Timing&) = delete;
    Timing& operator=(const Timing&) = delete;
    Timing(Timing&&) = delete;
    Timing& operator=(Timing&&) = delete;
    ~Timing() { times_.add(callback_, 1000.0 * (steadySeconds() - begun_s_)); }

   private:
    CallbackTimes& times_;
    std::string callback_;
    double begun_s_ = steadySeconds();
  };

  void add(const std::string& callback, double duration_ms);
  /// The longest since the node began.
  [[nodiscard]] Longest longest() const;
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  mutable std::mutex mutex_;
  Longest longest_;
};

}  // namespace occusg_ros
