// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "occusg/graph/graph_builder.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/perception/depth_frame.hpp"
#include "occusg/perception/depth_projector.hpp"
#include "occusg/pipeline/config.hpp"
#include "occusg/pipeline/stage_times.hpp"
#include "occusg/regions/decomposer.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg {

/// What the frames so far brought.
struct PipelineCounts {
  std::size_t frames = 0;
  std::size_t points = 0;
  PixelDrops pixel_drops;
  std::size_t points_outside_map = 0;
  std::size_t frames_outside_map = 0;
  std::size_t region_updates = 0;
  std::size_t rejected_region_updates = 0;  ///< By the acceptance guard.
};

/// Composes the stages; the only place that knows them all. Logical time: it is driven by the
/// stamps of its frames, so equal recordings give equal results.
class Pipeline {
 public:
  /// @throws Error when the configuration breaks a rule.
  explicit Pipeline(const PipelineConfig& config);

  /// Goes on from a map that was saved; before the first frame.
  /// @throws Error when there was a frame, or the map is larger than the free-space layer can be;
  /// the state is then as before the call.
  void startFrom(OccupancyMap map);

  /// Takes one frame through the stages: cloud, occupancy and free space always; regions and graph
  /// when `region_period_s` has passed.
  /// @throws Error when the frame cannot be used or is not younger than the one before; the state
  /// is then as before the call.
  void process(const DepthFrame& frame);

  /// Brings regions and rooms up to date with the last frame. Call once, at the end.
  void finish();

  [[nodiscard]] const PipelineConfig& config() const { return config_; }
  [[nodiscard]] const OccupancyMap& occupancyMap() const { return occupancy_; }
  [[nodiscard]] const FreeSpace& freeSpace() const { return free_space_.freeSpace(); }
  [[nodiscard]] const TrackedRegions& regions() const { return tracker_.regions(); }
  [[nodiscard]] const SceneGraph& graph() const { return graph_.graph(); }
  [[nodiscard]] const PipelineCounts& counts() const { return counts_; }
  /// Durations so far, and the memory each stage's result holds now.
  [[nodiscard]] StageTimes times() const;

 private:
  void map(const DepthFrame& frame);
  void updateRegions(const Pose& T_map_camera, double stamp_s);
  [[nodiscard]] bool regionsAreDue(double stamp_s) const;

  PipelineConfig config_;
  DepthProjector projector_;
  OccupancyMap occupancy_;
  FreeSpaceLayer free_space_;
  std::unique_ptr<Decomposer> decomposer_;
  RegionTracker tracker_;
  GraphBuilder graph_;

  CellBox changed_since_regions_;  ///< Free-space cells not yet seen by the decomposer.
  std::optional<double> last_stamp_s_;
  std::optional<double> last_region_stamp_s_;
  Pose last_pose_ = Pose::Identity();
  PipelineCounts counts_;
  StageTimes times_;
};

}  // namespace occusg
