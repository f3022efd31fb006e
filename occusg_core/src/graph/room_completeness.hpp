// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include "occusg/graph/scene_graph.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// Share of the polygon's boundary that is frontier, 0..1: just outside of it the layer knows
/// neither free space nor, within three cells, an obstacle.
[[nodiscard]] double frontierShare(const Polygon& polygon, const FreeSpace& layer);

/// Tells rooms that have been seen from those seen only in part. A room is confirmed once its
/// frontier share is small enough, and stays so.
class RoomCompleteness {
 public:
  /// @param max_frontier_share of a confirmed room; 1: all are.
  explicit RoomCompleteness(double max_frontier_share);

  /// Goes on with the rooms of `graph`: those confirmed stay so.
  void restore(const SceneGraph& graph);

  /// Looks at the rooms that changed and at those the changed cells touch. Always to be called with
  /// the same graph.
  void update(SceneGraph& graph, const FreeSpace& layer, const CellBox& changed);

 private:
  void judge(SceneGraph& graph, NodeId room, const FreeSpace& layer);

  double max_frontier_share_;
  std::set<NodeId> confirmed_;
  Revision revision_ = 0;
};

}  // namespace occusg
