// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "occusg/mapping/column_evidence.hpp"
#include "occusg/mapping/free_space.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/parameter.hpp"

namespace occusg {

class FreeSpaceProjection;

/// What the height limits of the layer are measured from.
enum class HeightReference {
  kMap,         ///< Zero of the map frame.
  kLocalFloor,  ///< The floor near the column; where none is known, all heights count.
};

/// What makes a column free or an obstacle.
struct FreeSpaceLayerConfig {
  double min_free_gap_m = 0.30;  ///< Shortest free vertical run that makes a cell free [m].
  int min_obstacle_level = 5;  ///< Cells below this level are unknown rather than obstacle, 0..100.
  /// Only voxels that lie wholly between these heights count [m]. The paper uses all heights.
  double lowest_z_m = -std::numeric_limits<double>::infinity();
  double highest_z_m = std::numeric_limits<double>::infinity();
  HeightReference height_reference = HeightReference::kMap;
  ColumnEvidenceConfig evidence{};
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(FreeSpaceLayerConfig& config);

/// The layer's box is the bounds of all columns with a known voxel, at whatever height, widened to
/// multiples of so many cells: it depends on the map alone, not on the order of updates, and grows
/// in steps.
inline constexpr int kLayerBoxStep_cells = 64;

/// Largest layer [cells]; a map beyond it comes from a pose that jumped rather than from a
/// building.
inline constexpr std::size_t kMaxLayerCells = std::size_t{1} << 26;

/// Collapses the occupancy map into the 2D free-space layer (paper, Sec. 3.2; Fredriksson et al.
/// 2024): a column is free when it has a free run of at least `min_free_gap_m`; a column without
/// one, beside a free column (8 neighbours), is an obstacle to the degree in which it fills that
/// column's lowest such run, 2 * floor(100 * filled / free) up to 100 and the largest over the
/// neighbours; everything else is unknown. Beside these values it carries what is known about each
/// column above the local floor, `ColumnEvidence`.
class FreeSpaceLayer {
 public:
  /// @param frame must have the resolution of the maps given to `update`.
  /// @throws Error naming the field, its value and the allowed range.
  FreeSpaceLayer(const FreeSpaceLayerConfig& config, const GridFrame& frame);
  FreeSpaceLayer(const FreeSpaceLayer& other);
  FreeSpaceLayer& operator=(const FreeSpaceLayer& other);
  FreeSpaceLayer(FreeSpaceLayer&&) noexcept;
  FreeSpaceLayer& operator=(FreeSpaceLayer&&) noexcept;
  ~FreeSpaceLayer();

  /// Recomputes the columns in `change`, those whose local floor moved, and the cells beside them;
  /// afterwards the layer equals `recompute` of the same map, box, cells and evidence, provided
  /// every change of the map was given. Cost follows the change, not the map.
  /// @throws Error when the map has another resolution or spans more than kMaxLayerCells; the layer
  /// is as it was before.
  const FreeSpace& update(const OccupancyMap& map, const MapChange& change);

  /// Recomputes everything from the tree: for a map that was loaded, and as the test oracle.
  const FreeSpace& recompute(const OccupancyMap& map);

  /// From now on shows one storey: voxels beyond `span` do not count, and a column that is free
  /// from the storey down to a fall of at least 0.8 m, as over a stairwell or a hall, is unknown.
  /// @throws Error as `recompute`.
  const FreeSpace& confine(const OccupancyMap& map, const HeightSpan& span);

  /// Whether the layer stays within kMaxLayerCells when columns of `box` become known.
  [[nodiscard]] bool canCover(const CellBox& box) const;

  /// In `changed`, cells the layer did not cover before count as having been unknown.
  [[nodiscard]] const FreeSpace& freeSpace() const;
  void reset();
  /// Memory held for the layer and its evidence [bytes].
  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  std::unique_ptr<FreeSpaceProjection> projection_;
};

}  // namespace occusg
