// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>

#include <string>

#include "occusg/geometry/pose.hpp"

namespace occusg_ros {

/// @param where opens every sentence; what the transform is called.
/// @throws occusg::Error when a number is not finite or the quaternion is not of length one.
[[nodiscard]] occusg::Pose toPose(const geometry_msgs::Transform& transform,
                                  const std::string& where);
[[nodiscard]] occusg::Pose toPose(const geometry_msgs::Pose& pose, const std::string& where);

[[nodiscard]] geometry_msgs::Pose toPoseMsg(const occusg::Pose& pose);
[[nodiscard]] geometry_msgs::Transform toTransformMsg(const occusg::Pose& pose);

}  // namespace occusg_ros
