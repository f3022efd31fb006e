// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "occusg/graph/scene_graph.hpp"
#include "occusg_ros/graph_conversions.hpp"

namespace occusg_ros {

/// Where the layers of the graph float and what of it is drawn.
struct MarkerLayout {
  double room_height_m = 4.0;        ///< Of room nodes above their floor [m].
  double object_height_m = 0.0;      ///< Of objects above where they are [m].
  double navigation_height_m = 0.1;  ///< Of navigation nodes above where they are [m].
  double room_opacity = 0.8;         ///< Of the coloured floor of a room, 0..1.
  bool show_regions = false;
  bool show_containment = true;
};

/// A graph as it is drawn, by namespace and id. Namespaces: room_floors, room_outlines, rooms,
/// room_labels, room_stems, adjacency, doors, objects, object_labels, navigation, navigation_edges,
/// containment, trajectory, stairs, regions. Ids are those of the nodes and regions, so a marker
/// keeps its id and a room its colour as long as they exist.
using MarkerSet = std::map<std::pair<std::string, std::int32_t>, visualization_msgs::Marker>;

/// @param storeys of the building. Where there are several, the nodes of rooms stay below the floor
/// above them, whatever height the layout gives them.
[[nodiscard]] MarkerSet drawGraph(const occusg::SceneGraph& graph,
                                  const std::vector<StoreyRegions>& storeys,
                                  const MarkerLayout& layout, const std_msgs::Header& header);

/// What leads from `shown` to `wanted`: ADD for markers that are new or look different, DELETE for
/// those that vanished.
[[nodiscard]] visualization_msgs::MarkerArray markerChanges(const MarkerSet& shown,
                                                            const MarkerSet& wanted);

/// All of a set, for a new subscriber.
[[nodiscard]] visualization_msgs::MarkerArray allMarkers(const MarkerSet& set);

}  // namespace occusg_ros
