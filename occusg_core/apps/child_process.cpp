// SPDX-License-Identifier: BSD-3-Clause
#include "child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "occusg/error.hpp"

namespace occusg::apps {
namespace {

constexpr int kCannotExecute = 127;

/// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* arguments, int log) {
  setpgid(0, 0);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execv(arguments[0], arguments);
  _exit(kCannotExecute);
}

std::string reason() { return std::generic_category().message(errno); }

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& log_path)
    : start_(std::chrono::steady_clock::now()) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int log = open(log_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (log < 0)
    throw refuse(log_path, "cannot be written (" + reason() + ")", "a writable place is needed");
  pid_ = fork();
  if (pid_ == 0) become(arguments.data(), log);
  close(log);
  if (pid_ < 0) {
    throw refuse(command.front(), "cannot be started (" + reason() + ")",
                 "fewer processes or more memory are needed");
  }
  setpgid(pid_, pid_);  // also here: whoever comes first
}

ChildProcess::~ChildProcess() {
  if (!end_) kill();
}

std::optional<int> ChildProcess::ended() {
  if (end_) return end_;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  end_ = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  return end_;
}

void ChildProcess::kill() {
  if (end_) return;
  ::kill(-pid_, SIGKILL);
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  end_ = -SIGKILL;
}

double ChildProcess::seconds() const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  return elapsed.count();
}

std::string ownProgram() {
  std::error_code failed;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (failed) {
    throw refuse("/proc/self/exe", "cannot be read (" + failed.message() + ")",
                 "a mounted /proc is needed to start runs");
  }
  return path.string();
}

}  // namespace occusg::apps
