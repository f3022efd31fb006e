// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "occusg/geometry/grid.hpp"

namespace occusg::testing {

/// A mask drawn as text, the top line being the highest y: '#' is 1, everything else 0. The lower
/// left character is `corner`.
inline Grid<std::uint8_t> drawnMask(const std::vector<std::string>& rows, Cell corner = {0, 0}) {
  std::size_t width = 0;
  for (const std::string& row : rows) width = std::max(width, row.size());
  const CellBox box{corner,
                    {corner.x + static_cast<int>(width), corner.y + static_cast<int>(rows.size())}};
  Grid<std::uint8_t> mask(box, 0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j)
      if (rows[i][j] == '#')
        mask.at({corner.x + static_cast<int>(j), box.max.y - 1 - static_cast<int>(i)}) = 1;
  return mask;
}

/// A random mask in which a cell is set with the given probability. Standard distributions differ
/// between libraries; the engine does not.
inline Grid<std::uint8_t> randomMask(std::uint32_t seed, const CellBox& box, double probability) {
  std::mt19937 engine(seed);
  Grid<std::uint8_t> mask(box, 0);
  for (std::uint8_t& value : mask.values()) value = engine() < probability * 4294967296.0 ? 1 : 0;
  return mask;
}

}  // namespace occusg::testing
