// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/worker.hpp"

#include <future>
#include <memory>
#include <utility>

namespace occusg_ros {

Worker::Worker(std::chrono::milliseconds poll, std::function<Progress()> step,
               std::function<void(const Failure&)> on_failure)
    : poll_(poll),
      step_(std::move(step)),
      on_failure_(std::move(on_failure)),
      thread_([this] { loop(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    tasks_.clear();
  }
  changed_.notify_all();
  thread_.join();
}

void Worker::post(Task task) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_) return;
    tasks_.push_back(std::move(task));
  }
  changed_.notify_all();
}

bool Worker::run(Task task, std::chrono::milliseconds patience) {
  // Shared, because the task may outlive this call. A task that is dropped breaks the promise,
  // which also ends the wait.
  const auto done = std::make_shared<std::promise<void>>();
  std::future<void> future = done->get_future();
  post([task = std::move(task), done] {
    task();
    done->set_value();
  });
  if (future.wait_for(patience) != std::future_status::ready) return false;
  try {
    future.get();
  } catch (const std::future_error&) {
    return false;
  }
  return true;
}

void Worker::wake() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    woken_ = true;
  }
  changed_.notify_all();
}

void Worker::loop() {
  auto progress = Progress::kWorked;
  while (true) {
    Task task;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      if (progress == Progress::kIdle)
        changed_.wait_for(lock, poll_, [this] { return stopping_ || woken_ || !tasks_.empty(); });
      if (stopping_) return;
      woken_ = false;
      if (!tasks_.empty()) {
        task = std::move(tasks_.front());
        tasks_.pop_front();
      }
    }
    // A step that failed is not tried again at once.
    progress = Progress::kIdle;
    guarded(
        "a step of the worker",
        [&] {
          if (task) {
            task();
            progress = Progress::kWorked;
          } else {
            progress = step_();
          }
        },
        on_failure_);
  }
}

}  // namespace occusg_ros
