// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/graph/graph_config.hpp"
#include "occusg/graph/graph_state.hpp"
#include "occusg/graph/scene_graph.hpp"
#include "occusg/mapping/free_space.hpp"
#include "occusg/perception/detection.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace octomap {
class OcTree;
}

namespace occusg {

/// What an update may know of the map besides the regions.
struct MapView {
  const FreeSpace* layer = nullptr;  ///< Never null.
  CellBox changed;                   ///< Bounds of the cells that changed since the last update.
  const octomap::OcTree* occupancy = nullptr;  ///< Null: no object is a ghost.
  double max_range_m = 8.0;                    ///< How far the sensor changes the map [m].
  CellBox gaps_changed{};  ///< Bounds of the cells whose gap changed since the last update.
};

/// Tracked regions, poses, detections and free space -> scene graph (paper, Sec. 3.3 and 3.4). Time
/// is the stamps it is given: equal calls give equal graphs. An update touches what changed,
/// however large the graph is.
class GraphBuilder {
 public:
  /// @throws Error naming the first value out of range.
  explicit GraphBuilder(const GraphBuilderConfig& config);
  GraphBuilder(const GraphBuilder&) = delete;
  GraphBuilder& operator=(const GraphBuilder&) = delete;
  GraphBuilder(GraphBuilder&&) noexcept;
  GraphBuilder& operator=(GraphBuilder&&) noexcept;
  ~GraphBuilder();

  /// Brings the graph up to date with newly tracked regions and the pose they belong to; maintains
  /// the rooms when `maintenance_period_s` has passed since they last were. An update older than
  /// the one before is refused whole and counted.
  /// @throws Error when the pose or the stamp is not finite; the graph stays as it was.
  const SceneGraph& update(const TrackedRegions& tracked, const Pose& T_map_agent, double stamp_s);
  /// The same with the map the regions are from: navigation nodes, ghosts and what of the rooms has
  /// been seen follow it.
  const SceneGraph& update(const TrackedRegions& tracked, const Pose& T_map_agent, double stamp_s,
                           const MapView& map);

  /// The same for regions the robot is not in, as those of another storey are: nobody enters a room
  /// and nothing is looked at for ghosts.
  /// @throws Error when the stamp is not finite; the graph stays as it was.
  const SceneGraph& updateUnattended(const TrackedRegions& tracked, double stamp_s,
                                     const MapView& map);

  /// A pose between two updates: may become an agent.
  /// @throws Error when the pose or the stamp is not finite.
  void observePose(const Pose& T_map_agent, double stamp_s);

  /// Detections of a frame, between two updates; what cannot be used is left out and counted.
  /// @throws Error when the stamp is not finite.
  void observeObjects(const std::vector<Detection>& detections, double stamp_s);

  /// Gives a room a label that stays; an empty one returns to the automatic label.
  /// @throws Error as `setLabelByPerson`.
  void setRoomLabel(NodeId room, const std::string& label);

  /// Maintains the rooms a last time, as no later update can confirm or refute anything: neither
  /// the age of a region nor the grace of a room counts any more.
  /// @throws Error when the stamp is not finite.
  const SceneGraph& finish(double stamp_s);
  const SceneGraph& finish(double stamp_s, const MapView& map);

  [[nodiscard]] const SceneGraph& graph() const;
  /// For entities other stages contribute, between updates. What its layers made belongs to the
  /// builder.
  [[nodiscard]] SceneGraph& mutableGraph();

  /// The room the robot was in at the last update.
  [[nodiscard]] std::optional<NodeId> currentRoom() const;
  [[nodiscard]] std::size_t posesBackInTime() const;
  [[nodiscard]] const ObjectCounts& objectCounts() const;
  /// How often a confirmed room lost its id to another.
  [[nodiscard]] std::size_t roomIdSwitches() const;
  [[nodiscard]] std::size_t updatesBackInTime() const;

  [[nodiscard]] GraphBuilderState state() const;
  /// Goes on where another builder was.
  /// @param stamp_s of the last pose it saw.
  void restore(GraphBuilderState state, double stamp_s);
  /// Forgets everything, ids included.
  void reset();

 private:
  struct Parts;

  void maintainFinally(double stamp_s, const MapView* map);
  const SceneGraph& assemble(const TrackedRegions& tracked, const std::optional<Point2>& robot,
                             double stamp_s, const MapView* map);

  std::unique_ptr<Parts> parts_;
};

}  // namespace occusg
