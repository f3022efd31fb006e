// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// Where a lintel is looked for, above the local floor [m].
struct LintelHeights {
  double lowest_m = 1.7;
  double highest_m = 0.0;  ///< Below `lowest_m`: nowhere.
};

/// The layer's cells with those under a lintel closed: free from the floor up to something overhead
/// between the given heights.
[[nodiscard]] Grid<std::int8_t> withLintelsClosed(const FreeSpace& layer,
                                                  const LintelHeights& heights);

/// Labels the free cells without a label, connected ones alike, and gives those closed in `closed`
/// alone to the nearest region beside them.
void openLintels(const FreeSpaceCells& cells, const Grid<std::int8_t>& closed,
                 Grid<std::int32_t>& labels);

}  // namespace occusg
