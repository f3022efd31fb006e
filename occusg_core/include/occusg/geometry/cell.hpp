// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// World-aligned cell: covers [x, x+1) * resolution by [y, y+1) * resolution in the map frame.
/// Also used for cell corners, where (x, y) is the lower left corner of the cell of that name.
struct Cell {
  int x = 0;
  int y = 0;
  friend bool operator==(const Cell& a, const Cell& b) { return a.x == b.x && a.y == b.y; }
  friend bool operator!=(const Cell& a, const Cell& b) { return !(a == b); }
  /// Row-major order: by y, then x.
  friend bool operator<(const Cell& a, const Cell& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }
};

/// Half-open box of cells: min inclusive, max exclusive. Default-constructed: empty.
struct CellBox {
  Cell min;
  Cell max;

  [[nodiscard]] bool empty() const { return max.x <= min.x || max.y <= min.y; }
  [[nodiscard]] int width() const { return std::max(0, max.x - min.x); }
  [[nodiscard]] int height() const { return std::max(0, max.y - min.y); }
  [[nodiscard]] bool contains(const Cell& cell) const {
    return cell.x >= min.x && cell.y >= min.y && cell.x < max.x && cell.y < max.y;
  }
  /// Smallest box that holds both this box and `cell`.
  [[nodiscard]] CellBox including(const Cell& cell) const {
    return including(CellBox{cell, {cell.x + 1, cell.y + 1}});
  }
  [[nodiscard]] CellBox including(const CellBox& other) const {
    if (empty()) return other;
    if (other.empty()) return *this;
    return {{std::min(min.x, other.min.x), std::min(min.y, other.min.y)},
            {std::max(max.x, other.max.x), std::max(max.y, other.max.y)}};
  }
  [[nodiscard]] CellBox intersected(const CellBox& other) const {
    const CellBox box{{std::max(min.x, other.min.x), std::max(min.y, other.min.y)},
                      {std::min(max.x, other.max.x), std::min(max.y, other.max.y)}};
    return box.empty() ? CellBox{} : box;
  }
  /// Grown by `cells` on every side; an empty box stays empty.
  [[nodiscard]] CellBox grown(int cells) const {
    if (empty()) return {};
    return {{min.x - cells, min.y - cells}, {max.x + cells, max.y + cells}};
  }
  friend bool operator==(const CellBox& a, const CellBox& b) {
    return a.min == b.min && a.max == b.max;
  }
};

/// The lattice all 2D stages share: cell = floor(world / resolution). It has no origin, so a
/// growing map shifts nothing.
struct GridFrame {
  double resolution_m = 0.05;

  [[nodiscard]] Cell cellAt(const Point2& point) const {
    return {static_cast<int>(std::floor(point.x / resolution_m)),
            static_cast<int>(std::floor(point.y / resolution_m))};
  }
  [[nodiscard]] Point2 center(const Cell& cell) const {
    return {(cell.x + 0.5) * resolution_m, (cell.y + 0.5) * resolution_m};
  }
  /// Lower left corner of `cell`.
  [[nodiscard]] Point2 corner(const Cell& cell) const {
    return {cell.x * resolution_m, cell.y * resolution_m};
  }
  [[nodiscard]] double cellArea() const { return resolution_m * resolution_m; }
};

}  // namespace occusg
