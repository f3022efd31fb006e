// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/tf_input.hpp"

#include <cmath>
#include <exception>

#include "occusg_ros/stamp_gate.hpp"

namespace occusg_ros {
namespace {

constexpr std::uint32_t kTfQueue = 100;
constexpr double kWarningPeriod_s = 5.0;

bool isRotation(const geometry_msgs::Quaternion& q) {
  constexpr double kTolerance = 0.1;
  return std::abs(std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w) - 1.0) < kTolerance;
}

bool isFinite(const geometry_msgs::Vector3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

std::string transformProblem(const geometry_msgs::TransformStamped& transform,
                             const ros::Time& now) {
  if (transform.header.frame_id.empty() || transform.child_frame_id.empty())
    return "a frame has no name";
  if (!isFinite(transform.transform.translation)) return "its translation is not finite";
  if (!isRotation(transform.transform.rotation)) return "its rotation is no unit quaternion";
  const double stamp_s = transform.header.stamp.toSec();
  if (isFromTheFuture(stamp_s, now.toSec()))
    return "its stamp is in the future; are the clocks synchronised?";
  return "";
}

TfInput::TfInput(tf2_ros::Buffer& buffer) : buffer_(buffer), spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  const auto listen = [this](const std::string& topic, bool is_static) {
    return node_.subscribe<tf2_msgs::TFMessage>(
        topic, kTfQueue, [this, is_static](const tf2_msgs::TFMessageConstPtr& message) {
          take(*message, is_static);
        });
  };
  moving_ = listen("/tf", false);
  fixed_ = listen("/tf_static", true);
  buffer_.setUsingDedicatedThread(true);
  spinner_.start();
}

TfInput::~TfInput() { spinner_.stop(); }

void TfInput::take(const tf2_msgs::TFMessage& message, bool is_static) {
  const ros::Time now = ros::Time::now();
  // A bag that loops: what was known belongs to another round.
  if (now < last_clock_) {
    ROS_WARN("tf: the clock jumped back; transforms of the time before it are forgotten");
    buffer_.clear();
  }
  last_clock_ = now;
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    std::string problem = transformProblem(transform, now);
    try {
      if (problem.empty()) buffer_.setTransform(transform, "tf", is_static);
    } catch (const std::exception& error) {
      problem = error.what();
    }
    if (problem.empty()) continue;
    ++refused_;
    constexpr std::size_t kShown = 64;
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod_s, "tf: the transform of '"
                                                   << transform.child_frame_id.substr(0, kShown)
                                                   << "' is not used: " << problem);
  }
}

}  // namespace occusg_ros
