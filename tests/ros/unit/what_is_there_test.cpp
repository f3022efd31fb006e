// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/what_is_there.hpp"

#include <gtest/gtest.h>

#include "occusg_ros/pose_input.hpp"

namespace occusg_ros {
namespace {

ros::master::TopicInfo topic(const std::string& name, const std::string& type) {
  return ros::master::TopicInfo(name, type);
}

TEST(WhatIsThere, TopicsOfTheTypeAndThoseBelowAreNamed) {
  const ros::master::V_TopicInfo topics = {
      topic("/cam/color/image_raw", "sensor_msgs/Image"),
      topic("/cam/depth/image_raw", "sensor_msgs/Image"),
      topic("/cam/depth/image_rect/compressedDepth", "sensor_msgs/CompressedImage"),
      topic("/scan", "sensor_msgs/LaserScan")};
  EXPECT_EQ(
      publishedInstead("/cam/depth/image_rect", "sensor_msgs/Image", topics),
      "; /cam/depth/image_rect/compressedDepth, /cam/depth/image_raw, /cam/color/image_raw are "
      "published");
  EXPECT_EQ(publishedInstead("/map", "nav_msgs/OccupancyGrid", topics), "");
}

TEST(WhatIsThere, FramesOfTfAreNamed) {
  tf2::BufferCore tf;
  EXPECT_EQ(framesInstead(tf), "; tf has no frames");
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "odom";
  transform.child_frame_id = "base_link";
  transform.transform.rotation.w = 1.0;
  tf.setTransform(transform, "test", true);
  const std::string text = framesInstead(tf);
  EXPECT_NE(text.find("odom"), std::string::npos);
  EXPECT_NE(text.find("base_link"), std::string::npos);
}

TEST(PoseInput, AMessageStandsForATransform) {
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "/odom";
  odometry.header.stamp = ros::Time(3.0);
  odometry.pose.pose.position.x = 2.0;
  odometry.pose.pose.orientation.w = 1.0;
  geometry_msgs::TransformStamped transform = transformOf(odometry, "base_link");
  EXPECT_EQ(transform.header.frame_id, "odom");
  EXPECT_EQ(transform.child_frame_id, "base_link") << "the message does not say";
  EXPECT_EQ(transform.transform.translation.x, 2.0);
  odometry.child_frame_id = "base_footprint";
  transform = transformOf(odometry, "base_link");
  EXPECT_EQ(transform.child_frame_id, "base_footprint");
}

}  // namespace
}  // namespace occusg_ros
