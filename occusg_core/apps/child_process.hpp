// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace occusg::apps {

/// A program started by this one, in a process group of its own, its output in a file. Ended when
/// the object goes.
class ChildProcess {
 public:
  /// @param command path of the program and its arguments.
  /// @param log_path receives standard output and standard error.
  /// @throws Error when it cannot be started.
  ChildProcess(const std::vector<std::string>& command, const std::string& log_path);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&&) = delete;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();

  /// How it ended, once it has: 0 for fine, the exit code, or minus the number of the signal.
  [[nodiscard]] std::optional<int> ended();
  /// Ends it and what it started.
  void kill();
  [[nodiscard]] double seconds() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> end_;
  std::chrono::steady_clock::time_point start_;
};

/// Path of the running program.
/// @throws Error when the system does not tell.
[[nodiscard]] std::string ownProgram();

}  // namespace occusg::apps
