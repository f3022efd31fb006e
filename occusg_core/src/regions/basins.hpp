// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "regions/clearance.hpp"

namespace occusg {

/// Free half-width at a cell of that squared clearance [cells]: the centre of the nearest closed
/// cell lies half a cell behind the wall.
[[nodiscard]] double halfWidth(std::int32_t squared_clearance);

/// When the saddle between two basins is certainly no narrowing.
struct BasinRules {
  double widest_passage_cells = 0.0;  ///< A wider saddle never separates.
  double open_ratio = 1.0;  ///< Nor one of at least this share of the shallower basin's depth.
};

/// The basins of the clearance, flooded from the widest places down: at each cell where two basins
/// meet first, which is their highest saddle, `rules` decide whether they become one. Labels are
/// positive and follow depth: the deepest basin is 1. Closed cells are kNoRegion.
[[nodiscard]] Grid<std::int32_t> basinsOf(const Clearance& clearance, const BasinRules& rules);

}  // namespace occusg
