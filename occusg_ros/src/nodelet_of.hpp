// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>

#include <memory>

#include "node_handles.hpp"
#include "occusg/error.hpp"

namespace occusg_ros {

/// `Node` in a manager of nodelets, or alone in a process of its own.
template <typename Node>
class NodeletOf : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      node_ = std::make_unique<Node>(NodeHandles{getNodeHandle(), getMTNodeHandle(),
                                                 getPrivateNodeHandle(), getMTPrivateNodeHandle(),
                                                 getName()});
    } catch (const occusg::Error& error) {
      NODELET_FATAL_STREAM(getName() << " does not start: " << error.what());
      throw;  // nodelet's loader takes it as a failure to load; a node of its own ends
    }
  }

  std::unique_ptr<Node> node_;
};

}  // namespace occusg_ros
