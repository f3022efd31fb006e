// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "geometry/cell_outline.hpp"

namespace occusg {

/// Triangulation of one outline, as plain numbers.
struct DudeMesh {
  struct Face {
    std::array<int, 3> corners;  ///< Indices into `points`, counter-clockwise.
    /// Face across the edge opposite corner i, from corners[i + 1] to corners[i + 2]; -1 where that
    /// edge belongs to a ring.
    std::array<int, 3> neighbours;
  };
  /// The corners of all rings in their order; of equal ones the faces name the first.
  std::vector<Cell> points;
  std::vector<Face> faces;  ///< Those inside the outline only.
};

/// Constrained Delaunay triangulation of the area between the rings (exact predicates, no
/// constructed points). Rings may have corners in the middle of straight edges and may touch one
/// another at corners. O(n log n).
[[nodiscard]] DudeMesh triangulated(const std::vector<CornerRing>& rings);

}  // namespace occusg
