// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/master.h>
#include <tf2/buffer_core.h>

#include <string>
#include <vector>

namespace occusg_ros {

/// What an operator may have meant when nothing comes on `wanted`: topics below it (as a transport
/// makes them) and others of the type, those with most of the same words first; at most four. "; /a
/// and /b are published", or empty when there is none.
/// @param topics all that are published, as the master tells.
[[nodiscard]] std::string publishedInstead(const std::string& wanted, const std::string& type,
                                           const ros::master::V_TopicInfo& topics);
/// The same, asking the master.
[[nodiscard]] std::string publishedInstead(const std::string& wanted, const std::string& type);

/// "; tf has odom, base_link", or that tf is empty.
[[nodiscard]] std::string framesInstead(const tf2::BufferCore& tf);

}  // namespace occusg_ros
