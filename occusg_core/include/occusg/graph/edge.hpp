// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "occusg/graph/node.hpp"

namespace occusg {

enum class EdgeType {
  kTemporal,          ///< Earlier agent -> next agent.
  kContains,          ///< Room -> agent, object or navigation node; one room per member.
  kTraversable,       ///< Navigation node - navigation node, undirected.
  kNearestFreeSpace,  ///< Object -> navigation node.
  kRoomAdjacency,     ///< Room - room, undirected.
};
inline constexpr std::size_t kEdgeTypeCount = 5;

/// "TEMPORAL_LINK", "ROOM_CONTAINS", "NAVIGABLE_PATH", "NEAREST_FREE_SPACE" or "ROOM_ADJACENCY".
[[nodiscard]] const char* nameOf(EdgeType type);

[[nodiscard]] constexpr bool isDirected(EdgeType type) {
  return type != EdgeType::kTraversable && type != EdgeType::kRoomAdjacency;
}

/// An undirected edge is stored once, from the smaller id to the larger.
struct Edge {
  EdgeType type = EdgeType::kTemporal;
  NodeId source = 0;
  NodeId target = 0;
  /// kRoomAdjacency: the segments along which the two rooms meet, widest first, map frame [m].
  std::vector<Segment2> crossings;
};

}  // namespace occusg
