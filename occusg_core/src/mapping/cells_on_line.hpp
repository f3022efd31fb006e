// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include "occusg/geometry/cell.hpp"

namespace occusg {

/// Whether `holds(cell)` for every cell that the segment from `a` to `b` touches. A segment that
/// passes through a corner touches the cells on both sides of it. Source: Amanatides and Woo, "A
/// Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987.
/// @param holds a predicate on a `Cell`; called from `a` on, until it is false.
template <typename Predicate>
[[nodiscard]] bool holdsOnLine(const GridFrame& frame, const Point2& a, const Point2& b,
                               const Predicate& holds) {
  Cell cell = frame.cellAt(a);
  const Cell last = frame.cellAt(b);
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const int step_x = dx > 0.0 ? 1 : -1;
  const int step_y = dy > 0.0 ? 1 : -1;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  // Shares of the segment at which the next column and the next row begin, and between two of them.
  const double border_x = frame.corner(cell).x + (dx > 0.0 ? frame.resolution_m : 0.0);
  const double border_y = frame.corner(cell).y + (dy > 0.0 ? frame.resolution_m : 0.0);
  double next_x = dx != 0.0 ? (border_x - a.x) / dx : kNever;
  double next_y = dy != 0.0 ? (border_y - a.y) / dy : kNever;
  const double per_column = dx != 0.0 ? frame.resolution_m / std::abs(dx) : kNever;
  const double per_row = dy != 0.0 ? frame.resolution_m / std::abs(dy) : kNever;
  // Rounding must not make a corner look like an edge.
  constexpr double kSame = 1e-9;
  if (!holds(cell)) return false;
  int steps = std::abs(last.x - cell.x) + std::abs(last.y - cell.y);
  while (steps > 0) {
    const bool at_corner = std::abs(next_x - next_y) <= kSame;
    const bool to_column = at_corner || next_x < next_y;
    const bool to_row = at_corner || !to_column;
    if (at_corner &&
        (!holds(Cell{cell.x + step_x, cell.y}) || !holds(Cell{cell.x, cell.y + step_y})))
      return false;
    if (to_column) {
      cell.x += step_x;
      next_x += per_column;
      --steps;
    }
    if (to_row) {
      cell.y += step_y;
      next_y += per_row;
      --steps;
    }
    if (!holds(cell)) return false;
  }
  return true;
}

}  // namespace occusg
