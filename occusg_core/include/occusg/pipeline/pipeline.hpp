// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "occusg/perception/depth_frame.hpp"
#include "occusg/perception/detection_builder.hpp"
#include "occusg/pipeline/config.hpp"
#include "occusg/pipeline/frame_report.hpp"
#include "occusg/pipeline/map_pipeline.hpp"
#include "occusg/pipeline/room_pipeline.hpp"
#include "occusg/pipeline/stage_times.hpp"

namespace occusg {

/// A saved session.
struct Session {
  std::optional<OccupancyMap> map;  ///< None when it was saved without one.
  SessionState state;
};

/// What the frames so far brought.
struct PipelineCounts : MapCounts, RoomCounts {
  RefusedMasks refused_masks;  ///< Instances that gave no detection.
};

/// Composes the stages, with the two halves of the pipeline on one clock. Logical time: it is
/// driven by the stamps of its frames, so equal recordings give equal results.
///
///     Pipeline pipeline(loadConfig("default"));
///     for (const DepthFrame& frame : frames) {
///       const FrameReport report = pipeline.process(frame);
///       if (!report.isUsed()) std::cerr << sentenceOn(report.verdict) << '\n';
///     }
///     pipeline.finish();
///     for (const auto& [id, room] : pipeline.graph().nodes(NodeType::kRoom)) ...
class Pipeline {
 public:
  /// @param decomposer cuts free space into regions; none: the one `config` names.
  /// @throws Error when the configuration breaks a rule.
  explicit Pipeline(const PipelineConfig& config, std::unique_ptr<Decomposer> decomposer = nullptr);

  /// Continues from a saved map; to be called before the first frame.
  /// @throws Error when there was a frame, or the map is larger than the free-space layer can be;
  /// the state is then as before the call.
  void startFrom(OccupancyMap map);

  /// Goes on where a saved session ended, with the same ids; before the first frame. Frames must be
  /// younger than the session's last.
  /// @throws Error as `startFrom`, or when the session has no map.
  void resume(Session session);
  /// What to save beside `occupancyMap()` so that another pipeline can continue from here; to be
  /// taken before `finish`, which decides what only an end decides.
  /// @throws Error when there was no frame.
  [[nodiscard]] SessionState sessionState(const std::string& scene) const;

  /// Takes one frame through the stages: cloud, occupancy and free space always; regions and graph
  /// when `region_period_s` has passed. A frame whose pose jumped or lies outside the map is
  /// counted and leaves nothing.
  /// @return what became of the frame.
  /// @throws Error when the frame cannot be used or is not younger than the one before; the state
  /// is then as before the call.
  FrameReport process(const DepthFrame& frame);
  /// The same with the objects seen in an image of the same view; they join the scene graph.
  /// @throws Error as above, or when the masks' image does not fit the depth image.
  FrameReport process(const DepthFrame& frame, const InstanceMasks& masks);

  /// Gives a room a label that stays; an empty one returns to the automatic label.
  /// @throws Error when there is no such room or the label cannot be one.
  void setRoomLabel(NodeId room, const std::string& label) { rooms_.setRoomLabel(room, label); }

  /// Brings regions and rooms up to date with the last frame. Call once, at the end.
  void finish();

  [[nodiscard]] const PipelineConfig& config() const { return config_; }
  [[nodiscard]] const OccupancyMap& occupancyMap() const { return map_.occupancyMap(); }
  [[nodiscard]] const FreeSpace& freeSpace() const { return map_.freeSpace(); }
  [[nodiscard]] const TrackedRegions& regions() const { return rooms_.regions(); }
  [[nodiscard]] const SceneGraph& graph() const { return rooms_.graph(); }
  [[nodiscard]] PipelineCounts counts() const {
    return {map_.counts(), rooms_.counts(), refused_masks_};
  }
  /// Durations so far, and the memory each stage's result holds now.
  [[nodiscard]] StageTimes times() const;

 private:
  void checkStamp(const DepthFrame& frame) const;
  FrameReport takeIn(const DepthFrame& frame, const DetectionResult& objects);
  [[nodiscard]] MapView mapView(const CellBox& changed, const CellBox& gaps_changed) const;
  void updateRooms(const Pose& T_map_camera, double stamp_s);
  [[nodiscard]] bool roomsAreDue(double stamp_s) const;

  PipelineConfig config_;
  DetectionBuilder detection_builder_;
  MapPipeline map_;
  RoomPipeline rooms_;

  CellBox changed_since_rooms_;       ///< Free-space cells `rooms_` has not seen yet.
  CellBox gaps_changed_since_rooms_;  ///< Cells whose gap it has not seen yet.
  std::optional<double> last_stamp_s_;
  Pose last_pose_ = Pose::Identity();
  RefusedMasks refused_masks_;
  StageTimes totals_;  ///< Of whole frames.
};

}  // namespace occusg
