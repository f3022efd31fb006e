// SPDX-License-Identifier: BSD-3-Clause
/// Loads a nodelet into a manager and keeps it there: a manager that was killed and started again
/// gets it again. `nodelet load` of nodelet_core waits for ever when its manager is killed before
/// the two have exchanged a heartbeat, which is when a robot's computer has too little memory.
/// Usage: load_nodelet TYPE MANAGER
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

const ros::WallDuration kPeriod(0.2);
const ros::WallDuration kPatience(5.0);
/// Between two looks at the manager, and before a lost nodelet is loaded again: subscribers that
/// have not noticed yet that its topics were gone would take the new ones, which have the same
/// address, for those they hear.
const ros::WallDuration kPause(1.0);

volatile std::sig_atomic_t is_asked_to_end = 0;

void askToEnd(int /*signal*/) { is_asked_to_end = 1; }

/// `rosnode kill`: the nodelet is unloaded while this node can still call its manager.
void onShutdownRequest(XmlRpc::XmlRpcValue& /*parameters*/, XmlRpc::XmlRpcValue& result) {
  is_asked_to_end = 1;
  result = ros::xmlrpc::responseInt(1, "", 0);
}

bool goesOn() { return is_asked_to_end == 0 && ros::ok(); }

/// One nodelet of a manager, named as this node.
class ManagedNodelet {
 public:
  ManagedNodelet(std::string type, const std::string& manager)
      : type_(std::move(type)), manager_(ros::names::resolve(manager)) {}

  /// Waits for the manager, and names it when it does not come.
  /// @returns false when this node is to end first.
  [[nodiscard]] bool waitForManager() const {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    bool is_told = false;
    while (goesOn() && !hasManager()) {
      if (!is_told && ros::SteadyTime::now() - begin > kPatience) {
        ROS_WARN_STREAM(name_ << ": there is no nodelet manager " << manager_
                              << "; waiting for it");
        is_told = true;
      }
      kPeriod.sleep();
    }
    return goesOn();
  }

  /// @returns false when the manager refuses the nodelet.
  [[nodiscard]] bool load() const {
    // One that an earlier loader left behind has the parameters of then.
    if (isLoaded()) unload();
    nodelet::NodeletLoad call;
    call.request.name = name_;
    call.request.type = type_;
    for (const auto& [from, to] : ros::names::getRemappings()) {
      call.request.remap_source_args.push_back(from);
      call.request.remap_target_args.push_back(to);
    }
    return ros::service::call(manager_ + "/load_nodelet", call) && call.response.success != 0;
  }

  [[nodiscard]] bool isLoaded() const {
    nodelet::NodeletList call;
    if (!ros::service::call(manager_ + "/list", call)) return false;
    const std::vector<std::string>& names = call.response.nodelets;
    return std::find(names.begin(), names.end(), name_) != names.end();
  }

  void unload() const {
    nodelet::NodeletUnload call;
    call.request.name = name_;
    (void)ros::service::call(manager_ + "/unload_nodelet", call);
  }

  [[nodiscard]] bool hasManager() const {
    return ros::service::exists(manager_ + "/load_nodelet", false);
  }

  /// Loads the nodelet as often as the manager loses it, until this node is to end.
  /// @returns false when the manager is there and refuses the nodelet.
  [[nodiscard]] bool keep() const {
    while (waitForManager()) {
      if (!load()) {
        if (!goesOn()) break;
        if (hasManager()) return false;
        continue;
      }
      while (goesOn() && isLoaded()) pause();
      if (!goesOn()) break;
      ROS_WARN_STREAM(name_ << ": is no longer in " << manager_ << "; it is loaded again");
      pause();
    }
    if (hasManager()) unload();
    return true;
  }

  static void pause() {
    const ros::SteadyTime end = ros::SteadyTime::now() + kPause;
    while (goesOn() && ros::SteadyTime::now() < end) kPeriod.sleep();
  }

  [[nodiscard]] std::string refusal() const {
    return name_ + ": the nodelet manager " + manager_ + " does not load a nodelet of type " +
           type_ + "; its log says why";
  }

 private:
  std::string name_ = ros::this_node::getName();
  std::string type_;
  std::string manager_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "load_nodelet", ros::init_options::NoSigintHandler);
  if (argc != 3) {
    std::cerr << "usage: load_nodelet TYPE MANAGER\n";
    return 2;
  }
  (void)std::signal(SIGINT, askToEnd);
  (void)std::signal(SIGTERM, askToEnd);
  const ros::NodeHandle keeps_ros_running;
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", onShutdownRequest);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  const ManagedNodelet nodelet(argv[1], argv[2]);
  const bool is_kept = nodelet.keep();
  if (!is_kept) ROS_FATAL_STREAM(nodelet.refusal());
  ros::shutdown();
  return is_kept ? 0 : 1;
}
