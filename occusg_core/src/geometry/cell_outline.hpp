// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/geometry/grid.hpp"
#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// Ring of cell corners (integer, exact); consecutive corners differ in x or in y, never both,
/// and no three are collinear.
using CornerRing = std::vector<Cell>;

/// Outline of one 4-connected set of cells: outer ring counter-clockwise, holes clockwise.
/// Every ring starts at its smallest corner (row-major), so equal sets have equal outlines.
struct CellOutline {
  CornerRing outer;
  std::vector<CornerRing> holes;
};

/// Outlines of the 4-connected components of the cells where `mask` is not zero, along the cell
/// edges ("crack following"). Cells that touch at a corner only are separate components.
///
/// Every ring is simple. Where the edge of a component comes back to a corner it passed before, it
/// is split there: into an outer ring and a hole, or two holes, that touch in that corner. (Two
/// outer rings would mean two components.) Outlines are ordered by the smallest corner of the outer
/// ring, holes by theirs. Linear in the cells, plus sorting the holes.
[[nodiscard]] std::vector<CellOutline> outlinesOf(const Grid<std::uint8_t>& mask);

/// Outlines of the components that carry `label`, looking at the cells of `box` only: the edge of
/// the box ends a component. Linear in the cells of the box.
[[nodiscard]] std::vector<CellOutline> outlinesOf(const Grid<std::int32_t>& labels,
                                                  std::int32_t label, const CellBox& box);

/// The outline in metres.
[[nodiscard]] Polygon toPolygon(const CellOutline& outline, const GridFrame& frame);

}  // namespace occusg
