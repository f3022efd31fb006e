// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/pose_conversions.hpp"

#include <cmath>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

template <typename Translation>
occusg::Pose poseOf(const Translation& translation, const geometry_msgs::Quaternion& rotation,
                    const std::string& where) {
  const Eigen::Vector3d position(translation.x, translation.y, translation.z);
  const Eigen::Quaterniond quaternion(rotation.w, rotation.x, rotation.y, rotation.z);
  if (!position.allFinite() || !quaternion.coeffs().allFinite())
    throw occusg::refuse(where, "a number of the pose is not finite", "metres are needed");
  if (std::abs(quaternion.norm() - 1.0) > occusg::kUnitQuaternionTolerance) {
    throw occusg::refuse(where, "its quaternion has length " + std::to_string(quaternion.norm()),
                         "a rotation has length 1");
  }
  occusg::Pose pose = occusg::Pose::Identity();
  pose.linear() = quaternion.normalized().toRotationMatrix();
  pose.translation() = position;
  return pose;
}

geometry_msgs::Quaternion quaternionOf(const occusg::Pose& pose) {
  const Eigen::Quaterniond quaternion(pose.linear());
  geometry_msgs::Quaternion msg;
  msg.x = quaternion.x();
  msg.y = quaternion.y();
  msg.z = quaternion.z();
  msg.w = quaternion.w();
  return msg;
}

}  // namespace

occusg::Pose toPose(const geometry_msgs::Transform& transform, const std::string& where) {
  return poseOf(transform.translation, transform.rotation, where);
}

occusg::Pose toPose(const geometry_msgs::Pose& pose, const std::string& where) {
  return poseOf(pose.position, pose.orientation, where);
}

geometry_msgs::Pose toPoseMsg(const occusg::Pose& pose) {
  geometry_msgs::Pose msg;
  msg.position.x = pose.translation().x();
  msg.position.y = pose.translation().y();
  msg.position.z = pose.translation().z();
  msg.orientation = quaternionOf(pose);
  return msg;
}

geometry_msgs::Transform toTransformMsg(const occusg::Pose& pose) {
  geometry_msgs::Transform msg;
  msg.translation.x = pose.translation().x();
  msg.translation.y = pose.translation().y();
  msg.translation.z = pose.translation().z();
  msg.rotation = quaternionOf(pose);
  return msg;
}

}  // namespace occusg_ros
