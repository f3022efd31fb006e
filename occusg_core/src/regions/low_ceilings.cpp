// SPDX-License-Identifier: BSD-3-Clause
#include "regions/low_ceilings.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "regions/cell_walks.hpp"
#include "regions/squared_distance.hpp"

namespace occusg {
namespace {

/// [m] Of a disc that no beam, pipe or doorway in a thick wall has room for.
constexpr double kDiscRadius_m = 0.75;
/// [cells] How much smaller the disc is that is kept: diagonally too, a ring of cells is left.
constexpr double kRing_cells = 1.5;

}  // namespace

std::vector<Cell> cellsUnderLowCeilings(const std::vector<Cell>& cells, const CellBox& bounds,
                                        double resolution_m) {
  const double radius_cells = kDiscRadius_m / resolution_m;
  const double inner_cells = radius_cells - kRing_cells;
  const auto side = static_cast<std::int64_t>(std::ceil(2.0 * radius_cells)) - 1;
  // Nearly all lintels end here.
  if (inner_cells < 1.0 || bounds.width() < side || bounds.height() < side ||
      static_cast<std::int64_t>(cells.size()) < side * side / 2)
    return {};

  // What lies outside a grid counts as closed: no cell within the bounds may be nearer to it than
  // to a centre.
  Grid<std::uint8_t> open(bounds.grown(static_cast<int>(std::ceil(radius_cells))), 0);
  for (const Cell& cell : cells) open.at(cell) = 1;
  const Grid<std::int32_t> clearance = squaredDistances(open);
  Grid<std::uint8_t> away_from_centres(open.box(), 1);
  bool has_centre = false;
  for (const Cell& cell : cells) {
    if (clearance.at(cell) < radius_cells * radius_cells) continue;
    away_from_centres.at(cell) = 0;
    has_centre = true;
  }
  if (!has_centre) return {};

  const Grid<std::int32_t> to_centre = squaredDistances(away_from_centres);
  std::vector<Cell> inner;
  forEachCell(bounds, [&](const Cell& cell) {
    if (to_centre.at(cell) <= inner_cells * inner_cells && open.at(cell) != 0)
      inner.push_back(cell);
  });
  return inner;
}

}  // namespace occusg
