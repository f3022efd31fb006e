// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/sequence_messages.hpp"

#include <sensor_msgs/image_encodings.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "occusg/error.hpp"
#include "occusg/io/color_image.hpp"
#include "occusg_ros/image_conversions.hpp"
#include "occusg_ros/pose_conversions.hpp"

namespace occusg_ros {
namespace {

sensor_msgs::Image depthMsg(const occusg::DepthImage& depth, const std_msgs::Header& header) {
  namespace enc = sensor_msgs::image_encodings;
  if (depth.pixels.type() == CV_16UC1 && depth.units_per_m == kMillimetresPerMetre)
    return imageMsg(depth.pixels, enc::TYPE_16UC1, header);
  cv::Mat metres;
  depth.pixels.convertTo(metres, CV_32F, 1.0 / depth.units_per_m);
  return imageMsg(metres, enc::TYPE_32FC1, header);
}

sensor_msgs::CameraInfo infoMsg(const occusg::CameraModel& camera, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

// The robot stands below its camera and looks where it looks.
occusg::Pose robotBelow(const occusg::Pose& T_map_camera) {
  const Eigen::Vector3d forward = T_map_camera.linear().col(2);
  occusg::Pose T_map_robot = occusg::Pose::Identity();
  T_map_robot.linear() =
      Eigen::AngleAxisd(std::atan2(forward.y(), forward.x()), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  T_map_robot.translation() =
      Eigen::Vector3d(T_map_camera.translation().x(), T_map_camera.translation().y(), 0.0);
  return T_map_robot;
}

geometry_msgs::TransformStamped transformMsg(const std::string& parent, const std::string& child,
                                             const occusg::Pose& pose, const ros::Time& stamp) {
  geometry_msgs::TransformStamped msg;
  msg.header.stamp = stamp;
  msg.header.frame_id = parent;
  msg.child_frame_id = child;
  msg.transform = toTransformMsg(pose);
  return msg;
}

}  // namespace

FrameMessages messagesOf(const occusg::Frame& frame, const ros::Time& stamp,
                         const FrameNames& names) {
  FrameMessages messages;
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = names.camera;
  messages.info = infoMsg(frame.camera, header);
  messages.depth = depthMsg(frame.depth, header);
  if (frame.color_path) {
    const cv::Mat color = occusg::readColorImage(*frame.color_path);
    messages.color = imageMsg(color, sensor_msgs::image_encodings::BGR8, header);
  }
  const occusg::Pose T_map_robot = robotBelow(frame.T_map_camera);
  messages.tf.transforms = {
      transformMsg(names.map, names.robot, T_map_robot, stamp),
      transformMsg(names.robot, names.camera, T_map_robot.inverse() * frame.T_map_camera, stamp)};
  messages.odometry.header.stamp = stamp;
  messages.odometry.header.frame_id = names.map;
  messages.odometry.child_frame_id = names.robot;
  messages.odometry.pose.pose = toPoseMsg(T_map_robot);
  return messages;
}

}  // namespace occusg_ros
