// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/saver.hpp"

#include <malloc.h>
#include <ros/console.h>

#include <exception>
#include <utility>

namespace occusg_ros {

Saver::Saver(double period_s, double now_s, Report report)
    : period_s_(period_s),
      last_s_(now_s),
      report_(std::move(report)),
      thread_([this] { loop(); }) {}

Saver::~Saver() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool Saver::isDue(double now_s) const {
  return period_s_ > 0.0 && now_s - last_s_ >= period_s_ && !is_busy_;
}

void Saver::writeInBackground(double now_s, Writing writing) {
  last_s_ = now_s;
  is_busy_ = true;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    next_ = std::move(writing);
  }
  changed_.notify_all();
}

void Saver::loop() {
  while (true) {
    Writing writing;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || next_; });
      // What was asked for before the end is written.
      if (!next_) return;
      writing = std::exchange(next_, nullptr);
    }
    writeAndReport(writing);
    writing = nullptr;
    // The copy that was written is large, and the allocator keeps what it held.
    (void)::malloc_trim(0);
    is_busy_ = false;
  }
}

void Saver::writeAndReport(const Writing& writing) {
  std::string problem;
  try {
    write(writing);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  report_(problem);
}

void Saver::write(const Writing& writing) {
  const std::lock_guard<std::mutex> lock(writing_mutex_);
  writing();
}

void Saver::saveAtEnd(const std::string& node, const std::function<std::string()>& save) {
  if (std::exchange(is_saved_at_end_, true)) return;
  hurry();
  try {
    ROS_INFO_STREAM(node << ": saved to " << save());
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM(node << ": not saved: " << error.what());
  }
}

}  // namespace occusg_ros
