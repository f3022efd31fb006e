// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// A room as the evaluation sees it.
struct EvaluatedRoom {
  int id = 0;
  /// Simple polygons that do not overlap, together the room. One, unless the room had to be
  /// repaired and fell apart.
  std::vector<Polygon> parts;
};

/// Makes a polygon from outside fit to be evaluated. A simple polygon keeps its vertices as they
/// are; repeated ones and holes of less than three vertices are dropped. Any other is repaired
/// under the even-odd rule (`repaired`).
/// @return nothing when no area is left: such a room is left out of an evaluation.
/// @param where the file the room comes from, for errors.
/// @throws Error when a coordinate is not finite or beyond `kMaxCoordinate_m`, and for an outline
/// that crosses itself thousands of times.
[[nodiscard]] std::optional<EvaluatedRoom> roomFrom(int id, const Polygon& polygon,
                                                    const std::string& where);

/// Whether `roomFrom` keeps the vertices: nothing crosses or touches itself but for repeated ones.
[[nodiscard]] bool isSound(const Polygon& polygon);

/// Area of all parts [m2].
[[nodiscard]] double area(const EvaluatedRoom& room);
/// Centroid of all parts, weighted by area [m].
[[nodiscard]] Point2 centroid(const EvaluatedRoom& room);
/// Area common to both [m2].
[[nodiscard]] double intersectionArea(const EvaluatedRoom& a, const EvaluatedRoom& b);
[[nodiscard]] EvaluatedRoom translated(const EvaluatedRoom& room, const Point2& shift);

/// @throws Error naming `what` and the room's id for the first room without a part or with a
/// coordinate that is not finite or beyond `kMaxCoordinate_m`.
void check(const std::vector<EvaluatedRoom>& rooms, const std::string& what);

}  // namespace occusg
