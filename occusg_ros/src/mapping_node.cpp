// SPDX-License-Identifier: BSD-3-Clause
#include "mapping_node.hpp"

#include <nav_msgs/OccupancyGrid.h>
#ifdef OCCUSG_HAVE_OCTOMAP_MSGS
#include <octomap_msgs/Octomap.h>
#endif
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/String.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/pipeline/config_file.hpp"
#include "occusg_ros/gap_conversions.hpp"
#include "occusg_ros/grid_conversions.hpp"
#include "occusg_ros/image_conversions.hpp"
#include "occusg_ros/live_values.hpp"
#include "occusg_ros/saved_folder.hpp"
#include "occusg_ros/shown_text.hpp"
#include "occusg_ros/stamp_gate.hpp"
#include "occusg_ros/topic_names.hpp"

namespace occusg_ros {
namespace {

constexpr double kIdle_s = 1.0;  // without a frame, the last layer goes out
constexpr double kStampTolerance_s = 1e-6;
constexpr double kFewValidPixels = 0.05;

}  // namespace

occusg::Storeys storeysIn(const MappingSettings& settings) {
  return settings.find_storeys ? occusg::Storeys::kFound : occusg::Storeys::kOne;
}

MappingNode::MappingNode(const NodeHandles& handles)
    : handles_(handles),
      settings_(readSettings<MappingSettings>(handles.parameters, config_)),
      started_s_(steadySeconds()),
      waiting_(static_cast<std::size_t>(settings_.queue_size)),
      live_(settings_.live),
      map_(emptyMap()),
      pose_gate_(settings_.live.pose_gate),
      generations_(expandedFolder(settings_.saving.save_folder, handles.inputs.getNamespace()),
                   runId(), handles.name),
      saver_(settings_.saving.autosave_period_s, started_s_,
             [this](const std::string& problem) { noteSave(kDefaultSaveName, problem); }),
      tf_(ros::Duration(settings_.tf_cache_s)),
      tf_input_(tf_),
      storeys_(handles.inputs, storeysIn(settings_)),
      diagnostics_(handles.inputs, handles.parameters, handles.name) {
  advertise();
  resume();
  worker_ = std::make_unique<Worker>(
      kWorkerPoll, [this] { return step(); },
      [this](const Failure& failure) { onFailure(failure); });
  subscribe();
}

MappingNode::~MappingNode() {
  if (settings_.saving.save_on_exit) saver_.hurry();
  health_timer_.stop();
  image_subscriber_.shutdown();
  info_subscriber_.shutdown();
  for (ros::ServiceServer& service : services_) service.shutdown();
  reconfigure_.reset();
  worker_.reset();
  saveAtEnd();
  // The process ends, and its memory with it: taking a large map apart voxel by voxel takes
  // seconds.
  if (ros::isShuttingDown()) (void)map_.release();
}

void MappingNode::advertise() {
  layer_publisher_ = handles_.inputs.advertise<nav_msgs::OccupancyGrid>("free_space", 1, true);
  fill_publisher_ = handles_.inputs.advertise<nav_msgs::OccupancyGrid>("free_space_fill", 1, true);
  gaps_publisher_ = handles_.inputs.advertise<occusg::OverheadGaps>("overhead_gaps", 1, true);
  voxel_publisher_ = handles_.inputs.advertise<sensor_msgs::PointCloud2>("occupied_voxels", 1);
#ifdef OCCUSG_HAVE_OCTOMAP_MSGS
  octomap_publisher_ = handles_.inputs.advertise<octomap_msgs::Octomap>("octomap", 1);
#endif
  config_publisher_ = handles_.parameters.advertise<std_msgs::String>("config", 1, true);
  std_msgs::String config;
  config.data = occusg::toYaml(config_, occusg::ConfigComments::kNone);
  config_publisher_.publish(config);

  reconfigure_ =
      std::make_unique<dynamic_reconfigure::Server<occusg::MappingLiveConfig>>(handles_.parameters);
  reconfigure_->setCallback(
      [this](occusg::MappingLiveConfig& live, std::uint32_t level) { onReconfigure(live, level); });
  diagnostics_.setHardwareID("none");
  diagnostics_.add("mapping", this, &MappingNode::describe);
}

void MappingNode::subscribe() {
  ros::NodeHandle& own = handles_.parameter_services;
  services_ = {own.advertiseService("reset", &MappingNode::onReset, this),
               own.advertiseService("pause", &MappingNode::onPause, this),
               own.advertiseService("save", &MappingNode::onSave, this),
               own.advertiseService("load", &MappingNode::onLoad, this)};
  const std::string& place = handles_.inputs.getNamespace();
  info_subscriber_ = handles_.inputs.subscribe<sensor_msgs::CameraInfo>(
      inputTopic(place, settings_.depth_info, "depth/camera_info"), kInputQueue,
      guardedCallback(this, &MappingNode::onInfo, "a camera_info"));
  subscribeToImages(inputTopic(place, settings_.depth_image, "depth/image_rect"));
  const bool has_odometry = settings_.pose_source == PoseSource::kOdometry;
  const std::string& given = has_odometry ? settings_.odom : settings_.pose;
  pose_input_ = std::make_unique<PoseInput>(
      handles_.inputs,
      PoseInputConfig{settings_.pose_source,
                      inputTopic(place, given, has_odometry ? "odom" : "pose"), settings_.map_frame,
                      settings_.robot_frame},
      tf_);
  health_timer_ = handles_.inputs.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { checkHealth(); });
}

void MappingNode::subscribeToImages(const std::string& topic) {
  transport_ = std::make_unique<image_transport::ImageTransport>(handles_.inputs);
  const image_transport::TransportHints hints(settings_.image_transport, ros::TransportHints(),
                                              handles_.parameters);
  try {
    image_subscriber_ = transport_->subscribe(
        topic, static_cast<std::uint32_t>(settings_.queue_size),
        guardedCallback(this, &MappingNode::onImage, "a depth image"), ros::VoidPtr(), hints);
  } catch (const image_transport::Exception&) {
    std::string there;
    for (const std::string& name : transport_->getLoadableTransports()) there += " " + name;
    throw occusg::refuse("~image_transport", "is '" + settings_.image_transport + "'",
                         "a transport whose plugin is installed is needed:" + there);
  }
}

void MappingNode::drop(Drop reason, const std::string& sentence, std::size_t count) {
  if (count == 0) return;
  health_.noteDropped(reason, sentence, count);
  if (!sentence.empty() && drop_warnings_.allows())
    ROS_WARN_STREAM(handles_.name << ": image not used: " << shownText(sentence));
}

void MappingNode::onFailure(const Failure& failure) noexcept {
  try {
    if (!failure.is_out_of_memory) {
      drop(Drop::kMap, failure.problem);
      return;
    }
    health_.noteDropped(Drop::kMap, failure.problem);
    if (paused_.exchange(true)) return;
    ROS_ERROR_STREAM(handles_.name << ": " << failure.problem
                                   << "; mapping is paused and the map is saved as '"
                                   << kDefaultSaveName << "'");
    worker_->post([this] { (void)save(kDefaultSaveName); });
  } catch (...) {
    // Without memory there may be no sentence either.
    health_.noteDropped(Drop::kMap, "");
  }
}

void MappingNode::onInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  const CallbackTimes::Timing timing(callbacks_, "camera_info");
  ++infos_received_;
  if (isFromTheFuture(info->header.stamp.toSec(), ros::Time::now().toSec())) {
    drop(Drop::kCameraInfo,
         "the stamp of the camera_info is in the future; are the clocks synchronised?");
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    camera_ = toCameraModel(*info, info_subscriber_.getTopic());
    camera_problem_.clear();
  } catch (const occusg::Error& error) {
    camera_.reset();
    camera_problem_ = error.what();
  }
}

void MappingNode::onImage(const sensor_msgs::ImageConstPtr& image) {
  const CallbackTimes::Timing timing(callbacks_, "depth image");
  health_.noteReceived();
  if (paused_) {
    drop(Drop::kPaused, "");
    return;
  }
  try {
    (void)toDepthImage(*image, image_subscriber_.getTopic());
  } catch (const occusg::Error& error) {
    drop(Drop::kImage, error.what());
    return;
  }
  StampGate::Result stamp;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    camera_frame_ = image->header.frame_id;
    stamp = stamps_.take(image->header.stamp.toSec(), ros::Time::now().toSec());
  }
  if (stamp.verdict == StampVerdict::kZero) drop(Drop::kStamp, "its stamp is zero");
  if (stamp.verdict == StampVerdict::kFuture)
    drop(Drop::kStamp, "its stamp is in the future; are the clocks synchronised?");
  if (stamp.verdict == StampVerdict::kNotNewer)
    drop(Drop::kStamp, "its stamp is not newer than the one before");
  if (stamp.verdict == StampVerdict::kJumpedBack) onClockJump();
  if (stamp.verdict != StampVerdict::kNewer && stamp.verdict != StampVerdict::kJumpedBack) return;

  std::optional<WaitingImage> pushed_out;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    pushed_out = waiting_.push({image, stamp.logical_s, steadySeconds()});
  }
  if (pushed_out) dropPushedOut(pushed_out->image->header);
  worker_->wake();
}

// It may have waited in vain for what the robot lacks; that is no overload.
void MappingNode::dropPushedOut(const std_msgs::Header& header) {
  const PoseAnswer answer = poseAt(tf_, settings_.map_frame, header.frame_id, header.stamp);
  if (!camera()) {
    drop(Drop::kCameraInfo, "no usable camera_info on " + info_subscriber_.getTopic());
  } else if (answer.kind == PoseAnswer::Kind::kNotYet) {
    drop(Drop::kNoTransform, answer.problem);
  } else {
    drop(Drop::kOverload, "");
  }
}

void MappingNode::onClockJump() {
  ROS_WARN_STREAM(
      handles_.name << ": the clock jumped back; the map is "
                    << (settings_.on_time_jump == OnTimeJump::kKeep ? "kept" : "reset"));
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.clear();
  }
  // With simulated time the listener notices by itself, at the right moment.
  if (!ros::Time::isSimTime()) tf_.clear();
  worker_->post([this] {
    pose_gate_.reset();
    if (settings_.on_time_jump == OnTimeJump::kReset) resetMap();
  });
}

void MappingNode::onReconfigure(occusg::MappingLiveConfig& live, std::uint32_t /*level*/) {
  const CallbackTimes::Timing timing(callbacks_, "reconfigure");
  const MappingLive in_use = this->live();
  LiveValues values;
  MappingLive changed;
  changed.tf_timeout_s = values.finite("tf_timeout_s", live.tf_timeout_s, in_use.tf_timeout_s);
  changed.voxels_period_s =
      values.finite("voxels_period_s", live.voxels_period_s, in_use.voxels_period_s);
  changed.pose_gate.max_jump_m =
      values.finite("max_pose_jump_m", live.max_pose_jump_m, in_use.pose_gate.max_jump_m);
  changed.pose_gate.max_jump_rad =
      values.finite("max_pose_jump_rad", live.max_pose_jump_rad, in_use.pose_gate.max_jump_rad);
  changed.pose_gate.frames_to_accept = live.pose_jump_frames;
  if (!values.refused().empty()) {
    ROS_WARN_STREAM(handles_.name << ": not a finite number, and not used: " << values.refused());
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  live_ = changed;
}

MappingLive MappingNode::live() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return live_;
}

std::optional<occusg::CameraModel> MappingNode::camera() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return camera_;
}

std::string MappingNode::tfProblem() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return tf_problem_;
}

Worker::Progress MappingNode::step() {
  if (ros::isShuttingDown()) {
    saveAtEnd();
    return Worker::Progress::kIdle;
  }
  saveFromTimeToTime();
  dropLateImages();
  PendingFrames<WaitingImage>::Taken taken = nextImage();
  drop(Drop::kOverload, "", taken.skipped);
  if (taken.frame) {
    process(*taken.frame);
    return Worker::Progress::kWorked;
  }
  publishLastLayer();
  return Worker::Progress::kIdle;
}

PendingFrames<MappingNode::WaitingImage>::Taken MappingNode::nextImage() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!camera_) return {};
  return waiting_.take(settings_.overload, [this](const WaitingImage& waiting) {
    const std_msgs::Header& header = waiting.image->header;
    const PoseAnswer answer = poseAt(tf_, settings_.map_frame, header.frame_id, header.stamp);
    if (answer.kind != PoseAnswer::Kind::kFound) tf_problem_ = answer.problem;
    return answer.kind != PoseAnswer::Kind::kNotYet;
  });
}

void MappingNode::dropLateImages() {
  std::size_t late = 0;
  std::string why;
  Drop reason = Drop::kNoTransform;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const double patience_s = live_.tf_timeout_s;
    const double now_s = steadySeconds();
    // In a queue, only the first waits for its transform; the others wait for their turn.
    const bool in_turn = settings_.overload == Overload::kQueue;
    bool first = true;
    late = waiting_.dropLate([&](const WaitingImage& waiting) {
      const bool is_late =
          now_s - waiting.arrived_s > patience_s && (!in_turn || first) &&
          (!camera_ || poseAt(tf_, settings_.map_frame, waiting.image->header.frame_id,
                              waiting.image->header.stamp)
                               .kind == PoseAnswer::Kind::kNotYet);
      first = first && is_late;
      return is_late;
    });
    if (!camera_) {
      reason = Drop::kCameraInfo;
      why = camera_problem_.empty() ? "no camera_info on " + info_subscriber_.getTopic()
                                    : camera_problem_;
    } else {
      why = tf_problem_;
    }
  }
  drop(reason, why, late);
}

void MappingNode::process(const WaitingImage& waiting) {
  const std_msgs::Header& header = waiting.image->header;
  const PoseAnswer answer = poseAt(tf_, settings_.map_frame, header.frame_id, header.stamp);
  if (answer.kind != PoseAnswer::Kind::kFound) {
    drop(answer.kind == PoseAnswer::Kind::kUnusable ? Drop::kBadTransform : Drop::kNoTransform,
         answer.problem);
    return;
  }
  pose_gate_.configure(live().pose_gate);
  const PoseVerdict pose = pose_gate_.take(answer.T_target_source, waiting.logical_s);
  if (pose == PoseVerdict::kJump) {
    drop(Drop::kPoseJump, "its pose jumped");
    return;
  }
  if (pose == PoseVerdict::kRelocalised)
    ROS_WARN_STREAM(handles_.name << ": the robot was relocalised; mapping continues from there");
  const std::optional<occusg::CameraModel> camera = this->camera();
  if (!camera) return;
  try {
    const double start_s = steadySeconds();
    const occusg::DepthFrame frame{
        waiting.logical_s,
        toDepthImage(*waiting.image, image_subscriber_.getTopic(), settings_.depth_units_per_m),
        *camera, answer.T_target_source};
    const occusg::FrameReport report = map_->process(frame);
    frame_times_.add(occusg::Stage::kTotal, 1000.0 * (steadySeconds() - start_s));
    warnOfFewPixels(report);
    if (!report.isUsed()) {
      drop(Drop::kMap, sentenceOn(report.verdict));
      noteStatus(steadySeconds() - waiting.arrived_s);
      return;
    }
  } catch (const std::bad_alloc&) {
    onFailure({"no more memory for a depth image", true});
    return;
  } catch (const std::exception& error) {
    drop(Drop::kMap, error.what());
    return;
  }
  health_.noteUsed();
  last_frame_s_ = steadySeconds();
  checkOrientation(waiting, *camera, answer.T_target_source);
  std_msgs::Header map_header = header;
  map_header.frame_id = settings_.map_frame;
  unpublished_ = map_header;
  if (!last_layer_s_ ||
      waiting.logical_s - *last_layer_s_ >= config_.region_period_s - kStampTolerance_s)
    publishLayer(map_header, waiting.logical_s);
  if (last_frame_s_ - last_voxels_s_ > live().voxels_period_s) publishVoxels(map_header);
  noteStatus(last_frame_s_ - waiting.arrived_s);
}

void MappingNode::checkOrientation(const WaitingImage& waiting, const occusg::CameraModel& camera,
                                   const occusg::Pose& T_map_camera) {
  if (orientation_.isDone()) return;
  orientation_.add(
      {waiting.logical_s,
       toDepthImage(*waiting.image, image_subscriber_.getTopic(), settings_.depth_units_per_m),
       camera, T_map_camera});
  if (!orientation_.isDone()) return;
  const std::string doubt = orientation_.doubt();
  if (doubt.empty()) return;
  ROS_WARN_STREAM(handles_.name << ": " << doubt);
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.doubt = doubt;
}

void MappingNode::warnOfFewPixels(const occusg::FrameReport& report) {
  const auto points = static_cast<double>(report.points);
  const auto drops = static_cast<double>(report.pixel_drops.total());
  if (points < kFewValidPixels * (points + drops) && pixel_warnings_.allows())
    ROS_WARN_STREAM(handles_.name << ": less than 5 % of the depth image is valid");
}

void MappingNode::publishLayer(const std_msgs::Header& header, double logical_s) {
  sendLayer(header);
  last_layer_s_ = logical_s;
  unpublished_.reset();
}

// What hangs over the layer goes first, so that who takes both need not wait.
void MappingNode::sendLayer(const std_msgs::Header& header) {
  storeys_.send(*map_, header);
  const occusg::FreeSpace& layer = map_->freeSpace();
  gaps_publisher_.publish(boost::make_shared<occusg::OverheadGaps>(toGapsMsg(layer, header)));
  const auto fill = boost::make_shared<nav_msgs::OccupancyGrid>(toGridMsg(layer, header));
  const occusg::Building& building = map_->building();
  if (building.storeys.size() > 1)
    fill->info.origin.position.z = building.storeys[building.current].floor_z_m;
  layer_publisher_.publish(boost::make_shared<nav_msgs::OccupancyGrid>(toDecidedGrid(*fill)));
  fill_publisher_.publish(fill);
}

// The layer follows logical time; the rest of a drive that has ended must not stay behind.
void MappingNode::publishLastLayer() {
  if (storeys_.isAwaited()) {
    std_msgs::Header now;
    now.stamp = ros::Time::now();
    now.frame_id = settings_.map_frame;
    storeys_.send(*map_, now);
  }
  if (!unpublished_ || steadySeconds() - last_frame_s_ < kIdle_s) return;
  const std_msgs::Header header = *unpublished_;
  publishVoxels(header);
  publishLayer(header, last_layer_s_.value_or(0.0));
}

void MappingNode::publishVoxels(const std_msgs::Header& header) {
  last_voxels_s_ = steadySeconds();
#ifdef OCCUSG_HAVE_OCTOMAP_MSGS
  if (octomap_publisher_.getNumSubscribers() > 0) {
    octomap_publisher_.publish(
        toOctomapMsg<octomap_msgs::Octomap>(map_->occupancyMap().tree(), header));
  }
#endif
  if (voxel_publisher_.getNumSubscribers() == 0) return;
  voxel_publisher_.publish(boost::make_shared<sensor_msgs::PointCloud2>(
      occupiedVoxels(map_->occupancyMap().tree(), header)));
}

void MappingNode::noteStatus(double lag_s) {
  const double now_s = steadySeconds();
  const bool with_times = now_s - last_status_s_ > 1.0;
  occusg::StageSummary times;
  if (with_times) {
    times = frame_times_.summary(occusg::Stage::kTotal);
    last_status_s_ = now_s;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.counts = map_->counts();
  status_.cut_islands = map_->occupancyMap().cutIslands().islands;
  status_.map_nodes = map_->occupancyMap().tree().size();
  status_.map_bytes = map_->occupancyMap().memoryBytes();
  status_.last_lag_s = lag_s;
  if (with_times) status_.frame_times = times;
}

}  // namespace occusg_ros
