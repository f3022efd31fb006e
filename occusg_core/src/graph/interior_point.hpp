// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// A point well inside the polygon to stand for it: the centroid, unless that lies outside or less
/// than half as far from the boundary as a point can; then the point farthest from the boundary
/// (pole of inaccessibility, within 0.05 m).
/// @pre the polygon has an area.
[[nodiscard]] Point2 interiorPoint(const Polygon& polygon);

}  // namespace occusg
