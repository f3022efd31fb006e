// SPDX-License-Identifier: BSD-3-Clause
// The three nodes as the plugins nodelet_plugins.xml names.
#include <pluginlib/class_list_macros.hpp>

#include "mapping_node.hpp"
#include "nodelet_of.hpp"
#include "scene_graph_node.hpp"
#include "semantics_node.hpp"

namespace occusg_ros {

using MappingNodelet = NodeletOf<MappingNode>;
using SceneGraphNodelet = NodeletOf<SceneGraphNode>;
using SemanticsNodelet = NodeletOf<SemanticsNode>;

}  // namespace occusg_ros

PLUGINLIB_EXPORT_CLASS(occusg_ros::MappingNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(occusg_ros::SceneGraphNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(occusg_ros::SemanticsNodelet, nodelet::Nodelet)
