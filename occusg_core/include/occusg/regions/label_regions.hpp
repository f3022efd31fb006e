// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "occusg/regions/region.hpp"

namespace occusg {

/// What all decomposers share: from cells that carry a label to regions with polygons.

/// Shortest contact that counts as a crossing [m]: what is narrower lets nobody through.
inline constexpr double kMinCrossing_m = 0.3;

/// Numbers the 4-connected pieces of equal label 1..n by their first cell in row-major order, so
/// that equal partitions have equal numbers wherever they lie. kNoRegion stays kNoRegion.
[[nodiscard]] Grid<std::int32_t> numberedPieces(const Grid<std::int32_t>& labels);

/// Joins every piece of fewer than `min_cells` cells, smallest first, to the neighbour it shares
/// most cell edges with (the widest passage; ties: the lower number); one without a neighbour
/// becomes kNoRegion. @return the pieces, numbered as by numberedPieces().
[[nodiscard]] Grid<std::int32_t> withoutSmallPieces(const Grid<std::int32_t>& labels,
                                                    std::size_t min_cells);

/// The decomposition in which every 4-connected piece of equal label is one region. Polygons run
/// along the cell edges: simple, disjoint, their union exactly the labelled cells. Where two
/// regions touch along a chain of cell edges whose ends are at least `min_crossing_m` apart, they
/// are adjacent and the straight segment between those ends, jamb to jamb, is their crossing.
[[nodiscard]] Decomposition decompositionOf(const Grid<std::int32_t>& labels,
                                            const GridFrame& frame,
                                            double min_crossing_m = kMinCrossing_m);

}  // namespace occusg
