// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// Why a room came into being (paper, Sec. 3.3).
enum class RoomReason {
  kBootstrap,  ///< It holds the first valid robot pose.
  kVisited,    ///< The robot entered a region that had no room.
  kPromoted,   ///< Maintenance found evidence enough in a region nobody has entered.
};

/// How much of a room has been seen.
enum class RoomState {
  kPartial,    ///< Too much of its boundary is frontier: it was seen through a door, say.
  kConfirmed,  ///< Enough of its boundary is wall or opens into known free space.
};

enum class LabelSource {
  kAutomatic,  ///< From what is in the room.
  kPerson,     ///< Given by a person; stays.
};

/// What the graph knows of a room beyond what every node has.
struct RoomAttributes {
  std::string name;      ///< "room_<n>", n counting rooms from 1; never used again.
  int region_id = 0;     ///< Track the room is anchored to; no two rooms share one.
  Polygon polygon;       ///< Footprint: the region's polygon when last seen, map frame [m].
  double area_m2 = 0.0;  ///< Of `polygon`, holes taken out.
  RoomReason reason = RoomReason::kPromoted;
  RoomState state = RoomState::kConfirmed;
  double frontier_share = 0.0;    ///< Share of its boundary beyond which nothing is known, 0..1.
  std::string label = "unknown";  ///< What kind of room it is.
  double label_score = 0.0;       ///< How sure that is, 0..1; of a person's label 1.
  LabelSource label_source = LabelSource::kAutomatic;
  /// Since when its region has been missing [s]; empty while the region is there.
  std::optional<double> unsupported_since_s;

  [[nodiscard]] bool isBootstrap() const { return reason == RoomReason::kBootstrap; }
};

}  // namespace occusg
