// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "occusg/error.hpp"
#include "semantics_node.hpp"

namespace occusg_ros {

class SemanticsNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      node_ = std::make_unique<SemanticsNode>(NodeHandles{getNodeHandle(), getMTNodeHandle(),
                                                          getPrivateNodeHandle(),
                                                          getMTPrivateNodeHandle(), getName()});
    } catch (const occusg::Error& error) {
      NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());
      throw;  // nodelet's loader takes it as a failure to load; a node of its own ends
    }
  }

  std::unique_ptr<SemanticsNode> node_;
};

}  // namespace occusg_ros

PLUGINLIB_EXPORT_CLASS(occusg_ros::SemanticsNodelet, nodelet::Nodelet)
