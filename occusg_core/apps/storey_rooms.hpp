// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/evaluation/evaluated_room.hpp"

namespace occusg::apps {

/// A room, and the height of the floor of its storey [m].
struct RoomOnStorey {
  EvaluatedRoom room;
  double floor_z_m = 0.0;
};

/// The rooms of both sides on one storey.
struct StoreyRooms {
  double floor_z_m = 0.0;  ///< Of the annotated storey; of the predicted one where none is near it.
  bool is_annotated = true;
  std::vector<EvaluatedRoom> predicted;
  std::vector<EvaluatedRoom> truth;
};

/// Sorts rooms by the annotated storeys, from the lowest up. A predicted storey belongs to the
/// annotated one whose floor is nearest, at most a metre away; one without is a storey of its own.
[[nodiscard]] std::vector<StoreyRooms> byStorey(const std::vector<RoomOnStorey>& predicted,
                                                const std::vector<RoomOnStorey>& truth);

/// The rooms of all storeys side by side, so that rooms above each other share no area.
[[nodiscard]] StoreyRooms sideBySide(const std::vector<StoreyRooms>& storeys);

}  // namespace occusg::apps
