// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <message_filters/subscriber.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/synchronizer.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_ros/buffer.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "clock_check.hpp"
#include "node_handles.hpp"
#include "occusg/perception/detection_builder.hpp"
#include "occusg/perception/instance_segmenter.hpp"
#include "occusg/pipeline/config.hpp"
#include "occusg/pipeline/stage_times.hpp"
#include "occusg_ros/callback_times.hpp"
#include "occusg_ros/guarded.hpp"
#include "occusg_ros/input_health.hpp"
#include "occusg_ros/parameters.hpp"
#include "occusg_ros/pending_frames.hpp"
#include "occusg_ros/tf_input.hpp"
#include "occusg_ros/tf_poses.hpp"
#include "occusg_ros/throttle.hpp"
#include "occusg_ros/worker.hpp"

namespace occusg_ros {

/// The parameters of occusg/semantics.
struct SemanticsSettings {
  std::string map_frame = "map";
  std::string depth_image;
  std::string depth_info;
  std::string rgb_image;
  std::string model;
  std::string classes;
  double depth_units_per_m = 1000.0;
  double tf_timeout_s = 0.5;
};

/// The settings by name.
/// @param settings outlives the parameters.
[[nodiscard]] inline std::vector<occusg::Parameter> parametersOf(SemanticsSettings& settings) {
  return {
      textParameter(settings.map_frame, {"map_frame", "", "Frame of the map."}),
      textParameter(settings.depth_image,
                    {"depth_image", "", "As of the mapping node; empty: depth/image_rect."}),
      textParameter(settings.depth_info,
                    {"depth_info", "", "As of the mapping node; empty: depth/camera_info."}),
      textParameter(settings.rgb_image, {"rgb_image", "",
                                         "Topic of the colour images, below the robot's namespace; "
                                         "empty: rgb/image_rect_color."}),
      textParameter(settings.model, {"model", "", "ONNX file of a YOLO segmentation model."}),
      textParameter(settings.classes, {"classes", "", "Names of its classes, one a line."}),
      occusg::numberParameter(settings.depth_units_per_m, {1.0, 1e6},
                              {"depth_units_per_m", "1/m", "As of the mapping node."}),
      occusg::numberParameter(settings.tf_timeout_s, {0.0, 60.0},
                              {"tf_timeout_s", "s", "How long images wait for their transform."})};
}

/// Colour and registered depth images -> detections placed in the map. The newest pair goes next:
/// inference takes longer than images take to come.
class SemanticsNode {
 public:
  /// @throws occusg::Error when a parameter or the model cannot be used.
  explicit SemanticsNode(const NodeHandles& handles);
  SemanticsNode(const SemanticsNode&) = delete;
  SemanticsNode& operator=(const SemanticsNode&) = delete;
  SemanticsNode(SemanticsNode&&) = delete;
  SemanticsNode& operator=(SemanticsNode&&) = delete;
  ~SemanticsNode();

  /// What a callback or a step threw: counted and said.
  void onFailure(const Failure& failure) noexcept;

 private:
  struct Views {
    sensor_msgs::ImageConstPtr color;
    sensor_msgs::ImageConstPtr depth;
    sensor_msgs::CameraInfoConstPtr info;
    double arrived_s = 0.0;  ///< Steady clock [s].
  };
  using Policy =
      message_filters::sync_policies::ApproximateTime<sensor_msgs::Image, sensor_msgs::Image,
                                                      sensor_msgs::CameraInfo>;

  void onViews(const sensor_msgs::ImageConstPtr& color, const sensor_msgs::ImageConstPtr& depth,
               const sensor_msgs::CameraInfoConstPtr& info);
  void take(const Views& views);
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status);
  void checkHealth();

  // On the worker's thread.
  Worker::Progress step();
  void process(const Views& views, const occusg::Pose& T_map_camera);
  [[nodiscard]] PoseAnswer poseOf(const Views& views) const;
  void dropLateViews();
  void drop(Drop reason, const std::string& sentence, std::size_t count = 1);

  NodeHandles handles_;
  occusg::PipelineConfig config_;  // before the settings: reading them fills it
  SemanticsSettings settings_;
  InputHealth health_;
  double started_s_;
  MissingInputReport missing_input_;
  Throttle warnings_{kWarningPeriod_s};
  ClockCheck clock_;
  CallbackTimes callbacks_;

  std::mutex mutex_;  ///< Of the members up to `detections_`.
  PendingFrames<Views> waiting_;
  occusg::StageTimes times_;
  std::size_t detections_ = 0;

  std::unique_ptr<occusg::InstanceSegmenter> segmenter_;
  occusg::DetectionBuilder builder_;
  tf2_ros::Buffer tf_;
  TfInput tf_input_;
  ros::Publisher publisher_;
  std::unique_ptr<Worker> worker_;
  diagnostic_updater::Updater diagnostics_;
  message_filters::Subscriber<sensor_msgs::Image> color_subscriber_;
  message_filters::Subscriber<sensor_msgs::Image> depth_subscriber_;
  message_filters::Subscriber<sensor_msgs::CameraInfo> info_subscriber_;
  std::unique_ptr<message_filters::Synchronizer<Policy>> synchronizer_;
  ros::WallTimer health_timer_;
};

}  // namespace occusg_ros
