// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "occusg/geometry/grid.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// Where a lintel is looked for, above the local floor [m].
struct LintelHeights {
  double lowest_m = 1.7;
  double highest_m = 0.0;  ///< Below `lowest_m`: nowhere.
};

/// True when something overhead between the given heights ends the gap above a cell that is free
/// from the floor up.
[[nodiscard]] bool isUnderLintel(const FreeSpace& layer, const Cell& cell,
                                 const LintelHeights& heights);

/// Spreads the labels of the cells `reached`, in this order and in breadth, over the cells without
/// a label that `isOpen` allows: each gets the label that is the fewest steps away.
void spreadLabels(std::vector<Cell> reached, const std::function<bool(const Cell&)>& isOpen,
                  Grid<std::int32_t>& labels);

}  // namespace occusg
