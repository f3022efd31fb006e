// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg/regions/decomposer.hpp"

namespace occusg {

class ConstrictionDivision;

/// What becomes of the floor under a small obstacle island.
enum class IslandFootprint {
  kFillInsideOneRegion,  ///< Belongs to the region that surrounds it, as annotated rooms have it.
  kLeaveOut,             ///< A hole in the region.
};

/// What counts as a constriction between two rooms.
struct ConstrictionDecomposerConfig {
  /// Two neighbouring basins stay apart only where the passage between them is narrower [m] ...
  double widest_door_m = 2.5;
  /// ... and narrower than this share of the shallower basin's largest free circle, in (0, 1] ...
  double shallowest_basin_ratio = 0.75;
  /// ... or, if not, where both sides measure this many times the passage's width, 1 or more,
  double door_widening = 1.3;
  /// within this distance of it [m]: both faces of a wall, not a wall that gradually leaves.
  double door_reach_m = 0.2;
  /// A region is a niche of its neighbour when the passage is wider than this times the side of a
  /// square of the region's area, unless both sides widen as above.
  double max_opening_ratio = 0.55;
  /// A region in which no free circle of this diameter fits is dropped [m].
  double min_room_width_m = 0.6;
  /// In a layer without column evidence (a 2D map), a region is outside when the share of wall in
  /// its border is below this times the usual share in the map, in [0, 1]. So is the paper around a
  /// drawn plan. 0: nothing is outside.
  double min_enclosed_share = 0.5;
  double min_region_area_m2 = 1.0;  ///< Smaller regions join their neighbour or are dropped [m2].
  double min_crossing_m = 0.3;      ///< Regions that touch along less are not adjacent [m].
  /// Something overhead from 1.7 m up to this height above the floor is a lintel and separates the
  /// regions on its two sides [m]; 0: lintels do not count.
  double highest_lintel_m = 2.15;
  /// Islands (what is not free but wholly surrounded by free space: a table, its shadow) that
  /// enclose up to this area do not shape basins, unless they are long as walls are [m2].
  double max_filled_obstacle_m2 = 1.0;
  /// A region that surrounds such an island takes its cells; they then carry its label although
  /// they are not free.
  IslandFootprint island_footprint = IslandFootprint::kFillInsideOneRegion;
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(ConstrictionDecomposerConfig& config);

/// Regions as basins of the distance to the nearest obstacle: the watershed of the distance
/// transform, whose neighbouring basins are merged unless the saddle between them is a real
/// narrowing. Neighbours are separated by the straight line from jamb to jamb. Unknown cells bound
/// regions as obstacles do.
class ConstrictionDecomposer final : public Decomposer {
 public:
  /// @throws Error when a parameter is out of range.
  explicit ConstrictionDecomposer(const ConstrictionDecomposerConfig& config);

  ~ConstrictionDecomposer() override;
  ConstrictionDecomposer(const ConstrictionDecomposer&) = delete;
  ConstrictionDecomposer& operator=(const ConstrictionDecomposer&) = delete;
  ConstrictionDecomposer(ConstrictionDecomposer&&) = delete;
  ConstrictionDecomposer& operator=(ConstrictionDecomposer&&) = delete;

  /// A layer without column evidence (a 2D map) is cut anew, in O(cells). Of a layer with evidence
  /// only those parts are cut anew that changed, up to the lintels around them, with the same
  /// result.
  using Decomposer::update;
  const Decomposition& update(const FreeSpace& layer, const CellBox& changed) override;
  void reset() override;
  /// Bytes of what is kept from update to update.
  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  ConstrictionDecomposerConfig config_;
  Decomposition decomposition_;                     ///< Of a layer without evidence.
  std::unique_ptr<ConstrictionDivision> division_;  ///< Of layers with evidence.
  GridFrame frame_;                                 ///< Of the last of these.
  CellBox box_;
  std::uint64_t updates_ = 0;
};

}  // namespace occusg
