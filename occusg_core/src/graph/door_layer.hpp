// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// A door node at each crossing of adjacent rooms. A door keeps its id while a crossing stays where
/// it is, though the rooms on its sides become others.
class DoorLayer {
 public:
  using RoomPair = std::pair<NodeId, NodeId>;

  /// Goes on with the doors of `graph`.
  void restore(const SceneGraph& graph);

  /// Makes the doors of these pairs those of their adjacency edges; doors of removed rooms go.
  void update(SceneGraph& graph, const std::set<RoomPair>& changed, double stamp_s);

 private:
  /// A crossing that wants a door.
  struct Opening {
    RoomPair rooms;
    Segment2 segment;
  };
  struct Match {
    std::size_t opening = 0;
    NodeId door = 0;
  };

  [[nodiscard]] std::vector<NodeId> doorsAffected(const SceneGraph& graph,
                                                  const std::set<RoomPair>& changed);
  [[nodiscard]] static std::vector<Match> matched(const SceneGraph& graph,
                                                  const std::vector<Opening>& openings,
                                                  const std::vector<NodeId>& doors);
  void remember(NodeId door, const RoomPair& rooms);
  void forget(NodeId door, const RoomPair& rooms);

  std::map<RoomPair, std::set<NodeId>> doors_of_rooms_;
  Revision revision_ = 0;
};

}  // namespace occusg
