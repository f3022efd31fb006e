// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "occusg/geometry/pose.hpp"
#include "occusg/graph/agent_layer.hpp"
#include "occusg/graph/room_layer.hpp"
#include "occusg/graph/scene_graph.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg {

struct GraphBuilderConfig {
  double maintenance_period_s = 2.0;  ///< Of relinking, promotion and removal (paper: 0.5 Hz) [s].
  AgentLayerConfig agents;
  RoomLayerConfig rooms;
};

/// Everything a builder knows that the next update does not tell it again.
struct GraphBuilderState {
  SceneGraph graph;
  RoomLayerState rooms;
  std::optional<double> last_update_s;
  double last_maintenance_s = 0.0;
};

/// Tracked regions and poses -> scene graph (paper, Sec. 3.3 and 3.4). Time is the stamps it is
/// given: equal calls give equal graphs.
class GraphBuilder {
 public:
  explicit GraphBuilder(const GraphBuilderConfig& config);

  /// Brings the graph up to date with newly tracked regions and the pose they belong to; maintains
  /// the rooms when `maintenance_period_s` has passed since they last were. An update older than
  /// the one before is refused whole and counted.
  /// @throws Error when the pose or the stamp is not finite; the graph stays as it was.
  const SceneGraph& update(const TrackedRegions& tracked, const Pose& T_map_camera, double stamp_s);

  /// A pose between two updates: may become an agent.
  /// @throws Error when the pose or the stamp is not finite.
  void observePose(const Pose& T_map_camera, double stamp_s);

  /// Maintains the rooms a last time, as no later update can confirm or refute anything: neither
  /// the age of a region nor the grace of a room counts any more.
  /// @throws Error when the stamp is not finite.
  const SceneGraph& finish(double stamp_s);

  [[nodiscard]] const SceneGraph& graph() const { return graph_; }
  /// For entities other stages contribute (objects, navigation nodes), between updates. Agents and
  /// rooms belong to the builder.
  [[nodiscard]] SceneGraph& mutableGraph() { return graph_; }

  /// The room the robot was in at the last update.
  [[nodiscard]] std::optional<NodeId> currentRoom() const { return rooms_.currentRoom(); }
  [[nodiscard]] std::size_t posesBackInTime() const { return agents_.posesBackInTime(); }
  [[nodiscard]] std::size_t updatesBackInTime() const { return updates_back_in_time_; }

  [[nodiscard]] GraphBuilderState state() const;
  /// Goes on where another builder was.
  /// @param stamp_s of the last pose it saw.
  void restore(GraphBuilderState state, double stamp_s);
  /// Forgets everything, ids included.
  void reset();

 private:
  GraphBuilderConfig config_;
  SceneGraph graph_;
  AgentLayer agents_;
  RoomLayer rooms_;
  std::optional<double> last_update_s_;
  double last_maintenance_s_ = 0.0;  ///< Once there was an update: the first counts as one.
  std::size_t updates_back_in_time_ = 0;
};

}  // namespace occusg
