// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/saved_generations.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "occusg/error.hpp"
#include "occusg_ros/saved_folder.hpp"

namespace occusg_ros {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLifeMark = ".life";

std::string firstLine(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

void writeLine(const fs::path& path, const std::string& line) {
  std::ofstream(path) << line << '\n';
}

/// Held while folders are renamed: the nodes of one life save into the same folder.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder)
      : file_(::open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (file_ >= 0) (void)::flock(file_, LOCK_EX);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock(FolderLock&&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock() {
    if (file_ >= 0) ::close(file_);
  }

 private:
  int file_;
};

std::string ownLife() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::to_string(::getpid()) + "-" + std::to_string(now.count());
}

std::string dateAndTime() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  (void)::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y%m%d-%H%M%S", &parts);
  return {text.data(), length};
}

fs::path generation(const fs::path& folder, int number) {
  return folder / (std::string(kDefaultSaveName) + "." + std::to_string(number));
}

}  // namespace

SavedGenerations::SavedGenerations(std::string folder, std::string run_id, const std::string& node)
    : folder_(std::move(folder)), run_id_(run_id.empty() ? ownLife() : std::move(run_id)) {
  std::string name = node;
  std::replace(name.begin(), name.end(), '/', '_');
  running_mark_ = folder_ + "/.running" + name;
  std::error_code ignored;
  has_crashed_ = fs::exists(running_mark_, ignored) && firstLine(running_mark_) == run_id_;
  // Where nothing can be written, saving says so; there is nothing to go on from either.
  if (!fs::is_directory(folder_, ignored)) fs::create_directories(folder_, ignored);
  writeLine(running_mark_, run_id_);
}

SavedGenerations::~SavedGenerations() {
  std::error_code ignored;
  fs::remove(running_mark_, ignored);
}

void SavedGenerations::makeRoom() const {
  const fs::path folder(folder_);
  const fs::path last = folder / kDefaultSaveName;
  const FolderLock lock(folder);
  try {
    if (fs::exists(last) && firstLine(last / kLifeMark) != run_id_) {
      fs::remove_all(generation(folder, kKept));
      for (int number = kKept; number > 1; --number) {
        if (fs::exists(generation(folder, number - 1)))
          fs::rename(generation(folder, number - 1), generation(folder, number));
      }
      fs::rename(last, generation(folder, 1));
    }
    if (!fs::exists(last)) {
      fs::create_directories(last);
      writeLine(last / kLifeMark, run_id_);
    }
  } catch (const fs::filesystem_error& error) {
    throw occusg::refuse(folder_, std::string("cannot be written (") + error.code().message() + ")",
                         "a folder of the user's own is needed");
  }
}

std::string SavedGenerations::setAside(const std::string& name) const {
  const fs::path folder(folder_);
  const FolderLock lock(folder);
  std::error_code failed;
  if (!fs::exists(folder / name, failed)) return "";
  std::string aside = name + ".refused-" + dateAndTime();
  for (int number = 2; fs::exists(folder / aside, failed); ++number)
    aside = name + ".refused-" + dateAndTime() + "-" + std::to_string(number);
  fs::rename(folder / name, folder / aside, failed);
  return failed ? "" : aside;
}

}  // namespace occusg_ros
