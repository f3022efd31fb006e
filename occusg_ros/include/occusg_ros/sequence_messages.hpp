// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_msgs/TFMessage.h>

#include <optional>
#include <string>

#include "occusg/io/sequence_reader.hpp"

namespace occusg_ros {

/// How a robot that made the recording would call its frames.
struct FrameNames {
  std::string map = "map";
  std::string robot = "base_link";
  std::string camera = "camera_depth_optical_frame";
};

/// One recorded frame as a robot would send it.
struct FrameMessages {
  tf2_msgs::TFMessage tf;  ///< map -> robot (on the floor, upright, below the camera) -> camera.
  nav_msgs::Odometry odometry;
  sensor_msgs::CameraInfo info;
  sensor_msgs::Image depth;
  std::optional<sensor_msgs::Image> color;
};

/// @param stamp of all messages, whatever the frame's own is.
/// @throws occusg::Error when the colour image cannot be read.
[[nodiscard]] FrameMessages messagesOf(const occusg::Frame& frame, const ros::Time& stamp,
                                       const FrameNames& names);

}  // namespace occusg_ros
