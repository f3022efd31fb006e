// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "occusg/evaluation/evaluated_room.hpp"

namespace occusg {

/// How the annotation is brought into the frame of the prediction: by a translation only.
enum class Alignment {
  kNone,      ///< Both live in one frame already.
  kCentroid,  ///< Mean of the predicted rooms' centroids on that of the annotated ones.
  kSearch,    ///< From there, the shift of largest overlap on a coarse lattice.
};

inline constexpr double kAlignmentRadius_m = 10.0;  ///< Farthest shift searched, per axis [m].
inline constexpr double kAlignmentStep_m = 0.5;     ///< Lattice of shifts searched [m].
inline constexpr double kAlignmentCell_m = 0.1;     ///< Raster that scores a shift [m].
/// Most raster cells of the predicted rooms' bounds with the radius all round: 500 m by 500 m.
inline constexpr double kMaxAlignmentCells = 2.5e7;

/// The translation to apply to the annotated rooms [m]; zero when either side has none.
///
/// kSearch starts at the centroid shift, or at minus `first_robot_position` when that is given and
/// overlaps at least as much, and tries every shift within `kAlignmentRadius_m` on a lattice of
/// `kAlignmentStep_m`. The score of a shift is the sum of the intersection areas of all pairs of a
/// predicted and an annotated room, on a raster whose cells an outline passes through count as
/// covered. Ties keep the start, then take the shorter shift, then the
/// lower in y, then in x.
/// @throws Error when kSearch would need more than `kMaxAlignmentCells`, or `first_robot_position`
/// is not finite.
[[nodiscard]] Point2 alignmentShift(const std::vector<EvaluatedRoom>& predicted,
                                    const std::vector<EvaluatedRoom>& truth, Alignment alignment,
                                    const std::optional<Point2>& first_robot_position);

}  // namespace occusg
