// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "occusg/graph/entity_assignment.hpp"
#include "occusg/graph/region_snapshot.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Makes the adjacency edges of the graph those the regions support: two rooms are adjacent when
/// their regions share a crossing and a traversable edge leads from one region to the other
/// (paper, Sec. 3.4). In a graph without navigation nodes the crossing, a contact of free space,
/// is the evidence. Edges of a room whose region is missing stay until it is back or removed.
/// @param room_of_region owner of each region that has one.
void updateRoomAdjacency(SceneGraph& graph, const RegionSnapshot& snapshot,
                         const EntityAssignment& assignment,
                         const std::map<int, NodeId>& room_of_region);

}  // namespace occusg
