// SPDX-License-Identifier: BSD-3-Clause
#include "scene_graph_node.hpp"

#include <std_msgs/String.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg/pipeline/config_file.hpp"
#include "occusg/regions/no_rooms.hpp"
#include "occusg_ros/graph_conversions.hpp"
#include "occusg_ros/live_values.hpp"
#include "occusg_ros/pose_conversions.hpp"
#include "occusg_ros/saved_folder.hpp"
#include "occusg_ros/shown_text.hpp"
#include "occusg_ros/stamp_gate.hpp"
#include "occusg_ros/storey_conversions.hpp"
#include "occusg_ros/topic_names.hpp"

namespace occusg_ros {
namespace {

constexpr std::uint32_t kUpdateQueue = 100;
constexpr double kTick_s = 0.1;

}  // namespace

SceneGraphNode::SceneGraphNode(const NodeHandles& handles)
    : handles_(handles),
      settings_(readSettings<SceneGraphSettings>(handles.parameters, config_)),
      started_s_(steadySeconds()),
      last_graph_(boost::make_shared<occusg::SceneGraphStamped>()),
      layout_(settings_.layout),
      rooms_(std::make_unique<occusg::BuildingPipeline>(config_)),
      given_storeys_(config_.graph.rooms.floor_z_m),
      generations_(expandedFolder(settings_.saving.save_folder, handles.inputs.getNamespace()),
                   runId(), handles.name),
      saver_(settings_.saving.autosave_period_s, started_s_,
             [this](const std::string& problem) { noteSave(kDefaultSaveName, problem); }),
      tf_(ros::Duration(settings_.tf_cache_s)),
      tf_input_(tf_),
      diagnostics_(handles.inputs, handles.parameters, handles.name) {
  forgetLayers();
  advertiseTopics();
  resume();
  worker_ = std::make_unique<Worker>(
      kWorkerPoll, [this] { return step(); },
      [this](const Failure& failure) { onFailure(failure); });
  advertiseServices();
  subscribe();
}

SceneGraphNode::~SceneGraphNode() {
  if (settings_.saving.save_on_exit) saver_.hurry();
  health_timer_.stop();
  tick_timer_.stop();
  grid_subscriber_.shutdown();
  grid_update_subscriber_.shutdown();
  gaps_subscriber_.shutdown();
  storey_subscriber_.shutdown();
  odometry_subscriber_.shutdown();
  detections_subscriber_.shutdown();
  for (ros::ServiceServer& service : services_) service.shutdown();
  reconfigure_.reset();
  worker_.reset();
  marker_publisher_.shutdown();
  saveAtEnd();
}

void SceneGraphNode::advertiseTopics() {
  ros::NodeHandle& nh = handles_.inputs;
  regions_publisher_ = nh.advertise<occusg::RegionArray>("regions", 1, true);
  rooms_publisher_ = nh.advertise<occusg::RoomArray>("rooms", 1, true);
  storeys_publisher_ = nh.advertise<occusg::StoreyArray>("storeys", 1, true);
  graph_publisher_ = nh.advertise<occusg::SceneGraphStamped>("scene_graph", 1, true);
  update_publisher_ = nh.advertise<occusg::SceneGraphUpdate>("scene_graph_updates", kUpdateQueue);
  current_room_publisher_ = nh.advertise<occusg::CurrentRoom>("current_room", 1, true);
  marker_publisher_ = nh.advertise<visualization_msgs::MarkerArray>(
      "markers", kUpdateQueue,
      [this](const ros::SingleSubscriberPublisher& subscriber) { onMarkerSubscriber(subscriber); });
  config_publisher_ = handles_.parameters.advertise<std_msgs::String>("config", 1, true);
  std_msgs::String config;
  config.data = occusg::toYaml(config_, occusg::ConfigComments::kNone);
  config_publisher_.publish(config);

  reconfigure_ = std::make_unique<dynamic_reconfigure::Server<occusg::SceneGraphLiveConfig>>(
      handles_.parameters);
  reconfigure_->setCallback([this](occusg::SceneGraphLiveConfig& live, std::uint32_t level) {
    onReconfigure(live, level);
  });
  diagnostics_.setHardwareID("none");
  diagnostics_.add("scene graph", this, &SceneGraphNode::describe);
}

void SceneGraphNode::subscribe() {
  ros::NodeHandle& nh = handles_.inputs;
  const std::string& place = nh.getNamespace();
  gaps_subscriber_ = nh.subscribe<occusg::OverheadGaps>(
      "overhead_gaps", kInputQueue,
      guardedCallback(this, &SceneGraphNode::onGaps, "overhead gaps"));
  storey_subscriber_ = nh.subscribe<occusg::StoreyFreeSpace>(
      "storey_layers", kUpdateQueue,
      guardedCallback(this, &SceneGraphNode::onStoreyLayer, "the free space of a storey"));
  grid_subscriber_ = nh.subscribe<nav_msgs::OccupancyGrid>(
      inputTopic(place, settings_.map, "free_space"), kInputQueue,
      guardedCallback(this, &SceneGraphNode::onGrid, "a map"));
  // What changes a map that is published whole once: costmap_2d, move_base, explore_lite. Below the
  // topic's name after remapping, where those publish it.
  grid_update_subscriber_ = nh.subscribe<map_msgs::OccupancyGridUpdate>(
      grid_subscriber_.getTopic() + "_updates", kUpdateQueue,
      guardedCallback(this, &SceneGraphNode::onGridUpdate, "a part of the map"));
  detections_subscriber_ = nh.subscribe<occusg::DetectionArray>(
      "detections", kInputQueue,
      guardedCallback(this, &SceneGraphNode::onDetections, "detections"));
  if (settings_.pose_source == PoseSource::kOdometry) {
    odometry_subscriber_ = nh.subscribe<nav_msgs::Odometry>(
        inputTopic(place, settings_.odom, "odom"), kInputQueue,
        guardedCallback(this, &SceneGraphNode::onOdometry, "odometry"));
  }
  if (settings_.pose_source == PoseSource::kPose) {
    pose_input_ = std::make_unique<PoseInput>(
        nh,
        PoseInputConfig{PoseSource::kPose, inputTopic(place, settings_.pose, "pose"),
                        settings_.map_frame, settings_.robot_frame},
        tf_);
  }
  // Timers of the wall clock that look at the clock of ROS: it may jump back, which would stop a
  // timer of its own for as long as it jumped.
  tick_timer_ = nh.createWallTimer(ros::WallDuration(kTick_s),
                                   [this](const ros::WallTimerEvent&) { tick(); });
  health_timer_ = nh.createWallTimer(ros::WallDuration(1.0),
                                     [this](const ros::WallTimerEvent&) { checkHealth(); });
}

void SceneGraphNode::onFailure(const Failure& failure) noexcept {
  try {
    health_.noteDropped(Drop::kMap, failure.problem);
    if (!failure.is_out_of_memory) {
      if (map_warnings_.allows())
        ROS_WARN_STREAM(handles_.name << ": not used: " << failure.problem);
      return;
    }
    if (paused_.exchange(true)) return;
    ROS_ERROR_STREAM(handles_.name << ": " << failure.problem
                                   << "; the graph is paused and saved as '" << kDefaultSaveName
                                   << "'");
    worker_->post([this] { (void)save(kDefaultSaveName); });
  } catch (...) {
    // Without memory there may be no sentence either.
    health_.noteDropped(Drop::kMap, "");
  }
}

bool SceneGraphNode::refusesStamp(const ros::Time& stamp, const std::string& topic) {
  if (!isFromTheFuture(stamp.toSec(), ros::Time::now().toSec())) return false;
  const std::string problem = topic + ": its stamp is in the future; are the clocks synchronised?";
  health_.noteDropped(Drop::kStamp, problem);
  if (map_warnings_.allows()) ROS_WARN_STREAM(handles_.name << ": not used: " << problem);
  return true;
}

void SceneGraphNode::onOdometry(const nav_msgs::OdometryConstPtr& odometry) {
  const CallbackTimes::Timing timing(callbacks_, "odometry");
  if (refusesStamp(odometry->header.stamp, odometry_subscriber_.getTopic())) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  odometry_ = odometry;
}

void SceneGraphNode::onDetections(const occusg::DetectionArrayConstPtr& detections) {
  const CallbackTimes::Timing timing(callbacks_, "detections");
  if (refusesStamp(detections->header.stamp, detections_subscriber_.getTopic())) {
    const std::lock_guard<std::mutex> lock(mutex_);
    detections_received_ += detections->detections.size();
    detections_refused_ += detections->detections.size();
    return;
  }
  ReceivedDetections received = toDetections(*detections);
  const std::string& frame = detections->header.frame_id;
  if (frameName(frame) != frameName(settings_.map_frame)) {
    received = {
        {},
        detections->detections.size(),
        "their frame is '" + shownName(frame) + "'; ~map_frame is '" + settings_.map_frame + "'"};
  }
  if (received.refused > 0 && detection_warnings_.allows()) {
    ROS_WARN_STREAM(handles_.name << ": " << received.refused
                                  << " detections refused: " << shownText(received.first_refusal));
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    detections_received_ += detections->detections.size();
    detections_refused_ += received.refused;
  }
  if (paused_ || received.detections.empty()) return;
  worker_->post(
      [this, found = std::move(received.detections), stamp_s = detections->header.stamp.toSec()] {
        try {
          rooms_->observeObjects(onTheirStorey(found), timeline_.at(stamp_s));
        } catch (const std::exception& error) {
          if (detection_warnings_.allows())
            ROS_WARN_STREAM(handles_.name << ": detections not used: " << error.what());
        }
      });
}

void SceneGraphNode::onReconfigure(occusg::SceneGraphLiveConfig& live, std::uint32_t /*level*/) {
  const CallbackTimes::Timing timing(callbacks_, "reconfigure");
  MarkerLayout in_use;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    in_use = layout_;
  }
  LiveValues values;
  MarkerLayout layout;
  layout.room_height_m = values.finite("room_height_m", live.room_height_m, in_use.room_height_m);
  layout.object_height_m =
      values.finite("object_height_m", live.object_height_m, in_use.object_height_m);
  layout.navigation_height_m =
      values.finite("navigation_height_m", live.navigation_height_m, in_use.navigation_height_m);
  layout.room_opacity = values.finite("room_opacity", live.room_opacity, in_use.room_opacity);
  layout.show_regions = live.show_regions;
  layout.show_containment = live.show_containment;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    layout_ = layout;
  }
  if (!values.refused().empty()) {
    ROS_WARN_STREAM(handles_.name << ": not a finite number, and not used: " << values.refused());
  }
  // The first call comes before there is a worker.
  if (worker_) worker_->post([this] { publishMarkers(lastGraph()->header); });
}

void SceneGraphNode::onMarkerSubscriber(const ros::SingleSubscriberPublisher& subscriber) {
  const CallbackTimes::Timing timing(callbacks_, "new subscriber");
  // Under the lock, so that no change overtakes the whole.
  const std::lock_guard<std::mutex> lock(markers_mutex_);
  if (!shown_.empty()) subscriber.publish(allMarkers(shown_));
}

void SceneGraphNode::tick() {
  const CallbackTimes::Timing timing(callbacks_, "tick");
  if (paused_ || tick_is_posted_.exchange(true)) return;
  worker_->post([this] {
    tick_is_posted_ = false;
    followRobot();
  });
}

Worker::Progress SceneGraphNode::step() {
  if (ros::isShuttingDown()) {
    saveAtEnd();
    return Worker::Progress::kIdle;
  }
  saveFromTimeToTime();
  if (takeStoreyLayer()) return Worker::Progress::kWorked;
  const std::optional<WaitingMap::Map> waiting = nextMap();
  if (!waiting) return Worker::Progress::kIdle;
  const std::optional<occusg::Pose> pose = poseFor(*waiting);
  if (!pose) return Worker::Progress::kIdle;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.noteUsed(*waiting);
    if (!waiting->gaps && gaps_subscriber_.getNumPublishers() > 0) ++status_.maps_without_gaps;
  }
  useMap([&] {
    given_storeys_.observe(*pose);
    rooms_->follow(given_storeys_.building());
    awaits_map_ = false;
    update(*waiting, onItsStorey(*pose), rooms_->building().current);
  });
  return Worker::Progress::kWorked;
}

PoseAnswer SceneGraphNode::robotPose(const ros::Time& stamp) const {
  if (settings_.pose_source != PoseSource::kOdometry)
    return poseAt(tf_, settings_.map_frame, settings_.robot_frame, stamp);
  nav_msgs::OdometryConstPtr odometry;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    odometry = odometry_;
  }
  PoseAnswer answer;
  if (!odometry) {
    answer.problem = "no odometry on " + odometry_subscriber_.getTopic();
    return answer;
  }
  try {
    const occusg::Pose T_odom_robot = toPose(odometry->pose.pose, odometry_subscriber_.getTopic());
    if (frameName(odometry->header.frame_id) != frameName(settings_.map_frame)) {
      answer = poseAt(tf_, settings_.map_frame, odometry->header.frame_id, ros::Time());
      if (answer.kind != PoseAnswer::Kind::kFound) return answer;
    }
    answer.kind = PoseAnswer::Kind::kFound;
    answer.T_target_source = answer.T_target_source * T_odom_robot;
  } catch (const occusg::Error& error) {
    answer.kind = PoseAnswer::Kind::kUnusable;
    answer.problem = error.what();
  }
  return answer;
}

void SceneGraphNode::followRobot() {
  const ros::Time now = ros::Time::now();
  if (now.isZero()) return;
  const double logical_s = timeline_.now(now.toSec());
  const PoseAnswer pose = robotPose(ros::Time());
  if (pose.kind != PoseAnswer::Kind::kFound || !rooms_->lastUpdate() || awaits_map_) return;
  const occusg::Pose T_map_robot = onItsStorey(pose.T_target_source);
  if (!has_mapped_storeys_) given_storeys_.observe(pose.T_target_source);
  const bool is_due = !last_maintenance_s_ ||
                      logical_s - *last_maintenance_s_ >= config_.graph.maintenance_period_s;
  if (!is_due) {
    rooms_->observePose(T_map_robot, logical_s);
    return;
  }
  last_maintenance_s_ = logical_s;
  rooms_->maintain(T_map_robot, logical_s, layers_);
  std_msgs::Header header;
  header.stamp = now;
  header.frame_id = settings_.map_frame;
  publish(header);
  noteStatus();
}

void SceneGraphNode::publish(const std_msgs::Header& header) {
  const GraphPtr before = lastGraph();
  const occusg::Building& building = rooms_->building();
  GraphView view{rooms_->graph(), rooms_->currentRoom(),
                 settings_.scene, sequence_ + 1,
                 header,          static_cast<int>(building.current)};
  const auto after = boost::make_shared<occusg::SceneGraphStamped>(toGraphMsg(view));
  const auto change = boost::make_shared<occusg::SceneGraphUpdate>(difference(*before, *after));
  regions_publisher_.publish(boost::make_shared<occusg::RegionArray>(
      toRegionArray(storeyRegions(), rooms_->counts().region_updates, header)));
  publishStoreys(header);
  if (sequence_ > 0 && isEmpty(*change)) return;
  ++sequence_;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_graph_ = after;
  }
  graph_publisher_.publish(after);
  update_publisher_.publish(change);
  rooms_publisher_.publish(boost::make_shared<occusg::RoomArray>(toRoomArray(view)));
  if (before->current_room != after->current_room || sequence_ == 1)
    current_room_publisher_.publish(boost::make_shared<occusg::CurrentRoom>(toCurrentRoom(view)));
  publishMarkers(header);
}

std::vector<StoreyRegions> SceneGraphNode::storeyRegions() const {
  const std::vector<occusg::Storey>& storeys = rooms_->building().storeys;
  // With one storey, rooms lie at the configured height, wherever the floor was seen.
  const bool has_one = storeys.size() == 1;
  std::vector<StoreyRegions> regions;
  for (std::size_t storey = 0; storey < storeys.size(); ++storey) {
    regions.push_back({rooms_->regions(storey), storeys[storey].id,
                       has_one ? config_.graph.rooms.floor_z_m : storeys[storey].floor_z_m});
  }
  return regions;
}

void SceneGraphNode::publishStoreys(const std_msgs::Header& header) {
  occusg::StoreyArray storeys = toStoreyArray(rooms_->building(), header);
  const std::vector<occusg::StairsInfo> stairs = toStairsMsgs(rooms_->graph());
  if (!stairs.empty()) storeys.stairs = stairs;
  occusg::StoreyArray same_time = last_storeys_;
  same_time.header = header;
  same_time.sensor_height = storeys.sensor_height;
  if (same_time == storeys) return;
  last_storeys_ = storeys;
  storeys_publisher_.publish(storeys);
}

void SceneGraphNode::publishMarkers(const std_msgs::Header& header) {
  MarkerLayout layout;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    layout = layout_;
  }
  std_msgs::Header in_map = header;
  in_map.frame_id = settings_.map_frame;
  MarkerSet wanted = drawGraph(rooms_->graph(), storeyRegions(), layout, in_map);
  // This thread alone changes `shown_`; a new subscriber waits for the sending at most.
  const visualization_msgs::MarkerArray changes = markerChanges(shown_, wanted);
  const std::lock_guard<std::mutex> lock(markers_mutex_);
  shown_ = std::move(wanted);
  if (!changes.markers.empty()) marker_publisher_.publish(changes);
}

void SceneGraphNode::noteStatus() {
  using occusg::NodeType;
  std::vector<std::pair<std::string, occusg::StageSummary>> times;
  const double now_s = steadySeconds();
  if (now_s - last_status_s_ > 1.0) {
    for (const occusg::Stage stage :
         {occusg::Stage::kDecomposition, occusg::Stage::kTracking, occusg::Stage::kGraph})
      times.emplace_back(nameOf(stage), rooms_->durations().summary(stage));
    last_status_s_ = now_s;
  }
  const std::size_t rooms = rooms_->graph().nodes(NodeType::kRoom).size();
  const std::string why_none = rooms == 0 ? occusg::whyNoRooms(layers_[rooms_->building().current],
                                                               occusg::smallestRegion_m2(config_))
                                          : "";
  if (!has_doubted_size_) {
    const std::string doubt = doubtOnLargestRoom(rooms_->graph());
    has_doubted_size_ = !doubt.empty();
    if (has_doubted_size_) ROS_WARN_STREAM(handles_.name << ": " << doubt);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.counts = rooms_->counts();
  status_.rooms = rooms;
  status_.why_no_rooms = why_none;
  status_.nodes = rooms_->graph().nodeCount();
  status_.edges = rooms_->graph().edgeCount();
  if (!times.empty()) status_.times = std::move(times);
}

SceneGraphNode::GraphPtr SceneGraphNode::lastGraph() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_graph_;
}

}  // namespace occusg_ros
