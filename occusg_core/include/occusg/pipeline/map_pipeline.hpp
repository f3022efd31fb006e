// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/perception/depth_frame.hpp"
#include "occusg/perception/depth_projector.hpp"
#include "occusg/pipeline/config.hpp"
#include "occusg/pipeline/frame_report.hpp"
#include "occusg/pipeline/stage_times.hpp"

namespace occusg {

/// What the frames so far brought.
struct MapCounts {
  std::size_t frames = 0;
  std::size_t points = 0;
  PixelDrops pixel_drops;
  std::size_t points_outside_map = 0;
  std::size_t frames_outside_map = 0;
  std::size_t frames_without_depth = 0;   ///< Not one pixel had a depth.
  std::size_t frames_from_occupied = 0;   ///< The camera was in an occupied voxel.
  std::size_t frames_without_memory = 0;  ///< The map had reached its limit.
  std::size_t frames_too_fast = 0;        ///< Their pose jumped, `PoseGate`.
  std::size_t frames_beyond_span = 0;     ///< The free-space layer cannot span so much.

  /// Frames whose pose cannot be; they left nothing behind.
  [[nodiscard]] std::size_t framesMisplaced() const {
    return frames_outside_map + frames_too_fast + frames_beyond_span;
  }
};

/// Depth frames -> occupancy map and free space: the half of the pipeline that needs a camera.
class MapPipeline {
 public:
  /// @throws Error when the configuration breaks a rule.
  explicit MapPipeline(const PipelineConfig& config);

  /// Continues from a saved map. In the layer, `changed` is what differs from before.
  /// @throws Error when the map is larger than the layer can be; the state is then as before.
  const FreeSpace& startFrom(OccupancyMap map);

  /// Takes one frame into the map.
  /// @return what became of it; `freeSpace()` has the layer that follows.
  /// @throws Error when the frame itself cannot be used; the state is then as before the call.
  FrameReport process(const DepthFrame& frame);

  [[nodiscard]] const OccupancyMap& occupancyMap() const { return occupancy_; }
  [[nodiscard]] const FreeSpace& freeSpace() const { return free_space_.freeSpace(); }
  [[nodiscard]] const MapCounts& counts() const { return counts_; }
  /// Durations so far, and the memory each stage's result holds now; walks the results.
  [[nodiscard]] StageTimes times() const;
  /// Durations so far.
  [[nodiscard]] const StageTimes& durations() const { return times_; }

 private:
  [[nodiscard]] bool staysInSpan(const Point3f& origin) const;
  /// @param change what the map made of the frame, where it was asked.
  [[nodiscard]] FrameVerdict insert(const RangeImage& image, double stamp_s, MapChange& change);
  void count(const FrameReport& report);

  DepthProjector projector_;
  PoseGate gate_;
  OccupancyMap occupancy_;
  FreeSpaceLayer free_space_;
  MapCounts counts_;
  StageTimes times_;
};

}  // namespace occusg
