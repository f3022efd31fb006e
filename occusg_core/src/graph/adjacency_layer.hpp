// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "graph/door_layer.hpp"
#include "graph/entity_assignment.hpp"
#include "graph/region_joins.hpp"
#include "graph/region_snapshot.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Adjacency edges between rooms, and their doors: two rooms are adjacent when their regions share
/// a crossing and a traversable edge leads from one region to the other (paper, Sec. 3.4). In a
/// graph without navigation nodes the crossing, a contact of free space, is the evidence. Edges of
/// a room whose region is missing stay until it is back or removed.
class AdjacencyLayer {
 public:
  /// Goes on with the edges and doors of `graph`; its rooms are to be noted.
  void restore(const SceneGraph& graph);

  /// Notes what changed; with each update, after `assignment`.
  void observe(const SceneGraph& graph, const RegionSnapshot& snapshot,
               const EntityAssignment& assignment);
  /// The room is new, stands on another region, or its region went or came back.
  void noteRoom(NodeId room) { changed_rooms_.insert(room); }

  /// Brings the edges and doors of all that changed since the last call up to date.
  /// @param room_of_region owner of each region that has one.
  void apply(SceneGraph& graph, const RegionSnapshot& snapshot,
             const std::map<int, NodeId>& room_of_region, double stamp_s);

 private:
  using RoomPair = std::pair<NodeId, NodeId>;

  void noteContacts(const RegionSnapshot& snapshot);
  [[nodiscard]] std::set<RoomPair> affectedRooms(const SceneGraph& graph,
                                                 const std::map<int, NodeId>& room_of_region) const;
  [[nodiscard]] std::vector<Segment2> supportedCrossings(const SceneGraph& graph,
                                                         const RegionSnapshot& snapshot,
                                                         const RoomPair& rooms) const;

  RegionJoins joins_;
  DoorLayer doors_;
  std::map<int, std::set<int>> partners_;  ///< Regions each region shares a crossing with.
  std::set<RegionPair> changed_regions_;
  std::set<NodeId> changed_rooms_;
  bool has_navigation_ = false;
};

}  // namespace occusg
