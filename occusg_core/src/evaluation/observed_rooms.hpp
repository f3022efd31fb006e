// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/evaluation/evaluated_room.hpp"
#include "occusg/geometry/cell.hpp"
#include "occusg/geometry/grid.hpp"

namespace occusg {

/// Which cells of the floor a robot saw.
struct SeenFloor {
  GridFrame frame;
  Point2 offset;            ///< Map frame = frame of the cells + offset [m].
  Grid<std::uint8_t> seen;  ///< 1 = seen; outside the grid nothing was.
};

/// An annotated room counts as observed when at least this share of its floor was seen.
inline constexpr double kObservedShare = 0.25;
/// Most cells of one room that are looked at; larger rooms are sampled on a coarser lattice.
inline constexpr double kMaxObservedCells = 1e6;

/// Share of the room's floor that was seen, by the centres of the cells within it; for a room that
/// holds no centre the cell under its centroid decides.
[[nodiscard]] double observedShare(const EvaluatedRoom& room, const SeenFloor& floor);

/// The rooms of which at least `kObservedShare` was seen.
[[nodiscard]] std::vector<EvaluatedRoom> observedRooms(const std::vector<EvaluatedRoom>& truth,
                                                       const SeenFloor& floor);

}  // namespace occusg
