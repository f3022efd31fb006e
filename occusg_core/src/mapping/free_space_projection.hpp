// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/column_bits.hpp"
#include "mapping/local_floor.hpp"
#include "mapping/voxel_run.hpp"
#include "occusg/geometry/tiled_grid.hpp"
#include "occusg/mapping/free_space_layer.hpp"

namespace occusg {

class VoxelColumns;

/// The work of `FreeSpaceLayer`: what each column shows, and what has to be found anew.
class FreeSpaceProjection {
 public:
  FreeSpaceProjection(const FreeSpaceLayerConfig& config, const GridFrame& frame);

  const FreeSpace& update(const OccupancyMap& map, const MapChange& change);
  const FreeSpace& recompute(const OccupancyMap& map);
  const FreeSpace& confine(const OccupancyMap& map, const HeightSpan& span);
  [[nodiscard]] bool canCover(const CellBox& box) const;
  [[nodiscard]] const FreeSpace& freeSpace() const { return layer_; }
  void reset();
  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  struct Reading;

  struct ColumnState {
    VoxelRun lowest_free;  ///< Lowest free run long enough; empty when there is none.
    bool queued = false;   ///< In `queue_`.
    friend bool operator==(const ColumnState& a, const ColumnState& b) {
      return a.lowest_free == b.lowest_free;
    }
  };

  void checkResolution(const OccupancyMap& map) const;
  void cover(const CellBox& known_columns);
  /// Finds everything anew in `columns`.
  const FreeSpace& rebuild(const VoxelColumns& columns);
  /// The column as the storey sees it.
  void read(Reading& reading, const Cell& cell) const;
  void apply(const VoxelColumns& columns, const std::vector<Cell>& changed);
  /// @pre `reading` holds the column of `cell`.
  void remeasure(const Reading& reading, const Cell& cell);
  void queue(const Cell& cell);
  void evaluate(Reading& reading, const Cell& cell);
  [[nodiscard]] std::int8_t valueOf(Reading& reading, const Cell& cell) const;
  [[nodiscard]] VoxelRun heightsAt(std::int16_t floor) const;

  FreeSpaceLayerConfig config_;
  int needed_voxels_;              ///< Length of the shortest run that counts.
  VoxelRun heights_;               ///< Voxels between the height limits.
  VoxelRun storey_ = kAllHeights;  ///< Voxels that belong to the storey.
  LocalFloor floors_;
  TiledGrid<ColumnState> columns_;
  std::vector<Cell> queue_;  ///< Cells whose value must be found anew; empty between updates.
  FreeSpace layer_;
};

}  // namespace occusg
