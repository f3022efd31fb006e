// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "regions/clearance.hpp"

namespace occusg {

/// What limits a side corridor.
struct SideCorridorRules {
  double narrowest_cells = 0.0;  ///< Its least width.
  double widest_cells = 0.0;     ///< Its greatest width.
  std::size_t min_cells = 0;     ///< Its smallest area.
};

/// The regions after those corridors are split off that meet a hall without getting narrower: no
/// saddle of the clearance separates them, because their mouth is as wide as they are
/// (docs/rooms.md, step 7). Labels are numbered anew from 1.
[[nodiscard]] Grid<std::int32_t> withSideCorridorsApart(const Clearance& clearance,
                                                        Grid<std::int32_t> regions,
                                                        const SideCorridorRules& rules);

}  // namespace occusg
