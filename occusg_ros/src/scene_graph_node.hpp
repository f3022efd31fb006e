// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <occusg/DetectionArray.h>
#include <occusg/GetPath.h>
#include <occusg/GetRoomAt.h>
#include <occusg/GetSceneGraph.h>
#include <occusg/ListRooms.h>
#include <occusg/LoadMap.h>
#include <occusg/OverheadGaps.h>
#include <occusg/SaveMap.h>
#include <occusg/SceneGraphLiveConfig.h>
#include <occusg/SceneGraphStamped.h>
#include <occusg/SegmentMap.h>
#include <occusg/SetRoomLabel.h>
#include <occusg/SetStorey.h>
#include <occusg/StoreyArray.h>
#include <occusg/StoreyFreeSpace.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "clock_check.hpp"
#include "node_handles.hpp"
#include "occusg/pipeline/building_pipeline.hpp"
#include "occusg_ros/callback_times.hpp"
#include "occusg_ros/given_storeys.hpp"
#include "occusg_ros/graph_conversions.hpp"
#include "occusg_ros/guarded.hpp"
#include "occusg_ros/input_health.hpp"
#include "occusg_ros/markers.hpp"
#include "occusg_ros/pose_input.hpp"
#include "occusg_ros/ros_timeline.hpp"
#include "occusg_ros/save_status.hpp"
#include "occusg_ros/saved_generations.hpp"
#include "occusg_ros/saver.hpp"
#include "occusg_ros/tf_input.hpp"
#include "occusg_ros/tf_poses.hpp"
#include "occusg_ros/throttle.hpp"
#include "occusg_ros/waiting_map.hpp"
#include "occusg_ros/worker.hpp"
#include "scene_graph_settings.hpp"

namespace occusg_ros {

/// Free space and the robot's pose -> regions, rooms, scene graph. Callbacks only put things down;
/// the graph belongs to the worker's thread. Services that only read use the last published
/// message.
class SceneGraphNode {
 public:
  /// @throws occusg::Error when a parameter cannot be used.
  explicit SceneGraphNode(const NodeHandles& handles);
  SceneGraphNode(const SceneGraphNode&) = delete;
  SceneGraphNode& operator=(const SceneGraphNode&) = delete;
  SceneGraphNode(SceneGraphNode&&) = delete;
  SceneGraphNode& operator=(SceneGraphNode&&) = delete;
  /// Within a second or so; what was found is saved.
  ~SceneGraphNode();

  /// What a callback or a step threw: counted and said; without memory the node saves what it knows
  /// and takes no more.
  void onFailure(const Failure& failure) noexcept;

 private:
  /// What the diagnostics show; a copy, so that they wait for no update.
  struct Status {
    occusg::RoomCounts counts;
    std::vector<std::pair<std::string, occusg::StageSummary>> times;
    std::size_t maps_without_gaps = 0;  ///< Used so, though somebody publishes gaps.
    std::size_t rooms = 0;
    std::string why_no_rooms;  ///< Empty while there are rooms.
    std::size_t nodes = 0;
    std::size_t edges = 0;
    SaveStatus saves{steadySeconds()};
    std::string assumption;  ///< Under which the map is read; empty: none.
  };
  /// The free space of a storey that waits for its turn.
  struct StoreyLayerWaiting {
    occusg::StoreyFreeSpaceConstPtr layer;  ///< Null: none.
    double arrived_s = 0.0;                 ///< Steady clock [s].

    [[nodiscard]] WaitingMap::Map map() const;
  };
  using GraphPtr = boost::shared_ptr<const occusg::SceneGraphStamped>;

  void advertiseTopics();
  void advertiseServices();
  void subscribe();

  void onGrid(const nav_msgs::OccupancyGridConstPtr& grid);
  /// Whether a message is refused for its stamp, which is then counted and said.
  [[nodiscard]] bool refusesStamp(const ros::Time& stamp, const std::string& topic);
  [[nodiscard]] bool refusesFrame(const std::string& frame, const std::string& topic);
  /// Counts a map that arrived; whether it is used, unless it is refused later.
  [[nodiscard]] bool takesMap(const std_msgs::Header& header, const std::string& topic);
  void onGridUpdate(const map_msgs::OccupancyGridUpdateConstPtr& update);
  void onGaps(const occusg::OverheadGapsConstPtr& gaps);
  void onStoreyLayer(const occusg::StoreyFreeSpaceConstPtr& layer);
  void onOdometry(const nav_msgs::OdometryConstPtr& odometry);
  void onDetections(const occusg::DetectionArrayConstPtr& detections);
  void onReconfigure(occusg::SceneGraphLiveConfig& live, std::uint32_t level);
  void onMarkerSubscriber(const ros::SingleSubscriberPublisher& subscriber);
  void tick();
  void checkHealth();
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status);

  // On the worker's thread.
  Worker::Progress step();
  [[nodiscard]] std::optional<WaitingMap::Map> nextMap() const;
  [[nodiscard]] PoseAnswer robotPose(const ros::Time& stamp) const;
  [[nodiscard]] std::optional<occusg::Pose> poseFor(const WaitingMap::Map& waiting);
  /// Whether there was one.
  bool takeStoreyLayer();
  void useMap(const std::function<void()>& use);
  void update(const WaitingMap::Map& map, const occusg::Pose& pose, std::size_t storey);
  void enterStorey(int floor_id, double floor_z_m);
  [[nodiscard]] occusg::Pose onItsStorey(const occusg::Pose& pose) const;
  [[nodiscard]] std::vector<occusg::Detection> onTheirStorey(
      std::vector<occusg::Detection> detections) const;
  [[nodiscard]] occusg::FreeSpace emptyLayer() const;
  [[nodiscard]] static occusg::MapView viewOf(const occusg::FreeSpace& layer);
  void tellAssumption(const std::string& assumption);
  void followRobot();
  void publish(const std_msgs::Header& header);
  void publishMarkers(const std_msgs::Header& header);
  void noteStatus();
  void resetGraph();
  [[nodiscard]] Saver::Writing writingTo(const std::string& name, Saver::When when) const;
  [[nodiscard]] std::string save(const std::string& name);
  void saveFromTimeToTime();
  void saveAtEnd();
  void noteSave(const std::string& folder, const std::string& problem);
  void load(const std::string& name);
  void resume();
  [[nodiscard]] std::string folderOf(const std::string& name) const;

  bool onGetSceneGraph(occusg::GetSceneGraph::Request& request,
                       occusg::GetSceneGraph::Response& response);
  bool onListRooms(occusg::ListRooms::Request& request, occusg::ListRooms::Response& response);
  bool onGetRoomAt(occusg::GetRoomAt::Request& request, occusg::GetRoomAt::Response& response);
  bool onGetPath(occusg::GetPath::Request& request, occusg::GetPath::Response& response);
  bool onSetRoomLabel(occusg::SetRoomLabel::Request& request,
                      occusg::SetRoomLabel::Response& response);
  bool onSetStorey(occusg::SetStorey::Request& request, occusg::SetStorey::Response& response);
  bool onSegmentMap(occusg::SegmentMap::Request& request, occusg::SegmentMap::Response& response);
  bool onSave(occusg::SaveMap::Request& request, occusg::SaveMap::Response& response);
  bool onLoad(occusg::LoadMap::Request& request, occusg::LoadMap::Response& response);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onPause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);

  /// Runs `work` on the worker's thread; the sentence of what went wrong, empty when nothing did.
  [[nodiscard]] std::vector<StoreyRegions> storeyRegions() const;
  void publishStoreys(const std_msgs::Header& header);
  void forgetLayers();
  [[nodiscard]] std::string onWorker(const std::function<void()>& work);
  [[nodiscard]] GraphPtr lastGraph() const;
  /// Asks the same of the node that maps; the sentence of what went wrong, empty when nothing did
  /// or there is no such node.
  template <typename Service>
  [[nodiscard]] std::string askMapping(const std::string& service,
                                       const typename Service::Request& request) const;

  NodeHandles handles_;
  occusg::PipelineConfig config_;  // before the settings: reading them fills it
  SceneGraphSettings settings_;
  InputHealth health_;
  CallbackTimes callbacks_;
  std::atomic<bool> paused_{false};
  std::atomic<bool> tick_is_posted_{false};
  double started_s_;
  MissingInputReport missing_input_;
  Throttle map_warnings_{kWarningPeriod_s};
  ClockCheck clock_;
  Throttle detection_warnings_{kWarningPeriod_s};

  /// The node that maps tells the storeys of the building, and there are several.
  std::atomic<bool> has_mapped_storeys_{false};

  mutable std::mutex mutex_;  ///< Of the members up to `status_`.
  WaitingMap waiting_;
  std::map<int, StoreyLayerWaiting> waiting_storeys_;  ///< The newest layer of each, by floor_id.
  nav_msgs::OccupancyGridConstPtr whole_grid_;         ///< With all parts that came since.
  nav_msgs::OdometryConstPtr odometry_;
  std::string pose_problem_;
  GraphPtr last_graph_;
  MarkerLayout layout_;
  std::size_t detections_received_ = 0;
  std::size_t detections_refused_ = 0;
  Status status_;

  std::mutex markers_mutex_;  ///< Of `shown_` and of what is sent of it.
  MarkerSet shown_;

  // The worker's own.
  std::unique_ptr<occusg::BuildingPipeline> rooms_;
  std::vector<occusg::FreeSpace> layers_;  ///< By storey.
  GivenStoreys given_storeys_;
  occusg::StoreyArray last_storeys_;
  bool awaits_map_ = false;  ///< That of the storey the robot has entered.
  RosTimeline timeline_;
  std::uint64_t sequence_ = 0;
  std::optional<double> last_maintenance_s_;
  occusg::Pose last_pose_ = occusg::Pose::Identity();
  double last_status_s_ = 0.0;  ///< Steady clock [s].
  bool has_doubted_size_ = false;
  std::uint64_t sequence_saved_ = 0;
  SavedGenerations generations_;
  Saver saver_;

  tf2_ros::Buffer tf_;
  TfInput tf_input_;
  std::unique_ptr<PoseInput> pose_input_;
  ros::Publisher regions_publisher_;
  ros::Publisher storeys_publisher_;
  ros::Publisher rooms_publisher_;
  ros::Publisher graph_publisher_;
  ros::Publisher update_publisher_;
  ros::Publisher current_room_publisher_;
  ros::Publisher marker_publisher_;
  ros::Publisher config_publisher_;
  std::unique_ptr<Worker> worker_;
  diagnostic_updater::Updater diagnostics_;
  std::unique_ptr<dynamic_reconfigure::Server<occusg::SceneGraphLiveConfig>> reconfigure_;
  std::vector<ros::ServiceServer> services_;
  ros::Subscriber grid_subscriber_;
  ros::Subscriber grid_update_subscriber_;
  ros::Subscriber gaps_subscriber_;
  ros::Subscriber storey_subscriber_;
  ros::Subscriber odometry_subscriber_;
  ros::Subscriber detections_subscriber_;
  ros::WallTimer tick_timer_;
  ros::WallTimer health_timer_;
};

}  // namespace occusg_ros
