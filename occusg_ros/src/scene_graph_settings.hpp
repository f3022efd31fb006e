// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg_ros/markers.hpp"
#include "occusg_ros/parameters.hpp"
#include "occusg_ros/pose_input.hpp"
#include "saving_settings.hpp"

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
  SavingSettings saving;
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
  using occusg::numberParameter;
  const std::vector<std::pair<std::string, bool>> kYesNo = {{"true", true}, {"false", false}};
  MarkerLayout& layout = settings.layout;
  std::vector<occusg::Parameter> parameters = {
      textParameter(settings.map_frame, {"map_frame", "", "Frame of the map."}),
      textParameter(settings.robot_frame,
                    {"robot_frame", "", "Frame of the robot, used with pose_source tf."}),
      choiceParameter<PoseSource>(settings.pose_source,
                                  {{"tf", PoseSource::kTf},
                                   {"odometry", PoseSource::kOdometry},
                                   {"pose", PoseSource::kPose}},
                                  {"pose_source", "", "Source of the robot's pose."}),
      textParameter(
          settings.map,
          {"map", "", "Topic of the 2D map, below the robot's namespace; empty: free_space."}),
      textParameter(
          settings.odom,
          {"odom", "", "Topic of the odometry, below the robot's namespace; empty: odom."}),
      textParameter(settings.pose, {"pose", "",
                                    "Topic of the poses, below the robot's namespace, used with "
                                    "pose_source pose; empty: pose."}),
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
      textParameter(settings.scene, {"scene", "", "Name of the scene in the results."}),
      numberParameter(
          settings.tf_timeout_s, {0.0, 60.0},
          {"tf_timeout_s", "s", "Time that free space waits for the pose at its stamp."}),
      numberParameter(settings.tf_cache_s, {1.0, 3600.0},
                      {"tf_cache_s", "s", "Time for which transforms are kept."}),
      textParameter(
          settings.mapping_node,
          {"mapping_node", "",
           "Node whose map is saved, loaded and reset together with the rooms; empty: none."}),
      numberParameter(layout.room_height_m, {-1000.0, 1000.0},
                      {"room_height_m", "m", "Height of room nodes above their floor in rviz."}),
      numberParameter(layout.object_height_m, {-1000.0, 1000.0},
                      {"object_height_m", "m", "Height of objects above their place in rviz."}),
      numberParameter(
          layout.navigation_height_m, {-1000.0, 1000.0},
          {"navigation_height_m", "m", "Height of navigation nodes above the floor in rviz."}),
      numberParameter(layout.room_opacity, {0.0, 1.0},
                      {"room_opacity", "", "Opacity of the coloured floors of rooms in rviz."}),
      choiceParameter<bool>(
          layout.show_regions, kYesNo,
          {"show_regions", "", "Whether the outlines of all regions are shown in rviz."}),
      choiceParameter<bool>(
          layout.show_containment, kYesNo,
          {"show_containment", "", "Whether lines join rooms to their contents in rviz."})};
  const std::vector<occusg::Parameter> saving = parametersOf(settings.saving, "rooms");
  parameters.insert(parameters.end(), saving.begin(), saving.end());
  return parameters;
}

}  // namespace occusg_ros
