// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <image_transport/image_transport.h>
#include <occusg/LoadMap.h>
#include <occusg/MappingLiveConfig.h>
#include <occusg/SaveMap.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "clock_check.hpp"
#include "mapping_settings.hpp"
#include "node_handles.hpp"
#include "occusg/pipeline/map_pipeline.hpp"
#include "occusg_ros/callback_times.hpp"
#include "occusg_ros/guarded.hpp"
#include "occusg_ros/input_health.hpp"
#include "occusg_ros/orientation_check.hpp"
#include "occusg_ros/pending_frames.hpp"
#include "occusg_ros/pose_gate.hpp"
#include "occusg_ros/save_status.hpp"
#include "occusg_ros/saved_generations.hpp"
#include "occusg_ros/saver.hpp"
#include "occusg_ros/stamp_gate.hpp"
#include "occusg_ros/storey_publisher.hpp"
#include "occusg_ros/tf_input.hpp"
#include "occusg_ros/tf_poses.hpp"
#include "occusg_ros/throttle.hpp"
#include "occusg_ros/worker.hpp"

namespace occusg_ros {

/// Whether the settings let a building have several storeys.
[[nodiscard]] occusg::Storeys storeysIn(const MappingSettings& settings);

/// Depth images, camera information and tf -> occupancy map and free space. Callbacks only put
/// things down; the map belongs to the worker's thread.
class MappingNode {
 public:
  /// @throws occusg::Error when a parameter cannot be used.
  explicit MappingNode(const NodeHandles& handles);
  MappingNode(const MappingNode&) = delete;
  MappingNode& operator=(const MappingNode&) = delete;
  MappingNode(MappingNode&&) = delete;
  MappingNode& operator=(MappingNode&&) = delete;
  /// Within a second or so; what was mapped is saved.
  ~MappingNode();

  /// What a callback or a step threw: counted and said; without memory the node saves what it knows
  /// and takes no more.
  void onFailure(const Failure& failure) noexcept;

 private:
  struct WaitingImage {
    sensor_msgs::ImageConstPtr image;
    double logical_s = 0.0;
    double arrived_s = 0.0;  ///< Steady clock [s].
  };
  /// What the diagnostics show of the map; a copy, so that they wait for no frame.
  struct Status {
    occusg::MapCounts counts;
    occusg::StageSummary frame_times;
    std::size_t cut_islands = 0;  ///< Of the map that was loaded.
    std::string doubt;            ///< About how the map lies; empty: none.
    std::size_t map_nodes = 0;
    std::size_t map_bytes = 0;
    double last_lag_s = 0.0;  ///< From a frame's arrival to its layer.
    SaveStatus saves{steadySeconds()};
  };

  void advertise();
  void subscribe();
  void subscribeToImages(const std::string& topic);

  void onInfo(const sensor_msgs::CameraInfoConstPtr& info);
  void onImage(const sensor_msgs::ImageConstPtr& image);
  void onClockJump();
  void dropPushedOut(const std_msgs::Header& header);
  void onReconfigure(occusg::MappingLiveConfig& live, std::uint32_t level);
  void checkHealth();
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status);

  // On the worker's thread.
  Worker::Progress step();
  [[nodiscard]] PendingFrames<WaitingImage>::Taken nextImage();
  void dropLateImages();
  void process(const WaitingImage& waiting);
  /// Whether the frame just processed changed the map; says why when it did not.
  void checkOrientation(const WaitingImage& waiting, const occusg::CameraModel& camera,
                        const occusg::Pose& T_map_camera);
  void warnOfFewPixels(const occusg::FrameReport& report);
  void publishLayer(const std_msgs::Header& header, double logical_s);
  void sendLayer(const std_msgs::Header& header);
  void publishVoxels(const std_msgs::Header& header);
  void publishLastLayer();
  void noteStatus(double lag_s);
  void resetMap();
  void showNewMap();
  [[nodiscard]] Saver::Writing writingTo(const std::string& name, Saver::When when) const;
  [[nodiscard]] std::string save(const std::string& name);
  void saveFromTimeToTime();
  void saveAtEnd();
  void noteSave(const std::string& folder, const std::string& problem);
  void load(const std::string& name);
  [[nodiscard]] std::unique_ptr<occusg::MapPipeline> emptyMap() const;
  void resume();
  [[nodiscard]] std::string folderOf(const std::string& name) const;

  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onPause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool onSave(occusg::SaveMap::Request& request, occusg::SaveMap::Response& response);
  bool onLoad(occusg::LoadMap::Request& request, occusg::LoadMap::Response& response);

  [[nodiscard]] MappingLive live() const;
  [[nodiscard]] std::optional<occusg::CameraModel> camera() const;
  [[nodiscard]] std::string tfProblem() const;
  void drop(Drop reason, const std::string& sentence, std::size_t count = 1);

  NodeHandles handles_;
  occusg::PipelineConfig config_;  // before the settings: reading them fills it
  MappingSettings settings_;
  InputHealth health_;
  CallbackTimes callbacks_;
  std::atomic<std::size_t> infos_received_{0};
  std::atomic<bool> paused_{false};
  double started_s_;
  MissingInputReport missing_input_;
  Throttle drop_warnings_{kWarningPeriod_s};
  ClockCheck clock_;
  Throttle pixel_warnings_{kWarningPeriod_s};

  mutable std::mutex mutex_;  ///< Of the members up to `status_`.
  PendingFrames<WaitingImage> waiting_;
  StampGate stamps_;
  std::optional<occusg::CameraModel> camera_;
  std::string camera_problem_;
  std::string camera_frame_;  ///< Of the newest image.
  std::string tf_problem_;
  MappingLive live_;
  Status status_;

  // The worker's own.
  std::unique_ptr<occusg::MapPipeline> map_;
  PoseGate pose_gate_;
  occusg::StageTimes frame_times_;
  std::optional<double> last_layer_s_;  ///< Logical time of the last published layer.
  std::optional<std_msgs::Header> unpublished_;
  double last_frame_s_ = 0.0;   ///< Steady clock [s].
  double last_voxels_s_ = 0.0;  ///< Steady clock [s].
  double last_status_s_ = 0.0;  ///< Steady clock [s].
  std::size_t frames_saved_ = 0;
  SavedGenerations generations_;
  Saver saver_;

  tf2_ros::Buffer tf_;
  TfInput tf_input_;
  std::unique_ptr<PoseInput> pose_input_;
  OrientationCheck orientation_;
  ros::Publisher layer_publisher_;
  ros::Publisher fill_publisher_;
  ros::Publisher gaps_publisher_;
  StoreyPublisher storeys_;
  ros::Publisher voxel_publisher_;
  ros::Publisher octomap_publisher_;
  ros::Publisher config_publisher_;
  std::unique_ptr<Worker> worker_;
  diagnostic_updater::Updater diagnostics_;
  std::unique_ptr<dynamic_reconfigure::Server<occusg::MappingLiveConfig>> reconfigure_;
  std::vector<ros::ServiceServer> services_;
  std::unique_ptr<image_transport::ImageTransport> transport_;
  image_transport::Subscriber image_subscriber_;
  ros::Subscriber info_subscriber_;
  ros::WallTimer health_timer_;
};

}  // namespace occusg_ros
