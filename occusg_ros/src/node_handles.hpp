// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>

namespace occusg_ros {

/// Between two equal warnings [s].
inline constexpr double kWarningPeriod_s = 5.0;

/// What a nodelet gets from its manager.
struct NodeHandles {
  ros::NodeHandle inputs;              ///< One callback at a time.
  ros::NodeHandle services;            ///< Several at a time: a service may wait.
  ros::NodeHandle parameters;          ///< Private names, one callback at a time.
  ros::NodeHandle parameter_services;  ///< Private names, several at a time.
  std::string name;
};

}  // namespace occusg_ros
