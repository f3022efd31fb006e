// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/parameter.hpp"

namespace occusg {

/// What makes a room of a region the robot has not entered.
enum class PromotionEvidence {
  kAnyEntity,     ///< One agent, object or navigation node in it (paper, Sec. 3.3).
  kObservedArea,  ///< Enough free area, for long enough.
};

/// Relinking values are those of the published system's code; its text gives none.
struct RoomLayerConfig {
  double boundary_tolerance_m = 0.5;  ///< A region also holds what is this near to it [m].
  double floor_z_m = 0.0;             ///< Height of room nodes in the map frame [m].

  double relink_min_overlap = 0.65;  ///< Share of the room its successor must cover, 0..1.
  double relink_min_members = 0.5;   ///< Share of the room's members it must hold, 0..1.
  /// The same for a successor that does not hold the room's centroid, 0..1.
  double relink_min_members_off_centre = 0.75;
  double relink_min_margin = 0.15;  ///< Lead over the second best successor, of a score in 0..1.

  PromotionEvidence promotion = PromotionEvidence::kObservedArea;
  double min_promoted_area_m2 = 1.0;  ///< kObservedArea: smallest region that becomes a room [m2].
  double min_promoted_age_s = 4.0;    ///< kObservedArea: once it has been known for so long [s].

  /// A room is confirmed once no more than this share of its boundary is frontier, 0..1; until then
  /// it is partial. One: every room is confirmed.
  double max_frontier_share = 0.3;

  /// A room stays for so long after its region went missing, and at least while the tracker
  /// remembers the region [s]. Zero: exactly while it does (paper, Sec. 3.3).
  double removal_grace_s = 10.0;
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(RoomLayerConfig& config);

}  // namespace occusg
