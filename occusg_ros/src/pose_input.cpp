// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/pose_input.hpp"

#include <ros/ros.h>

#include <exception>
#include <utility>

#include "occusg_ros/shown_text.hpp"
#include "occusg_ros/tf_input.hpp"
#include "occusg_ros/tf_poses.hpp"

namespace occusg_ros {
namespace {

constexpr std::uint32_t kPoseQueue = 100;

geometry_msgs::TransformStamped transformOf(const std_msgs::Header& header,
                                            const std::string& robot_frame,
                                            const geometry_msgs::Pose& pose) {
  geometry_msgs::TransformStamped transform;
  transform.header = header;
  transform.header.frame_id = frameName(header.frame_id);
  transform.child_frame_id = frameName(robot_frame);
  transform.transform.translation.x = pose.position.x;
  transform.transform.translation.y = pose.position.y;
  transform.transform.translation.z = pose.position.z;
  transform.transform.rotation = pose.orientation;
  return transform;
}

}  // namespace

geometry_msgs::TransformStamped transformOf(const nav_msgs::Odometry& odometry,
                                            const std::string& robot_frame) {
  const std::string& child = odometry.child_frame_id;
  return transformOf(odometry.header, child.empty() ? robot_frame : child, odometry.pose.pose);
}

geometry_msgs::TransformStamped transformOf(const geometry_msgs::PoseStamped& pose,
                                            const std::string& robot_frame) {
  return transformOf(pose.header, robot_frame, pose.pose);
}

PoseInput::PoseInput(ros::NodeHandle& nh, PoseInputConfig config, tf2_ros::Buffer& buffer)
    : config_(std::move(config)), buffer_(buffer) {
  if (config_.source == PoseSource::kOdometry) {
    subscriber_ = nh.subscribe<nav_msgs::Odometry>(
        config_.topic, kPoseQueue, [this](const nav_msgs::OdometryConstPtr& odometry) {
          take(transformOf(*odometry, config_.robot_frame));
        });
  } else if (config_.source == PoseSource::kPose) {
    subscriber_ = nh.subscribe<geometry_msgs::PoseStamped>(
        config_.topic, kPoseQueue, [this](const geometry_msgs::PoseStampedConstPtr& pose) {
          take(transformOf(*pose, config_.robot_frame));
        });
  }
}

void PoseInput::take(const geometry_msgs::TransformStamped& transform) {
  std::string problem = transformProblem(transform, ros::Time::now());
  try {
    if (problem.empty()) buffer_.setTransform(transform, "pose", false);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  if (!problem.empty()) {
    if (warnings_.allows())
      ROS_WARN_STREAM(config_.topic << ": a pose is not used: " << shownText(problem));
    return;
  }
  const std::string& frame = transform.header.frame_id;
  if (has_told_frame_ || frame == frameName(config_.map_frame)) return;
  has_told_frame_ = true;
  ROS_WARN_STREAM(config_.topic << ": poses are in '" << shownName(frame) << "' and ~map_frame is '"
                                << config_.map_frame
                                << "': tf must join the two, or map_frame must be '"
                                << shownName(frame) << "'");
}

}  // namespace occusg_ros
