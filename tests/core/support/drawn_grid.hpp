// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/mapping/free_space.hpp"

namespace occusg::testing {

/// A free-space layer drawn as text, the top line being the highest y: '.' free, '#' full
/// obstacle, ' ' unknown, '1'..'9' obstacle level 10..90. The lower left character is `corner`.
inline FreeSpace drawn(const std::vector<std::string>& rows, double resolution_m = 0.05,
                       Cell corner = {0, 0}) {
  std::size_t width = 0;
  for (const std::string& row : rows) width = std::max(width, row.size());
  const CellBox box{corner,
                    {corner.x + static_cast<int>(width), corner.y + static_cast<int>(rows.size())}};
  FreeSpace layer{GridFrame{resolution_m}, FreeSpaceCells(box, kUnknown), box};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int y = box.max.y - 1 - static_cast<int>(i);
    for (std::size_t j = 0; j < rows[i].size(); ++j) {
      const char c = rows[i][j];
      const auto value = c == '.'               ? kFree
                         : c == '#'             ? kFullObstacle
                         : c >= '1' && c <= '9' ? static_cast<std::int8_t>(10 * (c - '0'))
                                                : kUnknown;
      layer.cells.at({corner.x + static_cast<int>(j), y}) = value;
    }
  }
  return layer;
}

/// An all-obstacle layer of the given size in metres, to be carved with `carve`.
inline FreeSpace solid(double width_m, double height_m, double resolution_m = 0.05) {
  const CellBox box{{0, 0},
                    {static_cast<int>(std::lround(width_m / resolution_m)),
                     static_cast<int>(std::lround(height_m / resolution_m))}};
  return {GridFrame{resolution_m}, FreeSpaceCells(box, kFullObstacle), box};
}

/// Sets the cells of the rectangle [x0, x1) x [y0, y1) in metres.
inline void fill(FreeSpace& layer, double x0, double y0, double x1, double y1,
                 std::int8_t value = kFree) {
  const auto cell = [&](double metres) {
    return static_cast<int>(std::lround(metres / layer.frame.resolution_m));
  };
  for (int y = cell(y0); y < cell(y1); ++y)
    for (int x = cell(x0); x < cell(x1); ++x) layer.cells.at({x, y}) = value;
}

}  // namespace occusg::testing
