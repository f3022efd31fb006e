// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg_ros/markers.hpp"
#include "occusg_ros/parameters.hpp"
#include "occusg_ros/pose_input.hpp"
#include "occusg_ros/saved_folder.hpp"

namespace occusg_ros {

/// The parameters of occusg/scene_graph besides those of the pipeline.
struct SceneGraphSettings {
  std::string map_frame = "map";
  std::string robot_frame = "base_link";
  PoseSource pose_source = PoseSource::kTf;
  std::string map;
  std::string odom;
  std::string pose;
  double free_below_percent = 0.0;
  double occupied_above_percent = 0.0;
  double robot_radius_m = 0.2;
  std::string scene = "scene";
  double tf_timeout_s = 0.5;
  double tf_cache_s = 10.0;
  bool allow_reset = true;
  bool save_on_exit = true;
  double autosave_period_s = 30.0;
  std::string save_folder;
  SaveQuota save_quota;
  std::string resume;
  std::string mapping_node = "mapping";
  MarkerLayout layout;
};

/// The occupancy above which a cell is occupied [%], never below the one it is free below.
[[nodiscard]] inline double occupiedAbove(const SceneGraphSettings& settings) {
  return std::max(settings.occupied_above_percent, settings.free_below_percent);
}

/// The settings by name.
/// @param settings outlives the parameters.
[[nodiscard]] inline std::vector<occusg::Parameter> parametersOf(SceneGraphSettings& settings) {
  using occusg::choiceParameter;
  using occusg::countParameter;
  using occusg::numberParameter;
  const std::vector<std::pair<std::string, bool>> kYesNo = {{"true", true}, {"false", false}};
  MarkerLayout& layout = settings.layout;
  return {
      textParameter(settings.map_frame, {"map_frame", "", "Frame of the map."}),
      textParameter(settings.robot_frame,
                    {"robot_frame", "", "Frame of the robot; with pose_source tf."}),
      choiceParameter<PoseSource>(settings.pose_source,
                                  {{"tf", PoseSource::kTf},
                                   {"odometry", PoseSource::kOdometry},
                                   {"pose", PoseSource::kPose}},
                                  {"pose_source", "", "Where the robot's pose comes from."}),
      textParameter(
          settings.map,
          {"map", "", "Topic of the 2D map, below the robot's namespace; empty: free_space."}),
      textParameter(settings.odom, {"odom", "", "Topic of the odometry, likewise; empty: odom."}),
      textParameter(
          settings.pose,
          {"pose", "", "Topic of the poses with pose_source pose, likewise; empty: pose."}),
      numberParameter(
          settings.free_below_percent, {0.0, 100.0},
          {"free_below_percent", "%",
           "Cells of the 2D map below this occupancy are free; 0: only those of 0, or below 50 "
           "in a map of probabilities."}),
      numberParameter(settings.occupied_above_percent, {0.0, 100.0},
                      {"occupied_above_percent", "%",
                       "Cells above this occupancy are occupied; used with free_below_percent."}),
      numberParameter(settings.robot_radius_m, {0.0, 10.0},
                      {"robot_radius", "m",
                       "Clearance that paths of get_path keep from all that is not free."}),
      textParameter(settings.scene, {"scene", "", "What the scene is called."}),
      numberParameter(settings.tf_timeout_s, {0.0, 60.0},
                      {"tf_timeout_s", "s", "How long free space waits for the pose of its time."}),
      numberParameter(settings.tf_cache_s, {1.0, 3600.0},
                      {"tf_cache_s", "s", "How long transforms are remembered."}),
      choiceParameter<bool>(settings.allow_reset, kYesNo,
                            {"allow_reset", "", "Whether the reset service may be used."}),
      choiceParameter<bool>(
          settings.save_on_exit, kYesNo,
          {"save_on_exit", "", "Whether the rooms are saved as 'last' at the end."}),
      numberParameter(
          settings.autosave_period_s, {0.0, 86400.0},
          {"autosave_period_s", "s",
           "The rooms are saved as 'last' so often while they change; 0: only at the end."}),
      countParameter(
          settings.save_quota.max_saves, {1, 100'000},
          {"max_saves", "", "Most names under which the service ~save keeps something."}),
      numberParameter(
          settings.save_quota.min_free_disk_mb, {0.0, 1e9},
          {"min_free_disk_mb", "MB", "What the service ~save leaves free on the disk."}),
      textParameter(
          settings.save_folder,
          {"save_folder", "",
           "Where rooms are saved; empty: ~/.ros/occusg, and below it the robot's namespace."}),
      textParameter(settings.resume,
                    {"resume", "", "Name of a saved session to go on from; empty: begin anew."}),
      textParameter(settings.mapping_node,
                    {"mapping_node", "",
                     "Node whose map is saved, loaded and reset along; empty: there is none."}),
      numberParameter(layout.room_height_m, {-1000.0, 1000.0},
                      {"room_height_m", "m", "Room nodes float so high above their floor."}),
      numberParameter(layout.object_height_m, {-1000.0, 1000.0},
                      {"object_height_m", "m", "Objects are drawn so much above where they are."}),
      numberParameter(layout.navigation_height_m, {-1000.0, 1000.0},
                      {"navigation_height_m", "m", "Navigation nodes float so high."}),
      numberParameter(layout.room_opacity, {0.0, 1.0},
                      {"room_opacity", "", "Of the coloured floor of a room."}),
      choiceParameter<bool>(layout.show_regions, kYesNo,
                            {"show_regions", "", "Draw the outlines of all regions."}),
      choiceParameter<bool>(layout.show_containment, kYesNo,
                            {"show_containment", "", "Draw lines to what is in a room."})};
}

}  // namespace occusg_ros
