// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/evaluation/evaluated_room.hpp"

namespace occusg {

/// Most points put on the boundary of one room.
inline constexpr double kMaxBoundarySamples = 1e7;

/// `ceil(length / step_m)` points spread evenly over the whole boundary of the room: ring after
/// ring in their order (outer ring and holes of each part), from the first vertex of the first on.
/// @throws Error when that is more than `kMaxBoundarySamples` or the step is not positive.
[[nodiscard]] std::vector<Point2> boundarySamples(const EvaluatedRoom& room, double step_m);

/// How well two boundaries agree, 0..1: harmonic mean of the share of the predicted room's boundary
/// samples within `tolerance_m` of the annotated boundary and the share the other way round.
[[nodiscard]] double boundaryF1(const EvaluatedRoom& predicted, const EvaluatedRoom& truth,
                                double tolerance_m, double step_m);

}  // namespace occusg
