// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/cell_outline.hpp"

namespace occusg {

/// Shape of a hole, i.e. of an obstacle that stands free.
struct DudeHole {
  double diameter_cells = 0.0;  ///< Greatest distance between two corners.
  double width_cells = 0.0;     ///< Twice the greatest distance of a corner to that diameter.
  std::int64_t area_cells = 0;  ///< Enclosed cells.
};

[[nodiscard]] DudeHole holeShape(const CornerRing& ring);

/// How deep every corner of a hole reaches into free space [cells]: its distance to the farthest
/// corner of the same hole, so that the ends of a free-standing wall are as deep as it is long.
[[nodiscard]] std::vector<double> holeDepths(const CornerRing& ring);

/// Enclosed cells of a ring, positive when it runs counter-clockwise.
[[nodiscard]] std::int64_t signedCells(const CornerRing& ring);

/// Calls `visit` for every cell `ring` encloses, row by row.
void visitRing(const CornerRing& ring, const std::function<void(const Cell&)>& visit);

}  // namespace occusg
