// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/saver.hpp"

#include <chrono>
#include <exception>
#include <utility>

namespace occusg_ros {

Saver::Saver(double period_s, double now_s, Report report)
    : period_s_(period_s), last_s_(now_s), report_(std::move(report)) {}

Saver::~Saver() {
  if (background_.valid()) background_.wait();
}

bool Saver::isDue(double now_s) const {
  if (!(period_s_ > 0.0) || now_s - last_s_ < period_s_) return false;
  return !background_.valid() ||
         background_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void Saver::writeInBackground(double now_s, Writing writing) {
  last_s_ = now_s;
  background_ = std::async(std::launch::async, [this, writing = std::move(writing)] {
    std::string problem;
    try {
      write(writing);
    } catch (const std::exception& error) {
      problem = error.what();
    }
    report_(problem);
  });
}

void Saver::write(const Writing& writing) {
  const std::lock_guard<std::mutex> lock(writing_mutex_);
  writing();
}

}  // namespace occusg_ros
