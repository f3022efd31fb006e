// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// Where one can be, and how far the nearest obstacle is. All grids cover the free cells' bounds
/// and one ring of closed cells around them, so that every open cell has eight neighbours; they are
/// empty when nothing is free.
struct Clearance {
  Grid<std::uint8_t> open;     ///< 1: free, or part of a filled island.
  Grid<std::int32_t> islands;  ///< Number of the filled island a cell belongs to, else 0.
  Grid<std::int32_t> squared;  ///< Squared distance to the nearest closed cell [cells2]; 0: closed.
  std::int32_t island_count = 0;
};

/// Free space with its small islands filled and its exact Euclidean distances. An island is an
/// 8-connected set of cells that are not free, with all it encloses, surrounded by free space; it
/// is filled when it encloses at most `max_island_cells` and is not longer than three times the
/// side of a square of the area it encloses: a table is filled, a free-standing wall is not.
[[nodiscard]] Clearance clearanceOf(const Grid<std::int8_t>& layer, std::size_t max_island_cells);

}  // namespace occusg
