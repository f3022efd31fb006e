// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "occusg_ros/guarded.hpp"

namespace occusg_ros {

/// How long the workers of the nodes wait for a reason before they look again.
inline constexpr std::chrono::milliseconds kWorkerPoll{10};
/// How long a service waits for what it asks of a worker.
inline constexpr std::chrono::milliseconds kServicePatience{30000};

/// One thread on which everything that touches a pipeline runs, so that no callback of ROS waits
/// for a frame and no lock is held while one is processed.
class Worker {
 public:
  using Task = std::function<void()>;
  enum class Progress { kWorked, kIdle };

  /// @param step called again and again between tasks; after kIdle, once there is a reason again:
  /// a task, a `wake`, or `poll` has passed.
  /// @param on_failure hears what a task or `step` threw, on the worker's thread; the worker goes
  /// on. Must not throw.
  Worker(std::chrono::milliseconds poll, std::function<Progress()> step,
         std::function<void(const Failure&)> on_failure);
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  Worker(Worker&&) = delete;
  Worker& operator=(Worker&&) = delete;
  /// Finishes the task it is at, drops the others, joins.
  ~Worker();

  /// Runs `task` on the thread, in order, before the next step.
  void post(Task task);
  /// Posts `task` and waits for it; false when it did not end in time (it still will) or the worker
  /// is stopping. Not from the worker's own thread.
  bool run(Task task, std::chrono::milliseconds patience);
  void wake();

 private:
  void loop();

  std::chrono::milliseconds poll_;
  std::function<Progress()> step_;
  std::function<void(const Failure&)> on_failure_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  bool woken_ = false;
  bool stopping_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace occusg_ros
