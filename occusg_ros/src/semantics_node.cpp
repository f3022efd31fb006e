// SPDX-License-Identifier: BSD-3-Clause
#include "semantics_node.hpp"

#include <occusg/DetectionArray.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <exception>
#include <optional>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/perception/class_names.hpp"
#include "occusg/perception/onnx_segmenter.hpp"
#include "occusg_ros/graph_conversions.hpp"
#include "occusg_ros/image_conversions.hpp"
#include "occusg_ros/shown_text.hpp"
#include "occusg_ros/stamp_gate.hpp"
#include "occusg_ros/topic_names.hpp"

namespace occusg_ros {
namespace {

std::unique_ptr<occusg::InstanceSegmenter> segmenterFor(const SemanticsSettings& settings,
                                                        occusg::OnnxSegmenterConfig config) {
  if (settings.model.empty()) {
    throw occusg::refuse("~model", "it names no file",
                         "give an ONNX file of a YOLO segmentation model");
  }
  config.model_path = settings.model;
  config.class_names = occusg::readClassNames(settings.classes);
  return std::make_unique<occusg::OnnxSegmenter>(config);
}

}  // namespace

SemanticsNode::SemanticsNode(const NodeHandles& handles)
    : handles_(handles),
      settings_(readSettings<SemanticsSettings>(handles.parameters, config_)),
      started_s_(steadySeconds()),
      waiting_(kInputQueue),
      segmenter_(segmenterFor(settings_, config_.segmenter)),
      builder_(config_.detection),
      tf_input_(tf_),
      publisher_(handles_.inputs.advertise<occusg::DetectionArray>("detections", kInputQueue)),
      worker_(std::make_unique<Worker>(
          kWorkerPoll, [this] { return step(); },
          [this](const Failure& failure) { onFailure(failure); })),
      diagnostics_(handles.inputs, handles.parameters, handles.name) {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("semantics", this, &SemanticsNode::describe);
  ros::NodeHandle& nh = handles_.inputs;
  const std::string& place = nh.getNamespace();
  color_subscriber_.subscribe(nh, inputTopic(place, settings_.rgb_image, "rgb/image_rect_color"),
                              kInputQueue);
  depth_subscriber_.subscribe(nh, inputTopic(place, settings_.depth_image, "depth/image_rect"),
                              kInputQueue);
  info_subscriber_.subscribe(nh, inputTopic(place, settings_.depth_info, "depth/camera_info"),
                             kInputQueue);
  synchronizer_ = std::make_unique<message_filters::Synchronizer<Policy>>(
      Policy(kInputQueue), color_subscriber_, depth_subscriber_, info_subscriber_);
  synchronizer_->registerCallback(&SemanticsNode::onViews, this);
  health_timer_ = nh.createWallTimer(ros::WallDuration(1.0),
                                     [this](const ros::WallTimerEvent&) { checkHealth(); });
}

SemanticsNode::~SemanticsNode() {
  health_timer_.stop();
  color_subscriber_.unsubscribe();
  depth_subscriber_.unsubscribe();
  info_subscriber_.unsubscribe();
  synchronizer_.reset();
  worker_.reset();
}

void SemanticsNode::drop(Drop reason, const std::string& sentence, std::size_t count) {
  if (count == 0) return;
  health_.noteDropped(reason, sentence, count);
  if (!sentence.empty() && warnings_.allows())
    ROS_WARN_STREAM(handles_.name << ": image not used: " << shownText(sentence));
}

void SemanticsNode::onViews(const sensor_msgs::ImageConstPtr& color,
                            const sensor_msgs::ImageConstPtr& depth,
                            const sensor_msgs::CameraInfoConstPtr& info) {
  guarded(
      "images",
      [&] {
        take({color, depth, info, steadySeconds()});
      },
      [this](const Failure& failure) { onFailure(failure); });
}

void SemanticsNode::take(const Views& views) {
  const CallbackTimes::Timing timing(callbacks_, "images");
  health_.noteReceived();
  if (isFromTheFuture(views.depth->header.stamp.toSec(), ros::Time::now().toSec())) {
    drop(Drop::kStamp, "its stamp is in the future; are the clocks synchronised?");
    return;
  }
  std::optional<Views> pushed_out;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    pushed_out = waiting_.push(views);
  }
  if (pushed_out) {
    const PoseAnswer pose = poseOf(*pushed_out);
    const bool was_ready = pose.kind == PoseAnswer::Kind::kFound;
    drop(was_ready ? Drop::kOverload : Drop::kNoTransform, pose.problem);
  }
  worker_->wake();
}

void SemanticsNode::onFailure(const Failure& failure) noexcept {
  try {
    drop(Drop::kImage, failure.problem);
  } catch (...) {
    // Without memory there may be no sentence either.
    health_.noteDropped(Drop::kImage, "");
  }
}

PoseAnswer SemanticsNode::poseOf(const Views& views) const {
  const std_msgs::Header& header = views.depth->header;
  return poseAt(tf_, settings_.map_frame, header.frame_id, header.stamp);
}

void SemanticsNode::dropLateViews() {
  std::size_t late = 0;
  std::string why;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const double now_s = steadySeconds();
    late = waiting_.dropLate([&](const Views& views) {
      if (now_s - views.arrived_s < settings_.tf_timeout_s) return false;
      const PoseAnswer pose = poseOf(views);
      if (pose.kind != PoseAnswer::Kind::kNotYet) return false;
      why = pose.problem;
      return true;
    });
  }
  drop(Drop::kNoTransform, why, late);
}

Worker::Progress SemanticsNode::step() {
  dropLateViews();
  PendingFrames<Views>::Taken taken;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    taken = waiting_.take(Overload::kSkip, [this](const Views& views) {
      return poseOf(views).kind != PoseAnswer::Kind::kNotYet;
    });
  }
  drop(Drop::kOverload, "", taken.skipped);
  if (!taken.frame) return Worker::Progress::kIdle;
  const PoseAnswer pose = poseOf(*taken.frame);
  if (pose.kind == PoseAnswer::Kind::kFound) {
    process(*taken.frame, pose.T_target_source);
  } else {
    drop(Drop::kNoTransform, pose.problem);
  }
  return Worker::Progress::kWorked;
}

void SemanticsNode::process(const Views& views, const occusg::Pose& T_map_camera) {
  try {
    const double start_s = steadySeconds();
    const occusg::DepthFrame frame{
        views.depth->header.stamp.toSec(),
        toDepthImage(*views.depth, "depth/image_rect", settings_.depth_units_per_m),
        toCameraModel(*views.info, "depth/camera_info"), T_map_camera};
    const occusg::InstanceMasks masks =
        segmenter_->segment(toColorImage(*views.color, "rgb/image_rect_color"));
    const occusg::DetectionResult result = builder_.build(masks, frame);
    std_msgs::Header header = views.depth->header;
    header.frame_id = settings_.map_frame;
    publisher_.publish(
        boost::make_shared<occusg::DetectionArray>(toDetectionMsg(result.detections, header)));
    health_.noteUsed();
    const std::lock_guard<std::mutex> lock(mutex_);
    times_.add(occusg::Stage::kTotal, 1000.0 * (steadySeconds() - start_s));
    detections_ += result.detections.size();
  } catch (const std::exception& error) {
    drop(Drop::kImage, error.what());
  }
}

void SemanticsNode::checkHealth() {
  const CallbackTimes::Timing timing(callbacks_, "health");
  diagnostics_.force_update();
  clock_.warn(handles_.name);
  const InputHealth::Counts counts = health_.counts();
  if (counts.used > 0) return;
  const auto input = [&](const std::string& what, const auto& subscriber) {
    return NeededInput{what, subscriber.getSubscriber().getTopic(), counts.received,
                       subscriber.getSubscriber().getNumPublishers()};
  };
  const std::string missing = missing_input_.toSay(
      {input("colour image", color_subscriber_), input("depth image", depth_subscriber_),
       input("camera_info", info_subscriber_)},
      counts.last_problem, steadySeconds() - started_s_);
  if (!missing.empty()) ROS_WARN_STREAM(handles_.name << ": nothing is detected: " << missing);
}

void SemanticsNode::describe(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  const InputHealth::Counts counts = health_.counts();
  occusg::StageSummary times;
  std::size_t detections = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    times = times_.summary(occusg::Stage::kTotal);
    detections = detections_;
  }
  const std::string clock_problem = clock_.problem();
  if (!clock_problem.empty()) {
    status.summary(Level::ERROR, clock_problem);
  } else if (counts.received == 0) {
    status.summary(Level::WARN, "no images that belong together yet");
  } else if (counts.used == 0) {
    status.summary(Level::ERROR, "no image could be used: " + counts.last_problem);
  } else {
    status.summary(Level::OK, "detecting");
  }
  status.add("images received", counts.received);
  status.add("images used", counts.used);
  status.add("detections", detections);
  for (const Drop reason : {Drop::kImage, Drop::kNoTransform, Drop::kOverload})
    status.add("dropped: " + nameOf(reason), counts.of(reason));
  status.add("last problem", counts.last_problem);
  callbacks_.describe(status);
  status.add("time p50 [ms]", times.p50_ms);
  status.add("time p95 [ms]", times.p95_ms);
  status.add("time max [ms]", times.max_ms);
}

}  // namespace occusg_ros
