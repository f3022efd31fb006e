// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/evaluation/evaluated_room.hpp"
#include "rings.hpp"

namespace occusg::testing {

/// Rooms numbered from 1, one a ring.
inline std::vector<EvaluatedRoom> roomsOf(const std::vector<Ring>& rings) {
  std::vector<EvaluatedRoom> rooms;
  for (const Ring& ring : rings)
    rooms.push_back({static_cast<int>(rooms.size()) + 1, {Polygon{ring, {}}}});
  return rooms;
}

/// Two rooms of 16 m2, side by side.
inline std::vector<EvaluatedRoom> twoRooms() { return roomsOf({box(0, 0, 4, 4), box(4, 0, 8, 4)}); }

inline std::vector<EvaluatedRoom> moved(const std::vector<EvaluatedRoom>& rooms, double dx,
                                        double dy) {
  std::vector<EvaluatedRoom> result;
  for (const EvaluatedRoom& room : rooms) result.push_back(translated(room, Point2{dx, dy}));
  return result;
}

}  // namespace occusg::testing
