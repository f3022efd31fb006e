// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <occusg/StairsInfo.h>
#include <occusg/StoreyArray.h>
#include <std_msgs/Header.h>

#include <string>
#include <vector>

#include "occusg/graph/scene_graph.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg_ros {

/// The storeys of a building and the ways between them, as far as no graph names their rooms.
[[nodiscard]] occusg::StoreyArray toStoreyArray(const occusg::Building& building,
                                                const std_msgs::Header& header);

/// @param where opens every sentence; the topic.
/// @throws occusg::Error when there is no storey, a storey is named that is not there, or a number
/// is not finite.
[[nodiscard]] occusg::Building toBuilding(const occusg::StoreyArray& msg, const std::string& where);

/// @param stairs a node of that type of the graph.
[[nodiscard]] occusg::StairsInfo toStairsMsg(const occusg::SceneGraph& graph,
                                             occusg::NodeId stairs);
/// All stairs of a graph, by id.
[[nodiscard]] std::vector<occusg::StairsInfo> toStairsMsgs(const occusg::SceneGraph& graph);

}  // namespace occusg_ros
