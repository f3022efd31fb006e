// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// Takes their label from the regions in which no free circle of that diameter fits: single rays
/// through windows and cracks of doors, into which nobody goes.
/// @param squared distances to the nearest closed cell [cells2].
void removeNarrow(const Grid<std::int32_t>& squared, double min_width_cells,
                  Grid<std::int32_t>& labels);

/// What tells a room from the fan of rays behind a window.
struct EnclosureRules {
  double min_share = 0.5;         ///< Of the share of wall that is usual in the map.
  double wall_reach_cells = 3.0;  ///< A border this near to an obstacle is wall.
};

/// Takes their label from the regions that lie outside the building.
///
/// The border of a room is wall, and crossings to other rooms; that of a fan of rays ends where
/// nothing was seen. So a region goes whose border, crossings left out, has less than `min_share`
/// of the share of wall that is usual in this map (the median over its regions, by area): maps that
/// draw few walls lose nothing. A region that holds most of the grid's rim and leaves room for
/// another goes too: it is the paper around a drawn plan.
void removeOutside(const Grid<std::int8_t>& cells, const EnclosureRules& rules,
                   Grid<std::int32_t>& labels);

}  // namespace occusg
