// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>

#include <atomic>
#include <cstddef>
#include <string>

namespace occusg_ros {

/// Whether a transform can be kept: names, finite numbers, a rotation, and a stamp that tf can
/// calculate with and that is no more than `kFuture_s` ahead of the clock. The sentence of what is
/// wrong, empty when nothing is.
/// @param now the clock; zero: there is none.
[[nodiscard]] std::string transformProblem(const geometry_msgs::TransformStamped& transform,
                                           const ros::Time& now);

/// Listens to /tf and /tf_static on a thread of its own, as `tf2_ros::TransformListener` does, and
/// keeps what cannot be used away from the buffer: one transform with a stamp that was never set
/// would end the process later on.
class TfInput {
 public:
  explicit TfInput(tf2_ros::Buffer& buffer);
  TfInput(const TfInput&) = delete;
  TfInput& operator=(const TfInput&) = delete;
  TfInput(TfInput&&) = delete;
  TfInput& operator=(TfInput&&) = delete;
  ~TfInput();

  [[nodiscard]] std::size_t refused() const { return refused_; }

 private:
  void take(const tf2_msgs::TFMessage& message, bool is_static);

  tf2_ros::Buffer& buffer_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::Subscriber moving_;
  ros::Subscriber fixed_;
  ros::Time last_clock_;
  std::atomic<std::size_t> refused_{0};
  ros::AsyncSpinner spinner_;  // last: it uses all of the above
};

}  // namespace occusg_ros
