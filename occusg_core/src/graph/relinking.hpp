// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/graph/graph_config.hpp"
#include "occusg/graph/node.hpp"
#include "occusg/regions/region.hpp"

namespace occusg {

/// A room whose region is not there any more.
struct LostRoom {
  NodeId id = 0;
  const Polygon* footprint = nullptr;  ///< Never null; as last seen.
  std::vector<Point2> members;         ///< Where the entities it contains are.
};

struct Successor {
  NodeId room = 0;
  int region = 0;
};

/// Finds the regions that have taken the place of lost rooms (paper, Sec. 3.3). A candidate must
/// cover enough of the footprint and of the members; the score is 0.45 x covered footprint + 0.35 x
/// covered members + 0.10 x IoU + 0.10 if it covers the centroid, and the best must lead the second
/// best by a margin. Each region succeeds one room, the one with the greatest score. For a room
/// without members the covered footprint stands in for them.
[[nodiscard]] std::vector<Successor> successorsOf(const std::vector<LostRoom>& rooms,
                                                  const std::vector<const Region*>& unowned,
                                                  const RoomLayerConfig& config);

}  // namespace occusg
