// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "graph/adjacency_layer.hpp"
#include "graph/entity_assignment.hpp"
#include "graph/region_snapshot.hpp"
#include "graph/relinking.hpp"
#include "occusg/graph/graph_config.hpp"
#include "occusg/graph/graph_state.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

enum class Maintenance { kNotDue, kDue };

/// Anchors rooms to tracked regions, one to one (paper, Sec. 3.3), and entities to rooms.
///
/// One update is one sequence: lost rooms move to the successors of their regions; the robot's
/// region gets a room or refreshes the one it has; and, when maintenance is due, all footprints are
/// refreshed, unowned regions with evidence become rooms, and rooms without a region go. Because
/// succession comes first, the room the robot is in keeps its id. A stale or empty update changes
/// no room. Only rooms and entities the update touches are looked at.
class RoomLayer {
 public:
  explicit RoomLayer(const RoomLayerConfig& config);

  /// @param robot where the robot is, in the ground plane; none: on another storey.
  void update(SceneGraph& graph, const TrackedRegions& tracked, const std::optional<Point2>& robot,
              double stamp_s, Maintenance maintenance);

  /// Maintenance after the last update: what waits for time to pass is decided now. With
  /// PromotionEvidence::kObservedArea regions become rooms even if none ever held the robot.
  void finish(SceneGraph& graph, double stamp_s);

  [[nodiscard]] RoomLayerState state() const { return {first_seen_s_, former_room_of_region_}; }
  /// Goes on with the rooms of `graph`.
  void restore(const SceneGraph& graph, const RoomLayerState& state);

  [[nodiscard]] std::optional<NodeId> currentRoom() const { return current_room_; }
  [[nodiscard]] const EntityAssignment& assignment() const { return assignment_; }

 private:
  /// Whether the age of a region and the grace of a room still count.
  enum class Decisions { kWait, kNow };

  [[nodiscard]] std::optional<NodeId> ownerOf(int region) const;
  [[nodiscard]] std::vector<LostRoom> lostRooms(const SceneGraph& graph) const;
  [[nodiscard]] std::vector<const Region*> unownedRegionsNear(
      const std::vector<LostRoom>& lost) const;
  [[nodiscard]] bool deservesRoom(const Region& region, double stamp_s, Decisions decisions) const;

  void noteSupport(SceneGraph& graph, double stamp_s);
  void dropForgottenRegions();
  void returnToFormerRegions(SceneGraph& graph, double stamp_s);
  void moveToSuccessors(SceneGraph& graph, double stamp_s);
  void followRobot(SceneGraph& graph, const std::optional<Point2>& robot, double stamp_s);

  void maintain(SceneGraph& graph, double stamp_s, Decisions decisions);
  void promote(SceneGraph& graph, double stamp_s, Decisions decisions);
  void prune(SceneGraph& graph, double stamp_s, Decisions decisions);
  void syncContainment(SceneGraph& graph);
  void syncEntity(SceneGraph& graph, NodeId entity) const;

  void createRoom(SceneGraph& graph, int region, RoomReason reason, double stamp_s);
  void moveRoom(SceneGraph& graph, NodeId room, int region, double stamp_s);
  void refreshRoom(SceneGraph& graph, NodeId room, double stamp_s);
  void noteRoom(NodeId room);
  void removeRoom(SceneGraph& graph, NodeId room);

  RoomLayerConfig config_;
  RegionSnapshot snapshot_;
  EntityAssignment assignment_;
  AdjacencyLayer adjacency_;
  std::map<int, NodeId> room_of_region_;  ///< Regions that are missing included.
  /// Rooms that moved away from a region the tracker may still bring back.
  std::map<int, NodeId> former_room_of_region_;
  std::map<int, double> first_seen_s_;  ///< By region.
  std::set<int> restored_regions_;      ///< Known to a saved state, not yet seen again or missed.
  std::set<int> unowned_regions_;       ///< There, and no room stands on them.
  std::set<int> absent_regions_;        ///< Known once, missing now.
  std::set<int> changed_footprints_;    ///< Regions that changed since their room was refreshed.
  std::set<NodeId> lost_rooms_;         ///< Those whose region is missing.
  std::set<NodeId> changed_rooms_;      ///< Those whose members must be looked at.
  std::optional<int> current_region_;
  std::optional<NodeId> current_room_;
};

}  // namespace occusg
