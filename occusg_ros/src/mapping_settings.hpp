// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg_ros/parameters.hpp"
#include "occusg_ros/pending_frames.hpp"
#include "occusg_ros/pose_gate.hpp"
#include "occusg_ros/pose_input.hpp"
#include "occusg_ros/saved_folder.hpp"

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
  bool allow_reset = true;
  bool save_on_exit = true;
  double autosave_period_s = 30.0;
  std::string save_folder;
  SaveQuota save_quota;
  std::string resume;
  MappingLive live;
};

/// The settings by name.
/// @param settings outlives the parameters.
[[nodiscard]] inline std::vector<occusg::Parameter> parametersOf(MappingSettings& settings) {
  using occusg::choiceParameter;
  using occusg::countParameter;
  using occusg::numberParameter;
  MappingLive& live = settings.live;
  return {
      textParameter(settings.map_frame, {"map_frame", "", "Frame of the map."}),
      textParameter(settings.robot_frame,
                    {"robot_frame", "", "Whose pose comes with pose_source odometry or pose."}),
      choiceParameter<PoseSource>(
          settings.pose_source,
          {{"tf", PoseSource::kTf},
           {"odometry", PoseSource::kOdometry},
           {"pose", PoseSource::kPose}},
          {"pose_source", "", "Where the robot's pose comes from; the camera's mount is tf's."}),
      textParameter(
          settings.odom,
          {"odom", "", "Topic of the odometry, below the robot's namespace; empty: odom."}),
      textParameter(settings.pose, {"pose", "", "Topic of the poses, likewise; empty: pose."}),
      textParameter(
          settings.depth_image,
          {"depth_image", "",
           "Topic of the depth images, below the robot's namespace; empty: depth/image_rect."}),
      textParameter(
          settings.depth_info,
          {"depth_info", "", "Topic of their camera_info, likewise; empty: depth/camera_info."}),
      textParameter(settings.image_transport,
                    {"image_transport", "", "How images travel: raw, compressedDepth, ..."}),
      numberParameter(
          settings.depth_units_per_m, {1.0, 1e6},
          {"depth_units_per_m", "1/m",
           "Value of one metre in 16-bit depth images: 1000 by REP 118; 4000 for an L515."}),
      countParameter(settings.queue_size, {1, 10000},
                     {"queue_size", "images", "Images that wait at most."}),
      numberParameter(settings.tf_cache_s, {1.0, 3600.0},
                      {"tf_cache_s", "s", "How long transforms are remembered."}),
      choiceParameter<Overload>(settings.overload,
                                {{"skip", Overload::kSkip}, {"queue", Overload::kQueue}},
                                {"overload", "", "What happens to images that come too fast."}),
      choiceParameter<OnTimeJump>(
          settings.on_time_jump, {{"keep", OnTimeJump::kKeep}, {"reset", OnTimeJump::kReset}},
          {"on_time_jump", "", "What becomes of the map when the clock jumps back."}),
      numberParameter(settings.soft_memory_mib, {1.0, 1e6},
                      {"soft_memory_mib", "MiB", "A larger map is warned of."}),
      choiceParameter<bool>(settings.allow_reset, {{"true", true}, {"false", false}},
                            {"allow_reset", "", "Whether the reset service may be used."}),
      choiceParameter<bool>(settings.save_on_exit, {{"true", true}, {"false", false}},
                            {"save_on_exit", "", "Whether the map is saved as 'last' at the end."}),
      numberParameter(
          settings.autosave_period_s, {0.0, 86400.0},
          {"autosave_period_s", "s",
           "The map is saved as 'last' so often while it changes; 0: only at the end."}),
      countParameter(
          settings.save_quota.max_saves, {1, 100'000},
          {"max_saves", "", "Most names under which the service ~save keeps something."}),
      numberParameter(
          settings.save_quota.min_free_disk_mb, {0.0, 1e9},
          {"min_free_disk_mb", "MB", "What the service ~save leaves free on the disk."}),
      textParameter(
          settings.save_folder,
          {"save_folder", "",
           "Where maps are saved; empty: ~/.ros/occusg, and below it the robot's namespace."}),
      textParameter(settings.resume,
                    {"resume", "", "Name of a saved map to go on from; empty: begin anew."}),
      numberParameter(live.tf_timeout_s, {0.0, 60.0},
                      {"tf_timeout_s", "s", "How long an image waits for its transform."}),
      numberParameter(live.voxels_period_s, {0.1, 3600.0},
                      {"voxels_period_s", "s", "Between two clouds of occupied voxels."}),
      numberParameter(live.pose_gate.max_jump_m, {0.01, 1000.0},
                      {"max_pose_jump_m", "m", "A frame that jumps farther is held back."}),
      numberParameter(live.pose_gate.max_jump_rad, {0.01, 3.2},
                      {"max_pose_jump_rad", "rad", "A frame that turns more is held back."}),
      countParameter(live.pose_gate.frames_to_accept, {1, 1000},
                     {"pose_jump_frames", "frames",
                      "So many in a row at the new place are a relocalisation."})};
}

}  // namespace occusg_ros
