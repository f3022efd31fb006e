// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/tf_poses.hpp"

#include <geometry_msgs/TransformStamped.h>
#include <tf2/exceptions.h>

#include <exception>

#include "occusg/error.hpp"
#include "occusg_ros/pose_conversions.hpp"
#include "occusg_ros/shown_text.hpp"

namespace occusg_ros {
namespace {

using Kind = PoseAnswer::Kind;

constexpr std::size_t kLongestFrame = 200;

// What tf can extrapolate neither now nor later: data older than the oldest it has.
bool isTooOld(const tf2::BufferCore& tf, const std::string& target, const std::string& source,
              const ros::Time& stamp) {
  if (stamp.isZero()) return false;
  try {
    return tf.lookupTransform(target, source, ros::Time()).header.stamp > stamp;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

std::string frameName(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

PoseAnswer poseAt(const tf2::BufferCore& tf, const std::string& target_frame,
                  const std::string& source_frame, const ros::Time& stamp) {
  const std::string target = frameName(target_frame);
  const std::string source = frameName(source_frame);
  const std::string name = "transform " + shownName(target) + " <- " + shownName(source);
  if (source.empty())
    return {Kind::kUnusable, occusg::Pose::Identity(), name + ": the frame has no name"};
  // tf repeats the name in what it says, several times.
  if (source.size() > kLongestFrame) {
    return {Kind::kUnusable, occusg::Pose::Identity(),
            name + ": the frame's name is longer than any frame's"};
  }
  try {
    return {Kind::kFound, toPose(tf.lookupTransform(target, source, stamp).transform, name), ""};
  } catch (const tf2::ExtrapolationException& error) {
    const Kind kind = isTooOld(tf, target, source, stamp) ? Kind::kNever : Kind::kNotYet;
    return {kind, occusg::Pose::Identity(), "no " + name + ": " + error.what()};
  } catch (const tf2::InvalidArgumentException& error) {
    return {Kind::kUnusable, occusg::Pose::Identity(), "no " + name + ": " + error.what()};
  } catch (const tf2::TransformException& error) {
    return {Kind::kNotYet, occusg::Pose::Identity(),
            "no " + name + " (is the localisation running?): " + error.what()};
  } catch (const std::exception& error) {
    // Ours, or a difference of stamps beyond 32 bits of seconds.
    return {Kind::kUnusable, occusg::Pose::Identity(), error.what()};
  }
}

std::optional<double> transformAge(const tf2::BufferCore& tf, const std::string& target,
                                   const std::string& source, const ros::Time& now) {
  try {
    const ros::Time newest =
        tf.lookupTransform(frameName(target), frameName(source), ros::Time()).header.stamp;
    return newest.isZero() ? 0.0 : (now - newest).toSec();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace occusg_ros
