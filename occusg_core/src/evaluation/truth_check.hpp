// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/evaluation/evaluated_room.hpp"

namespace occusg {

/// An annotated room as it stands in a file.
struct TruthRoom {
  int id = 0;
  Polygon polygon;
  int level = 0;  ///< Storey; rooms of different storeys may lie above each other.
  std::vector<Polygon> further_parts = {};  ///< Of a room that is not in one piece.
};

/// Annotated rooms fit to be evaluated, and one sentence for each repair.
struct SoundTruth {
  std::vector<EvaluatedRoom> rooms;
  std::vector<std::string> notes;
};

/// Common area of two annotated rooms that is drawing tolerance, not an overlap [m2].
inline constexpr double kTruthOverlapTolerance_m2 = 0.1;
/// From this share of the smaller room on, the common area says that it lies within the larger.
inline constexpr double kTruthInsideShare = 0.95;
/// A self-intersecting room is repaired when one piece holds at least this share of its area.
inline constexpr double kTruthMainPieceShare = 0.95;

/// Repairs what can be understood in one way only, and says so: a room without area or drawn twice
/// is left out, a self-intersecting one keeps its main piece, a room within another is cut out of
/// it. A truth with none of these comes out with its vertices unchanged.
/// @param where opens every sentence; the file's path.
/// @throws Error naming the room's id: a self-intersecting room that falls apart into pieces, rooms
/// of one storey that overlap by more than `kTruthOverlapTolerance_m2`, coordinates that are not
/// finite.
[[nodiscard]] SoundTruth soundTruth(const std::vector<TruthRoom>& rooms, const std::string& where);

}  // namespace occusg
