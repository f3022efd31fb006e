// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iomanip>
#include <ios>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "occusg/graph/graph_builder.hpp"
#include "occusg/graph/scene_graph.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg::testing {

inline Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

inline Region regionFrom(int id, Polygon polygon) {
  Region region;
  region.id = id;
  region.area_m2 = area(polygon);
  region.centroid = centroid(polygon);
  region.polygon = std::move(polygon);
  return region;
}

/// The square [x, x + side] x [0, side].
inline Region squareAt(int id, double x, double side = 4.0) {
  return regionFrom(id, rectangle(x, 0.0, x + side, side));
}

inline TrackedRegions tracked(std::vector<Region> regions, std::vector<int> missed = {},
                              std::vector<Crossing> crossings = {}) {
  TrackedRegions result;
  result.decomposition.regions = std::move(regions);
  result.decomposition.crossings = std::move(crossings);
  result.missed = std::move(missed);
  return result;
}

inline TrackedRegions stale(TrackedRegions regions) {
  regions.stale = true;
  return regions;
}

inline Pose poseAt(double x, double y, double z = 1.0) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

/// The published behaviour: any entity is evidence, and a room goes with its track.
inline GraphBuilderConfig paperGraph() {
  GraphBuilderConfig config;
  config.rooms.promotion = PromotionEvidence::kAnyEntity;
  config.rooms.removal_grace_s = 0.0;
  return config;
}

inline std::vector<NodeId> idsOf(const SceneGraph& graph, NodeType type) {
  std::vector<NodeId> ids;
  for (const auto& [id, node] : graph.nodes(type)) ids.push_back(id);
  return ids;
}

inline std::vector<NodeId> roomsOf(const SceneGraph& graph) {
  return idsOf(graph, NodeType::kRoom);
}

/// The room anchored to a region; -1 when there is none.
inline NodeId roomOnRegion(const SceneGraph& graph, int region) {
  for (const NodeId id : roomsOf(graph))
    if (graph.room(id).region_id == region) return id;
  return -1;
}

/// Every value of the graph as text: equal graphs, equal texts.
inline std::string describe(const SceneGraph& graph) {
  std::ostringstream text;
  text << std::hexfloat;
  for (const NodeType type : {NodeType::kAgent, NodeType::kObject, NodeType::kNavigation,
                              NodeType::kRoom, NodeType::kDoor}) {
    for (const auto& [id, node] : graph.nodes(type)) {
      text << nameOf(type) << ' ' << id << ' ' << node.position.transpose() << ' ' << node.created_s
           << ' ' << node.last_seen_s << ' ' << node.floor_id;
      if (const auto* room = std::get_if<RoomAttributes>(&node.attributes)) {
        text << ' ' << room->name << ' ' << room->region_id << ' ' << room->area_m2 << ' '
             << static_cast<int>(room->reason) << ' ' << room->label << ' '
             << room->unsupported_since_s.value_or(-1.0);
        for (const Point2& vertex : room->polygon.outer)
          text << " (" << vertex.x << ' ' << vertex.y;
        for (const Ring& hole : room->polygon.holes)
          for (const Point2& vertex : hole) text << " [" << vertex.x << ' ' << vertex.y;
      }
      text << '\n';
    }
  }
  for (const EdgeType type : {EdgeType::kTemporal, EdgeType::kContains, EdgeType::kTraversable,
                              EdgeType::kNearestFreeSpace, EdgeType::kRoomAdjacency}) {
    for (const auto& [ends, edge] : graph.edges(type)) {
      text << nameOf(type) << ' ' << ends.first << ' ' << ends.second;
      for (const Segment2& segment : edge.crossings)
        text << ' ' << segment.a.x << ' ' << segment.a.y << ' ' << segment.b.x << ' '
             << segment.b.y;
      text << '\n';
    }
  }
  return text.str();
}

}  // namespace occusg::testing
