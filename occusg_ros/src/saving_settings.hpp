// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg_ros/parameters.hpp"
#include "occusg_ros/saved_folder.hpp"

namespace occusg_ros {

/// The parameters that every node that saves something has.
struct SavingSettings {
  bool allow_reset = true;
  bool save_on_exit = true;
  double autosave_period_s = 30.0;
  std::string save_folder;
  SaveQuota save_quota;
  std::string resume;
};

/// The settings by name.
/// @param what is saved, in the plural: "rooms".
/// @param settings outlives the parameters.
[[nodiscard]] inline std::vector<occusg::Parameter> parametersOf(SavingSettings& settings,
                                                                 const std::string& what) {
  using occusg::choiceParameter;
  const std::vector<std::pair<std::string, bool>> yes_or_no = {{"true", true}, {"false", false}};
  return {
      choiceParameter<bool>(settings.allow_reset, yes_or_no,
                            {"allow_reset", "", "Whether the reset service may be used."}),
      choiceParameter<bool>(
          settings.save_on_exit, yes_or_no,
          {"save_on_exit", "", "Whether the " + what + " are saved as 'last' at the end."}),
      occusg::numberParameter(settings.autosave_period_s, {0.0, 86400.0},
                              {"autosave_period_s", "s",
                               "Period in which changed " + what +
                                   " are saved as 'last'; 0: they are saved only at the end."}),
      occusg::countParameter(
          settings.save_quota.max_saves, {1, 100'000},
          {"max_saves", "", "Largest number of names under which the service ~save saves."}),
      occusg::numberParameter(
          settings.save_quota.min_free_disk_mb, {0.0, 1e9},
          {"min_free_disk_mb", "MB", "Space that the service ~save leaves free on the disk."}),
      textParameter(settings.save_folder,
                    {"save_folder", "",
                     "Folder in which " + what +
                         " are saved; empty: ~/.ros/occusg, and below it the robot's namespace."}),
      textParameter(
          settings.resume,
          {"resume", "", "Name of saved " + what + " to continue from; empty: start anew."})};
}

}  // namespace occusg_ros
