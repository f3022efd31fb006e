// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "occusg/regions/constriction_decomposer.hpp"

namespace occusg {

/// Smallest number of cells that cover at least `area_m2`.
[[nodiscard]] std::size_t cellsOf(double area_m2, const GridFrame& frame);

/// Regions of open space before anything is known of doors that lintels close, and of outside.
struct BasinRegions {
  Grid<std::int32_t> labels;   ///< Filled islands carry the label of the region around them.
  Grid<std::int32_t> squared;  ///< Squared distance to the nearest closed cell [cells2].
};

/// Basins of the clearance, joined where no real narrowing separates them, with straight borders
/// (docs/rooms.md, steps 2 to 9). Both grids are empty when no cell is free.
[[nodiscard]] BasinRegions basinRegionsOf(const Grid<std::int8_t>& closed, const GridFrame& frame,
                                          const ConstrictionDecomposerConfig& config);

}  // namespace occusg
