// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>

#include "occusg/geometry/pose.hpp"

namespace occusg_ros {

/// The name of a frame as tf2 keeps it: bags and drivers from before ROS Hydro write a slash before
/// it.
[[nodiscard]] std::string frameName(const std::string& frame);

/// The pose of a frame, or why there is none.
struct PoseAnswer {
  enum class Kind {
    kFound,
    kNotYet,    ///< tf may still learn it.
    kNever,     ///< The time asked for is older than what tf remembers.
    kUnusable,  ///< It is not a pose.
  };
  Kind kind = Kind::kNotYet;
  occusg::Pose T_target_source = occusg::Pose::Identity();
  std::string problem;  ///< One sentence; empty when found.
};

/// Asks `tf` where `source` is in `target` at `stamp`; zero: at the newest time known. Never waits
/// and never makes a pose up.
[[nodiscard]] PoseAnswer poseAt(const tf2::BufferCore& tf, const std::string& target,
                                const std::string& source, const ros::Time& stamp);

/// How far the newest known transform between the frames lies behind `now` [s]; nothing when there
/// is none, zero when it holds for all times.
[[nodiscard]] std::optional<double> transformAge(const tf2::BufferCore& tf,
                                                 const std::string& target,
                                                 const std::string& source, const ros::Time& now);

}  // namespace occusg_ros
