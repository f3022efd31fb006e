// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace occusg::apps {

/// A line on the terminal's standard error that grows with the work and names the time left.
/// Writes nothing when standard error is not a terminal.
class ProgressBar {
 public:
  ProgressBar(std::string what, std::size_t total);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ProgressBar(ProgressBar&&) = delete;
  ProgressBar& operator=(ProgressBar&&) = delete;
  ~ProgressBar();

  void update(std::size_t done);

 private:
  std::string what_;
  std::size_t total_;
  bool on_terminal_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point drawn_;
};

}  // namespace occusg::apps
