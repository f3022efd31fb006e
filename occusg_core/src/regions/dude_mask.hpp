// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/cell_outline.hpp"
#include "occusg/mapping/free_space.hpp"
#include "occusg/regions/dude_decomposer.hpp"

namespace occusg {

/// How far a cell's value reaches in the cleaned mask [cells].
[[nodiscard]] int cleaningReach(GridCleaning cleaning);

/// 1 for the cells of `box` that are free space after cleaning. Cells beyond the layer are unknown.
[[nodiscard]] Grid<std::uint8_t> cleanedFreeSpace(const FreeSpaceCells& layer, const CellBox& box,
                                                  GridCleaning cleaning);

/// Cells to be cut into pieces.
struct DudeMask {
  Grid<std::uint8_t> cells;  ///< 1: free; 2: inside an ignored hole; 0: neither.
  /// Of the 4-connected components, ignored holes left out and what they enclose too.
  std::vector<CellOutline> outlines;
  std::vector<CornerRing> ignored_holes;
};

/// Takes the outlines of `cells` and fills the holes no wider than `max_hole_cells` in any
/// direction, which are furniture rather than walls.
/// @param may_fill asked for every cell of such a hole that is not free; one refusal keeps the
/// hole.
[[nodiscard]] DudeMask dudeMask(Grid<std::uint8_t> cells, double max_hole_cells,
                                const std::function<bool(const Cell&)>& may_fill);

}  // namespace occusg
