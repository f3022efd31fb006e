// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "occusg/geometry/pose.hpp"
#include "occusg/graph/graph_builder.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg {

/// What a running system knows besides its occupancy map and cannot compute from it again. The
/// free-space layer and the decomposition follow from the map.
struct SessionState {
  std::string scene;
  double stamp_s = 0.0;                      ///< Of the last frame.
  Pose T_map_agent = Pose::Identity();       ///< Of the last frame.
  std::optional<double> last_room_update_s;  ///< When regions and rooms were updated last.
  RegionTrackerState tracker;
  GraphBuilderState graph;
};

}  // namespace occusg
