// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

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

class StoreyFinder;

/// Whether a building may have more than one free-space layer.
enum class Storeys {
  kOne,   ///< One layer, whatever heights the camera gets to.
  kFound  ///< A layer for every storey that the camera reached.
};

/// What differs in a storey's layer since it was asked for the last time.
struct LayerChange {
  CellBox cells;  ///< Bounds of the cells with another value.
  CellBox gaps;   ///< Bounds of the cells with another gap.
};

/// Depth frames -> occupancy map and free space: the half of the pipeline that needs a camera.
class MapPipeline {
 public:
  /// @throws Error when the configuration breaks a rule.
  explicit MapPipeline(const PipelineConfig& config, Storeys storeys = Storeys::kOne);

  /// Continues from a saved map. In the layers, `changed` is what differs from before.
  /// @param building what was known of its storeys; without any they are found anew.
  /// @throws Error when the map is larger than the layer can be; the state is then as before.
  const FreeSpace& startFrom(OccupancyMap map, const Building& building = {});

  /// Takes one frame into the map.
  /// @return what became of it; `freeSpace()` has the layer that follows.
  /// @throws Error when the frame itself cannot be used; the state is then as before the call.
  FrameReport process(const DepthFrame& frame);

  [[nodiscard]] const OccupancyMap& occupancyMap() const { return occupancy_; }
  /// The layer of the storey the camera is on.
  [[nodiscard]] const FreeSpace& freeSpace() const { return freeSpace(building_.current); }

  /// The storeys the camera reached, and the ways it took; the first storey is there from the
  /// beginning. On stairs, the current storey is the one the camera comes from.
  [[nodiscard]] const Building& building() const { return building_; }
  /// @pre storey < building().storeys.size()
  [[nodiscard]] const FreeSpace& freeSpace(std::size_t storey) const {
    return layers_[storey].freeSpace();
  }
  /// What changed in the storey's layer since the last call.
  /// @pre storey < building().storeys.size()
  [[nodiscard]] LayerChange takeChange(std::size_t storey);

  [[nodiscard]] const MapCounts& counts() const { return counts_; }
  /// Durations so far, and the memory each stage's result holds now; walks the results.
  [[nodiscard]] StageTimes times() const;
  /// Durations so far.
  [[nodiscard]] const StageTimes& durations() const { return times_; }

 private:
  /// Deletes a finder where its type is known.
  struct DeleteFinder {
    void operator()(StoreyFinder* finder) const noexcept;
  };

  [[nodiscard]] bool staysInSpan(const Point3f& origin) const;
  /// @param change what the map made of the frame, where it was asked.
  [[nodiscard]] FrameVerdict insert(const RangeImage& image, double stamp_s, MapChange& change);
  void count(const FrameReport& report);
  void updateLayers(const RangeImage& image, const MapChange& change);
  void followStoreys(const Eigen::Vector3d& position);
  void takeOver(const Building& building);
  [[nodiscard]] std::vector<FreeSpaceLayer> layersOf(const OccupancyMap& map,
                                                     const std::vector<Storey>& storeys) const;
  void note(std::size_t storey);

  DepthProjector projector_;
  PoseGate gate_;
  OccupancyMap occupancy_;
  std::unique_ptr<StoreyFinder, DeleteFinder> finder_;  ///< Null where one layer is asked for.
  Building building_;                                   ///< At least one storey.
  bool has_floor_ = false;                              ///< The first storey's floor was seen.
  std::vector<FreeSpaceLayer> layers_;                  ///< By storey.
  std::vector<LayerChange> changes_;                    ///< By storey, not yet taken.
  FreeSpaceLayerConfig layer_config_;
  MapCounts counts_;
  StageTimes times_;
};

}  // namespace occusg
