// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>

#include <string>

#include "occusg_ros/throttle.hpp"

namespace occusg_ros {

/// Where the robot's pose comes from.
enum class PoseSource {
  kTf,        ///< tf alone.
  kOdometry,  ///< nav_msgs/Odometry.
  kPose,      ///< geometry_msgs/PoseStamped of the robot's frame.
};

/// Which messages give the pose, and of what.
struct PoseInputConfig {
  PoseSource source = PoseSource::kTf;
  std::string topic;        ///< Resolved.
  std::string map_frame;    ///< The frame poses must be in, or be joined to by tf.
  std::string robot_frame;  ///< Whose pose it is, where the message does not say.
};

/// The transform a pose message stands for.
[[nodiscard]] geometry_msgs::TransformStamped transformOf(const nav_msgs::Odometry& odometry,
                                                          const std::string& robot_frame);
[[nodiscard]] geometry_msgs::TransformStamped transformOf(const geometry_msgs::PoseStamped& pose,
                                                          const std::string& robot_frame);

/// Puts poses that come as messages into tf's buffer, as if they came on /tf: what is looked up
/// then, a camera with a static mount for example, follows from them, and poses between two
/// messages are interpolated.
class PoseInput {
 public:
  /// Subscribes to nothing when the source is tf.
  PoseInput(ros::NodeHandle& nh, PoseInputConfig config, tf2_ros::Buffer& buffer);

 private:
  void take(const geometry_msgs::TransformStamped& transform);

  PoseInputConfig config_;
  tf2_ros::Buffer& buffer_;
  Throttle warnings_{5.0};
  bool has_told_frame_ = false;
  ros::Subscriber subscriber_;
};

}  // namespace occusg_ros
