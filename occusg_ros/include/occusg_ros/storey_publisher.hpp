// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <std_msgs/Header.h>

#include <atomic>
#include <cstddef>
#include <vector>

#include "occusg/pipeline/map_pipeline.hpp"

namespace occusg_ros {

/// Publishes the free space of each storey of a building that has several: `free_space/<floor_id>`,
/// latched, for those who plan on a storey, and `storey_layers` for occusg/scene_graph. A building
/// of one storey has neither.
class StoreyPublisher {
 public:
  /// @param storeys whether the map may have several. Where it may not, `storey_layers` says once
  /// that the building has one: whoever knows it from a session may know more.
  StoreyPublisher(const ros::NodeHandle& node_handle, occusg::Storeys storeys);

  /// Publishes the layers that changed since the last call, and that of the current storey; all of
  /// them when somebody has subscribed since.
  void send(occusg::MapPipeline& map, const std_msgs::Header& header);
  /// Whether somebody has subscribed to the layers since they were sent.
  [[nodiscard]] bool isAwaited() const { return has_new_subscriber_; }
  /// The map is another one from now on.
  void forget(const occusg::MapPipeline& map, const std_msgs::Header& header);

 private:
  void sendLayer(const occusg::MapPipeline& map, std::size_t storey,
                 const std_msgs::Header& header);

  ros::NodeHandle node_handle_;
  occusg::Storeys storeys_;
  std::atomic<bool> has_new_subscriber_{false};
  ros::Publisher layers_publisher_;
  std::vector<ros::Publisher> grid_publishers_;  ///< By storey; none while there is one.
};

}  // namespace occusg_ros
