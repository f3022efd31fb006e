// SPDX-License-Identifier: BSD-3-Clause
#include "io/part_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

namespace occusg {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".part";

/// The thread in `.NAME.THREAD.part`; 0 when the name is no part's.
pid_t processThatWrites(const std::string& name) {
  constexpr std::size_t kMaxDigits = 9;
  const std::string ending = kEnding;
  if (name.size() <= ending.size() || name.front() != '.') return 0;
  const std::size_t end = name.size() - ending.size();
  if (name.compare(end, ending.size(), ending) != 0) return 0;
  const std::size_t dot = name.rfind('.', end - 1);
  if (dot == std::string::npos || dot < 2) return 0;
  const std::string digits = name.substr(dot + 1, end - dot - 1);
  if (digits.empty() || digits.size() > kMaxDigits ||
      digits.find_first_not_of("0123456789") != std::string::npos)
    return 0;
  return static_cast<pid_t>(std::strtol(digits.c_str(), nullptr, 10));
}

bool isRunning(pid_t thread) { return ::kill(thread, 0) == 0 || errno != ESRCH; }

/// Whether a writer holds the part.
bool isHeld(const fs::path& part) {
  const int descriptor = ::open(part.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool held = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return held;
}

bool isFile(const fs::directory_entry& entry) {
  return fs::is_regular_file(entry.symlink_status());
}

/// A file, or a folder of files alone: what this program leaves.
bool isOurs(const fs::directory_entry& entry) {
  if (isFile(entry)) return true;
  if (!fs::is_directory(entry.symlink_status())) return false;
  const fs::directory_iterator inside(entry.path());
  return std::all_of(begin(inside), end(inside), isFile);
}

bool isStale(const fs::directory_entry& entry) {
  const pid_t writer = processThatWrites(entry.path().filename().string());
  return writer > 0 && !isRunning(writer) && isOurs(entry) && !isHeld(entry.path());
}

}  // namespace

std::string partPath(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / ("." + name + "." + std::to_string(::gettid()) + kEnding)).string();
}

void lockPart(int descriptor) { (void)::flock(descriptor, LOCK_EX | LOCK_NB); }

void removeStaleParts(const std::string& folder) {
  std::vector<fs::path> stale;
  try {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (isStale(entry)) stale.push_back(entry.path());
  } catch (const fs::filesystem_error&) {
    // A part went while it was looked at, or the folder cannot be read: the next start looks again.
  }
  std::error_code ignored;
  for (const fs::path& path : stale) fs::remove_all(path, ignored);
}

}  // namespace occusg
