// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// Farthest a coordinate may lie from the map's origin [m]: what follows rounds to a lattice of
/// 1e-7 m that ends a little beyond. The functions of this file throw `Error` when a coordinate is
/// farther out or not finite, and when edges cross so often that the result would take longer than
/// a few seconds (more than 5 000 crossings of one polygon with itself, or 100 000 of two polygons,
/// and several for each edge). Rings may run either way round.
inline constexpr double kMaxCoordinate_m = 1e11;

/// @throws Error naming `where` for the first coordinate that is not finite or beyond
/// `kMaxCoordinate_m`.
void checkCoordinates(const Polygon& polygon, const std::string& where);

/// Area common to both [m2]. Exact where edges cross on a lattice of 1e-7 m, as those of cells do;
/// vertices and crossings elsewhere are rounded to it.
[[nodiscard]] double intersectionArea(const Polygon& a, const Polygon& b);

/// Intersection over union in [0, 1]; zero when both are empty.
[[nodiscard]] double intersectionOverUnion(const Polygon& a, const Polygon& b);

/// Area of `polygon` covered by any of `others` [m2].
[[nodiscard]] double coveredArea(const Polygon& polygon, const std::vector<Polygon>& others);

/// Valid polygons that enclose what `polygon`'s rings enclose under the even-odd rule: a
/// self-intersecting ring falls apart into simple ones. A piece that still touches itself loses a
/// few lattice steps all round, which frees it. Largest first; empty when nothing is left.
[[nodiscard]] std::vector<Polygon> repaired(const Polygon& polygon);

/// Valid polygons that do not overlap and cover what any of `polygons` covers. Largest first.
[[nodiscard]] std::vector<Polygon> united(const std::vector<Polygon>& polygons);

/// Valid polygons that cover what `polygon` covers and none of `others` does. Largest first.
[[nodiscard]] std::vector<Polygon> difference(const Polygon& polygon,
                                              const std::vector<Polygon>& others);

}  // namespace occusg
