// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/storey_publisher.hpp"

#include <nav_msgs/OccupancyGrid.h>
#include <occusg/StoreyFreeSpace.h>
#include <ros/single_subscriber_publisher.h>

#include <boost/make_shared.hpp>
#include <string>

#include "occusg_ros/gap_conversions.hpp"
#include "occusg_ros/grid_conversions.hpp"
#include "occusg_ros/storey_conversions.hpp"

namespace occusg_ros {
namespace {

/// More than a building has storeys.
constexpr std::uint32_t kLayersQueue = 200;

}  // namespace

StoreyPublisher::StoreyPublisher(const ros::NodeHandle& node_handle, occusg::Storeys storeys)
    : node_handle_(node_handle), storeys_(storeys) {
  layers_publisher_ = node_handle_.advertise<occusg::StoreyFreeSpace>(
      "storey_layers", kLayersQueue,
      [this](const ros::SingleSubscriberPublisher&) { has_new_subscriber_ = true; });
}

void StoreyPublisher::send(occusg::MapPipeline& map, const std_msgs::Header& header) {
  const occusg::Building& building = map.building();
  if (building.storeys.size() < 2) {
    if (storeys_ == occusg::Storeys::kOne && has_new_subscriber_.exchange(false))
      sendLayer(map, 0, header);
    return;
  }
  while (grid_publishers_.size() < building.storeys.size()) {
    const std::string topic = "free_space/" + std::to_string(grid_publishers_.size());
    grid_publishers_.push_back(node_handle_.advertise<nav_msgs::OccupancyGrid>(topic, 1, true));
  }
  const bool all = has_new_subscriber_.exchange(false);
  for (std::size_t storey = 0; storey < building.storeys.size(); ++storey) {
    const occusg::LayerChange change = map.takeChange(storey);
    const bool is_changed = !change.cells.empty() || !change.gaps.empty();
    if (all || is_changed || storey == building.current) sendLayer(map, storey, header);
  }
}

void StoreyPublisher::forget(const occusg::MapPipeline& map, const std_msgs::Header& header) {
  const bool is_awaited = !grid_publishers_.empty() || storeys_ == occusg::Storeys::kOne;
  grid_publishers_.clear();
  if (is_awaited && map.building().storeys.size() < 2) sendLayer(map, 0, header);
  has_new_subscriber_ = true;
}

void StoreyPublisher::sendLayer(const occusg::MapPipeline& map, std::size_t storey,
                                const std_msgs::Header& header) {
  const auto layer = boost::make_shared<occusg::StoreyFreeSpace>();
  layer->header = header;
  layer->floor_id = static_cast<std::int32_t>(storey);
  layer->building = toStoreyArray(map.building(), header);
  layer->grid = toDecidedGrid(toGridMsg(map.freeSpace(storey), header));
  layer->gaps = toGapsMsg(map.freeSpace(storey), header);
  layer->grid.info.origin.position.z = map.building().storeys[storey].floor_z_m;
  if (storey < grid_publishers_.size()) grid_publishers_[storey].publish(layer->grid);
  layers_publisher_.publish(layer);
}

}  // namespace occusg_ros
