// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg_ros/parameters.hpp"
#include "occusg_ros/pending_frames.hpp"
#include "occusg_ros/pose_gate.hpp"
#include "occusg_ros/pose_input.hpp"
#include "saving_settings.hpp"

namespace occusg_ros {

/// What is done with the map when the clock jumps back.
enum class OnTimeJump { kKeep, kReset };

/// What can change while the node runs.
struct MappingLive {
  double tf_timeout_s = 0.5;
  double voxels_period_s = 2.0;
  PoseGateConfig pose_gate;
};

/// The parameters of occusg/mapping besides those of the pipeline.
struct MappingSettings {
  std::string map_frame = "map";
  std::string robot_frame = "base_link";
  PoseSource pose_source = PoseSource::kTf;
  std::string odom;
  std::string pose;
  std::string depth_image;
  std::string depth_info;
  std::string image_transport = "raw";
  double depth_units_per_m = 1000.0;
  int queue_size = 10;
  double tf_cache_s = 10.0;
  Overload overload = Overload::kSkip;
  OnTimeJump on_time_jump = OnTimeJump::kKeep;
  double soft_memory_mib = 1000.0;
  bool find_storeys = true;
  SavingSettings saving;
  MappingLive live;
};

/// What can change while the node runs, by name.
/// @param live outlives the parameters.
[[nodiscard]] inline std::vector<occusg::Parameter> parametersOf(MappingLive& live) {
  using occusg::countParameter;
  using occusg::numberParameter;
  return {
      numberParameter(live.tf_timeout_s, {0.0, 60.0},
                      {"tf_timeout_s", "s", "Time that an image waits for its transform."}),
      numberParameter(
          live.voxels_period_s, {0.1, 3600.0},
          {"voxels_period_s", "s", "Period in which the occupied voxels are published."}),
      numberParameter(
          live.pose_gate.max_jump_m, {0.01, 1000.0},
          {"max_pose_jump_m", "m",
           "Distance between two frames beyond which the second is held back as a jump."}),
      numberParameter(live.pose_gate.max_jump_rad, {0.01, 3.2},
                      {"max_pose_jump_rad", "rad",
                       "Angle between two frames beyond which the second is held back as a jump."}),
      countParameter(live.pose_gate.frames_to_accept, {1, 1000},
                     {"pose_jump_frames", "frames",
                      "Number of frames in a row at a new place that count as a relocalisation."})};
}

/// The settings by name.
/// @param settings outlives the parameters.
[[nodiscard]] inline std::vector<occusg::Parameter> parametersOf(MappingSettings& settings) {
  using occusg::choiceParameter;
  using occusg::countParameter;
  using occusg::numberParameter;
  std::vector<occusg::Parameter> parameters = {
      textParameter(settings.map_frame, {"map_frame", "", "Frame of the map."}),
      textParameter(
          settings.robot_frame,
          {"robot_frame", "",
           "Frame of the robot whose pose is received with pose_source odometry or pose."}),
      choiceParameter<PoseSource>(
          settings.pose_source,
          {{"tf", PoseSource::kTf},
           {"odometry", PoseSource::kOdometry},
           {"pose", PoseSource::kPose}},
          {"pose_source", "",
           "Source of the robot's pose; the mount of the camera always comes from tf."}),
      textParameter(
          settings.odom,
          {"odom", "", "Topic of the odometry, below the robot's namespace; empty: odom."}),
      textParameter(settings.pose,
                    {"pose", "", "Topic of the poses, below the robot's namespace; empty: pose."}),
      textParameter(
          settings.depth_image,
          {"depth_image", "",
           "Topic of the depth images, below the robot's namespace; empty: depth/image_rect."}),
      textParameter(settings.depth_info, {"depth_info", "",
                                          "Topic of the camera_info of the depth images, below the "
                                          "robot's namespace; empty: depth/camera_info."}),
      textParameter(
          settings.image_transport,
          {"image_transport", "", "Transport of the depth images: raw, compressedDepth, ..."}),
      numberParameter(
          settings.depth_units_per_m, {1.0, 1e6},
          {"depth_units_per_m", "1/m",
           "Value of one metre in 16-bit depth images: 1000 by REP 118; 4000 for an L515."}),
      countParameter(settings.queue_size, {1, 10000},
                     {"queue_size", "images", "Largest number of images that wait."}),
      numberParameter(settings.tf_cache_s, {1.0, 3600.0},
                      {"tf_cache_s", "s", "Time for which transforms are kept."}),
      choiceParameter<Overload>(
          settings.overload, {{"skip", Overload::kSkip}, {"queue", Overload::kQueue}},
          {"overload", "", "What happens to images that arrive faster than they are processed."}),
      choiceParameter<OnTimeJump>(
          settings.on_time_jump, {{"keep", OnTimeJump::kKeep}, {"reset", OnTimeJump::kReset}},
          {"on_time_jump", "", "What happens to the map when the clock jumps back."}),
      choiceParameter<bool>(
          settings.find_storeys, {{"true", true}, {"false", false}},
          {"find_storeys", "",
           "Whether each storey of a building gets a free space of its own; false: one for all."}),
      numberParameter(
          settings.soft_memory_mib, {1.0, 1e6},
          {"soft_memory_mib", "MiB", "Size of the map above which a warning is given."})};
  for (const std::vector<occusg::Parameter>& others :
       {parametersOf(settings.live), parametersOf(settings.saving, "maps")})
    parameters.insert(parameters.end(), others.begin(), others.end());
  return parameters;
}

}  // namespace occusg_ros
