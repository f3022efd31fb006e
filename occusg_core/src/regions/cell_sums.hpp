// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "occusg/regions/region.hpp"

namespace occusg {

/// Sums over a set of cells, exact in integers: they do not depend on the order of the cells, and
/// the sums of two disjoint sets add up to those of both.
struct CellSums {
  std::int64_t count = 0;
  std::int64_t x = 0;
  std::int64_t y = 0;
  CellBox bounds;
  Cell first;  ///< In row-major order; meaningless when `count` is zero.

  /// Adds the cells [x_begin, x_end) of row `row`.
  void addRun(int x_begin, int x_end, int row);
  void add(const CellSums& other);
};

/// The region of the cells that carry `label`, which are 4-connected.
/// @param id the region's; @param sums those of exactly these cells.
[[nodiscard]] Region regionOf(const Grid<std::int32_t>& labels, std::int32_t label, int id,
                              const GridFrame& frame, const CellSums& sums);

}  // namespace occusg
