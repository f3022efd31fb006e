// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/graph/graph_builder.hpp"
#include "occusg/graph/graph_state.hpp"
#include "occusg/mapping/free_space.hpp"
#include "occusg/pipeline/config.hpp"
#include "occusg/pipeline/stage_times.hpp"
#include "occusg/regions/decomposer.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg {

/// What the rooms of one storey follow from besides the map, and cannot be computed from it again.
/// The free-space layer and the decomposition follow from the map.
struct RoomPipelineState {
  std::optional<double> last_room_update_s;  ///< When regions and rooms were updated last.
  RegionTrackerState tracker;
  GraphBuilderState graph;
};

/// What the layers so far brought.
struct RoomCounts {
  std::size_t region_updates = 0;
  std::size_t rejected_region_updates = 0;  ///< By the acceptance guard.
  ObjectCounts objects;
  std::size_t room_id_switches = 0;  ///< Confirmed rooms that lost their id to another.
};

/// Free space and robot poses -> regions, rooms, scene graph: the half of the pipeline that a robot
/// with a finished 2D map uses alone. Logical time: it is driven by the stamps it is given.
class RoomPipeline {
 public:
  /// @param decomposer cuts free space into regions; none: the one `config` names.
  /// @throws Error when the configuration breaks a rule.
  explicit RoomPipeline(const PipelineConfig& config,
                        std::unique_ptr<Decomposer> decomposer = nullptr);

  /// Brings regions and rooms up to date with `layer`.
  /// @param changed bounds of the cells that differ from the previous call's layer.
  /// @throws Error when the pose or the stamp is not finite.
  const SceneGraph& update(const FreeSpace& layer, const CellBox& changed, const Pose& T_map_robot,
                           double stamp_s);
  /// The same with the 3D map the layer is from, which shows the objects that are gone.
  const SceneGraph& update(const MapView& map, const Pose& T_map_robot, double stamp_s);

  /// The same while the robot is on another storey.
  const SceneGraph& updateUnattended(const MapView& map, double stamp_s);

  /// The nodes that come get ids beyond those of `other`, so that both can be put into one graph.
  void skipIdsOf(const SceneGraph& other);

  /// Detections of a frame, between two updates; what cannot be used is left out and counted.
  /// @throws Error when the stamp is not finite.
  void observeObjects(const std::vector<Detection>& detections, double stamp_s);

  /// Gives a room a label that stays; an empty one returns to the automatic label.
  /// @throws Error when there is no such room or the label cannot be one.
  void setRoomLabel(NodeId room, const std::string& label) { graph_.setRoomLabel(room, label); }

  /// A pose between two updates: may become an agent.
  /// @throws Error when the pose or the stamp is not finite.
  void observePose(const Pose& T_map_robot, double stamp_s);

  /// Follows the robot and maintains the rooms between two updates, with the regions as they are:
  /// for a map that does not change any more while time passes. Nothing before the first update.
  /// @throws Error when the pose or the stamp is not finite.
  void maintain(const Pose& T_map_robot, double stamp_s);

  /// The same while the robot is on another storey.
  /// @throws Error when the stamp is not finite.
  void maintainUnattended(const FreeSpace& layer, double stamp_s);

  /// Maintains the rooms a last time, when no later update can confirm or refute anything.
  /// @throws Error when the stamp is not finite.
  void finish(double stamp_s);
  void finish(double stamp_s, const MapView& map);

  [[nodiscard]] RoomPipelineState state() const;
  /// Goes on where another one was; regions follow from the next layer.
  /// @param stamp_s of the last pose it saw.
  void resumeFrom(const RoomPipelineState& state, double stamp_s);

  [[nodiscard]] const TrackedRegions& regions() const { return tracker_.regions(); }
  [[nodiscard]] const SceneGraph& graph() const { return graph_.graph(); }
  [[nodiscard]] std::optional<NodeId> currentRoom() const { return graph_.currentRoom(); }
  [[nodiscard]] std::optional<double> lastUpdate() const { return last_update_s_; }
  [[nodiscard]] RoomCounts counts() const;
  /// Durations so far, and the memory each stage's result holds now; walks the results.
  [[nodiscard]] StageTimes times() const;
  /// Durations so far.
  [[nodiscard]] const StageTimes& durations() const { return times_; }

 private:
  const TrackedRegions& track(const MapView& map);
  void count(const TrackedRegions& tracked, double stamp_s);

  std::unique_ptr<Decomposer> decomposer_;
  RegionTracker tracker_;
  GraphBuilder graph_;
  std::optional<double> last_update_s_;
  RoomCounts counts_;
  StageTimes times_;
};

}  // namespace occusg
