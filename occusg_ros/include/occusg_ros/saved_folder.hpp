// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace occusg_ros {

/// What nothing else is called.
inline constexpr const char* kDefaultSaveName = "last";

/// `name`, or "last" when it is empty. Any peer of a ROS network may call a service: it may choose
/// a name inside the configured folder, never a path.
/// @throws occusg::Error unless it is 1 to 64 letters, digits, '.', '_' or '-', the first no dot.
[[nodiscard]] std::string checkedSaveName(const std::string& name);

/// Environment variable with the folder that every `save_folder` must lie in; unset: any will do.
/// A peer can set a parameter before a node starts, but not the node's environment.
inline constexpr const char* kSaveRootVariable = "OCCUSG_SAVE_ROOT";

/// `folder` with a leading "~" replaced by the user's home; when empty, `occusg` in ROS_HOME or
/// ~/.ros, and below it the robot's namespace (`robotNamespace`), so that two robots keep apart.
/// @throws occusg::Error when it takes a home and there is none, and when it is outside
/// OCCUSG_SAVE_ROOT.
[[nodiscard]] std::string expandedFolder(const std::string& folder,
                                         const std::string& node_namespace = "/");

/// What peers may fill the disk with by asking for saves of ever other names.
struct SaveQuota {
  int max_saves = 100;              ///< Names in the folder; the autosave's generations count.
  double min_free_disk_mb = 200.0;  ///< What a save leaves free, for the autosave [MB].
};

/// @throws occusg::Error when a save of this name would go beyond the quota; "last" never does.
void checkQuota(const std::string& save_folder, const std::string& name, const SaveQuota& quota);

/// The file of the 3D map in a folder that was saved; a session that `occusg run` saved has it
/// inside.
[[nodiscard]] std::string mapFileIn(const std::string& folder);
/// The folder of the session in a folder that was saved.
[[nodiscard]] std::string sessionIn(const std::string& folder);

/// roslaunch's name of this run; empty without roslaunch.
[[nodiscard]] std::string runId();

}  // namespace occusg_ros
