// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/saved_folder.hpp"

#include <ros/param.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "occusg/error.hpp"
#include "occusg_ros/topic_names.hpp"

namespace occusg_ros {
namespace {

constexpr std::size_t kMaxNameLength = 64;

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool isPlain(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-';
}

/// A "~" replaced, and the default folder put in place of none.
std::string expanded(const std::string& folder, const std::string& node_namespace) {
  if (folder.empty()) {
    const std::string robot = robotNamespace(node_namespace);
    const std::string own = robot == "/" ? "" : robot;
    const std::string ros_home = environment("ROS_HOME");
    return ros_home.empty() ? expanded("~/.ros/occusg" + own, node_namespace)
                            : ros_home + "/occusg" + own;
  }
  if (folder.front() != '~') return folder;
  const std::string home = environment("HOME");
  if (home.empty()) {
    throw occusg::refuse("save_folder", "'" + folder + "' needs HOME, which is not set",
                         "give an absolute path");
  }
  return home + folder.substr(1);
}

/// Links are followed on both sides, so that none leads out.
bool isWithin(const std::string& folder, const std::string& root) {
  namespace fs = std::filesystem;
  std::error_code failed;
  const fs::path inner = fs::weakly_canonical(fs::absolute(folder), failed);
  if (failed) return false;
  fs::path outer = fs::weakly_canonical(fs::absolute(root), failed);
  if (failed) return false;
  if (outer.filename().empty()) outer = outer.parent_path();  // of a "/" at its end
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

}  // namespace

std::string checkedSaveName(const std::string& name) {
  if (name.empty()) return kDefaultSaveName;
  if (name.size() > kMaxNameLength || name.front() == '.' ||
      !std::all_of(name.begin(), name.end(), isPlain)) {
    throw occusg::refuse("name", "'" + name.substr(0, kMaxNameLength) + "' is not a plain name",
                         "use up to 64 letters, digits, '.', '_' and '-', no dot first");
  }
  return name;
}

std::string expandedFolder(const std::string& folder, const std::string& node_namespace) {
  std::string path = expanded(folder, node_namespace);
  const std::string root = environment(kSaveRootVariable);
  if (!root.empty() && !isWithin(path, root)) {
    throw occusg::refuse("~save_folder",
                         "'" + path + "' is outside " + kSaveRootVariable + ", '" + root + "'",
                         "a folder inside it is needed");
  }
  return path;
}

void checkQuota(const std::string& save_folder, const std::string& name, const SaveQuota& quota) {
  namespace fs = std::filesystem;
  if (name == kDefaultSaveName) return;
  std::error_code failed;
  const fs::space_info space = fs::space(save_folder, failed);
  constexpr double kBytesPerMb = 1e6;
  const double free_mb = static_cast<double>(space.available) / kBytesPerMb;
  if (!failed && free_mb < quota.min_free_disk_mb) {
    throw occusg::refuse(save_folder,
                         std::to_string(static_cast<long>(free_mb)) + " MB are free on its disk",
                         "min_free_disk_mb must stay free for the autosave");
  }
  if (fs::exists(fs::path(save_folder) / name, failed)) return;
  int saves = 0;
  for (fs::directory_iterator it(save_folder, failed), end; !failed && it != end;
       it.increment(failed))
    saves += it->is_directory(failed) ? 1 : 0;
  if (saves >= quota.max_saves) {
    throw occusg::refuse(save_folder, "it holds " + std::to_string(saves) + " saves already",
                         "remove some, use a name that is there, or raise max_saves");
  }
}

std::string sessionIn(const std::string& folder) { return folder + "/session"; }

std::string mapFileIn(const std::string& folder) {
  const std::string in_session = sessionIn(folder) + "/map.ot";
  const std::string own = folder + "/map.ot";
  return !std::filesystem::exists(own) && std::filesystem::exists(in_session) ? in_session : own;
}

std::string runId() {
  std::string id;
  (void)ros::param::get("/run_id", id);
  return id;
}

}  // namespace occusg_ros
