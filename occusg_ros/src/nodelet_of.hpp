// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <string>

#include "node_handles.hpp"

namespace occusg_ros {

/// A node that could not start, for a parameter or a model: it says so in the diagnostics for as
/// long as its manager runs, and does nothing else. A nodelet that refuses to load would be loaded
/// again by roslaunch every second, with the same sentence.
class FailedNode {
 public:
  FailedNode(const NodeHandles& handles, const std::string& problem)
      : updater_(handles.inputs, handles.parameters, handles.name) {
    updater_.setHardwareID("none");
    updater_.add("start", [problem](diagnostic_updater::DiagnosticStatusWrapper& status) {
      status.summary(diagnostic_msgs::DiagnosticStatus::ERROR, "does not start: " + problem);
    });
    ros::NodeHandle nh = handles.inputs;
    timer_ = nh.createWallTimer(ros::WallDuration(1.0),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
  }

 private:
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

/// `Node` in a manager of nodelets, or alone in a process of its own. Its callbacks run on threads
/// of its own and not on the manager's: a manager that unloads a nodelet while one of its threads
/// runs a callback of it destroys the callback queues first, and the nodelet would end with queues
/// that are gone (nodelet_core 1.10, `ManagedNodelet`).
template <typename Node>
class NodeletOf : public nodelet::Nodelet {
 public:
  NodeletOf() = default;
  NodeletOf(const NodeletOf&) = delete;
  NodeletOf& operator=(const NodeletOf&) = delete;
  NodeletOf(NodeletOf&&) = delete;
  NodeletOf& operator=(NodeletOf&&) = delete;
  ~NodeletOf() override {
    node_.reset();
    failed_.reset();
  }

 private:
  void onInit() override {
    const NodeHandles handles{onQueue(getNodeHandle(), inputs_),
                              onQueue(getNodeHandle(), services_),
                              onQueue(getPrivateNodeHandle(), inputs_),
                              onQueue(getPrivateNodeHandle(), services_), getName()};
    try {
      node_ = std::make_unique<Node>(handles);
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());
      const bool is_alone = getName() == ros::this_node::getName();
      if (is_alone) throw;  // the process ends
      failed_ = std::make_unique<FailedNode>(handles, error.what());
    }
    input_thread_.start();
    service_threads_.start();
  }

  [[nodiscard]] static ros::NodeHandle onQueue(ros::NodeHandle handle, ros::CallbackQueue& queue) {
    handle.setCallbackQueue(&queue);
    return handle;
  }

  static constexpr std::uint32_t kServiceThreads = 4;

  ros::CallbackQueue inputs_;
  ros::CallbackQueue services_;
  ros::AsyncSpinner input_thread_{1, &inputs_};
  ros::AsyncSpinner service_threads_{kServiceThreads, &services_};
  std::unique_ptr<Node> node_;
  std::unique_ptr<FailedNode> failed_;
};

}  // namespace occusg_ros
