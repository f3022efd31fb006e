// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "occusg/perception/depth_frame.hpp"
#include "occusg/perception/detection_builder.hpp"
#include "occusg/pipeline/building_pipeline.hpp"
#include "occusg/pipeline/config.hpp"
#include "occusg/pipeline/frame_report.hpp"
#include "occusg/pipeline/map_pipeline.hpp"
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
  /// @param decomposer cuts free space into regions, and keeps the whole building on one layer;
  /// none: the one `config` names, for every storey.
  /// @throws Error when the configuration breaks a rule.
  explicit Pipeline(const PipelineConfig& config, std::unique_ptr<Decomposer> decomposer = nullptr);

  /// Continues from a saved map; to be called before the first frame.
  /// @throws Error when there was a frame, or the map is larger than the free-space layer can be;
  /// the state is then as before the call.
  void startFrom(OccupancyMap map);

  /// Goes on where a saved session ended, with the same ids; before the first frame. Frames must be
  /// younger than the session's last.
  /// @throws Error as `startFrom`, or when the session has no map, or has several storeys and this
  /// pipeline a decomposer of its own.
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
  void setRoomLabel(NodeId room, const std::string& label);

  /// Brings regions and rooms up to date with the last frame. Call once, at the end.
  void finish();

  [[nodiscard]] const PipelineConfig& config() const { return config_; }
  [[nodiscard]] const OccupancyMap& occupancyMap() const { return map_.occupancyMap(); }
  /// Of the storey the camera is on.
  [[nodiscard]] const FreeSpace& freeSpace() const { return map_.freeSpace(); }
  /// Of the storey the camera is on.
  [[nodiscard]] const TrackedRegions& regions() const { return rooms_.regions(); }
  /// Of all storeys.
  [[nodiscard]] const SceneGraph& graph() const { return rooms_.graph(); }
  /// In the order of their ids; `Node::floor_id` names one. At least one.
  [[nodiscard]] const std::vector<Storey>& storeys() const { return map_.building().storeys; }
  /// @param storey index in `storeys()`.
  [[nodiscard]] const FreeSpace& freeSpace(std::size_t storey) const {
    return map_.freeSpace(storey);
  }
  [[nodiscard]] PipelineCounts counts() const;
  /// Durations so far, and the memory each stage's result holds now.
  [[nodiscard]] StageTimes times() const;

 private:
  void checkStamp(const DepthFrame& frame) const;
  FrameReport takeIn(const DepthFrame& frame, const DetectionResult& objects);
  [[nodiscard]] MapView mapView(std::size_t storey, const LayerChange& change) const;
  void updateRooms(const Pose& T_map_camera, double stamp_s);
  [[nodiscard]] bool roomsAreDue(double stamp_s) const;

  PipelineConfig config_;
  Storeys storeys_;
  DetectionBuilder detection_builder_;
  MapPipeline map_;
  BuildingPipeline rooms_;
  std::optional<double> last_room_update_s_;
  std::optional<double> last_stamp_s_;
  Pose last_pose_ = Pose::Identity();
  RefusedMasks refused_masks_;
  StageTimes totals_;  ///< Of whole frames.
};

}  // namespace occusg
