// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/mapping/free_space.hpp"
#include "occusg/pipeline/config.hpp"
#include "occusg/pipeline/room_pipeline.hpp"
#include "occusg/pipeline/stage_times.hpp"

namespace occusg {

/// Each storey numbers its regions from 1; in the building, so many come between those of one
/// storey and those of the next.
inline constexpr int kRegionsOfAStorey = 10'000'000;

/// What a running system knows besides its occupancy map and cannot compute from it again. The
/// rooms are those of the first storey.
struct SessionState : RoomPipelineState {
  std::string scene;
  double stamp_s = 0.0;                            ///< Of the last frame.
  Pose T_map_agent = Pose::Identity();             ///< Of the last frame.
  Building building;                               ///< Without storeys while no floor was seen.
  std::vector<RoomPipelineState> further_storeys;  ///< From the second on, in the order of ids.
};

/// The rooms of a building: a `RoomPipeline` for each storey, and one scene graph of them all.
/// Logical time: it is driven by the stamps it is given.
///
///     BuildingPipeline rooms(config);
///     rooms.follow(map.building());
///     for (std::size_t storey = 0; storey < rooms.storeyCount(); ++storey)
///       rooms.update(storey, view_of_its_layer, T_map_robot, stamp_s);
///     for (const auto& [id, room] : rooms.graph().nodes(NodeType::kRoom)) ...
class BuildingPipeline {
 public:
  /// @param decomposer cuts the free space of the first storey into regions; none, and for all
  /// other storeys: the one `config` names.
  /// @throws Error when the configuration breaks a rule.
  explicit BuildingPipeline(const PipelineConfig& config,
                            std::unique_ptr<Decomposer> decomposer = nullptr);

  /// What is known of the building by now: storeys that are new get rooms of their own; rooms of
  /// storeys that are gone are gone too.
  void follow(const Building& building);
  [[nodiscard]] const Building& building() const { return building_; }
  [[nodiscard]] std::size_t storeyCount() const { return rooms_.size(); }
  /// Index of the storey between whose slabs the height is; of the current one for a NaN.
  [[nodiscard]] std::size_t storeyAtHeight(double z_m) const;

  /// Brings regions and rooms of a storey up to date with its layer. A storey the robot is not on
  /// rests once its rooms have followed its last change.
  /// @pre storey < storeyCount()
  /// @throws Error when the pose or the stamp is not finite.
  void update(std::size_t storey, const MapView& map, const Pose& T_map_robot, double stamp_s);

  /// Detections of a frame, between two updates; each goes to the storey it lies on.
  /// @throws Error when the stamp is not finite.
  void observeObjects(const std::vector<Detection>& detections, double stamp_s);
  /// A pose between two updates: may become an agent of the current storey.
  /// @throws Error when the pose or the stamp is not finite.
  void observePose(const Pose& T_map_robot, double stamp_s);
  /// Follows the robot and maintains the rooms between two updates, with the regions as they are.
  /// @param layers of the storeys; storeys whose layer is missing or empty are left as they are.
  /// @throws Error when the pose or the stamp is not finite.
  void maintain(const Pose& T_map_robot, double stamp_s, const std::vector<FreeSpace>& layers);
  /// Maintains the rooms of a storey a last time.
  /// @throws Error when the stamp is not finite.
  void finish(std::size_t storey, double stamp_s, const MapView& map);

  /// Gives a room a label that stays; an empty one returns to the automatic label.
  /// @throws Error when there is no such room or the label cannot be one.
  void setRoomLabel(NodeId room, const std::string& label);

  /// Puts what it knows into `state`.
  void saveTo(SessionState& state) const;
  /// Goes on where another one was; regions follow from the next layers.
  void resumeFrom(const SessionState& state);

  /// Of all storeys.
  [[nodiscard]] const SceneGraph& graph() const;
  /// Of the current storey.
  [[nodiscard]] const TrackedRegions& regions() const {
    return rooms_[building_.current].regions();
  }
  /// @pre storey < storeyCount()
  [[nodiscard]] const TrackedRegions& regions(std::size_t storey) const {
    return rooms_[storey].regions();
  }
  /// The room the robot was in at the last update.
  [[nodiscard]] std::optional<NodeId> currentRoom() const {
    return rooms_[building_.current].currentRoom();
  }
  /// When rooms of any storey were updated last.
  [[nodiscard]] std::optional<double> lastUpdate() const;
  [[nodiscard]] RoomCounts counts() const;
  /// Durations so far, and the memory each stage's result holds now; walks the results.
  [[nodiscard]] StageTimes times() const;
  /// Durations so far.
  [[nodiscard]] StageTimes durations() const;

 private:
  void addStoreys(std::size_t count);
  void skipIdsOfOthers(std::size_t storey);
  [[nodiscard]] bool isAtRest(std::size_t storey, double stamp_s) const;

  PipelineConfig config_;
  Building building_;                         ///< At least one storey.
  std::vector<RoomPipeline> rooms_;           ///< By storey.
  std::vector<double> changed_at_s_;          ///< By storey: when its layer changed last.
  mutable std::optional<SceneGraph> merged_;  ///< Of all storeys, while nothing changes.
};

}  // namespace occusg
