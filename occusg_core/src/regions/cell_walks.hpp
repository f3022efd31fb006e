// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "occusg/geometry/cell.hpp"

namespace occusg {

/// The four cells that share an edge with `cell`, in row-major order.
[[nodiscard]] inline std::array<Cell, 4> sideNeighbours(const Cell& cell) {
  return {Cell{cell.x, cell.y - 1}, Cell{cell.x - 1, cell.y}, Cell{cell.x + 1, cell.y},
          Cell{cell.x, cell.y + 1}};
}

/// Calls `visit(cell)` for every cell of `box`, in row-major order.
template <typename Visit>
void forEachCell(const CellBox& box, const Visit& visit) {
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) visit(Cell{x, y});
}

}  // namespace occusg
