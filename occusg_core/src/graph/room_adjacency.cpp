// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/room_adjacency.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace occusg {
namespace {

using IdPair = std::pair<NodeId, NodeId>;
using RegionPair = std::pair<int, int>;

std::set<RegionPair> regionsJoinedByTravel(const SceneGraph& graph,
                                           const EntityAssignment& assignment) {
  std::set<RegionPair> joined;
  for (const auto& [ends, edge] : graph.edges(EdgeType::kTraversable)) {
    const std::optional<int> from = assignment.regionOf(ends.first);
    const std::optional<int> to = assignment.regionOf(ends.second);
    if (from && to && *from != *to) joined.insert(std::minmax(*from, *to));
  }
  return joined;
}

bool isWider(const Segment2& a, const Segment2& b) {
  return std::make_tuple(-length(a), a.a.x, a.a.y, a.b.x, a.b.y) <
         std::make_tuple(-length(b), b.a.x, b.a.y, b.b.x, b.b.y);
}

using CrossingsOfRooms = std::map<IdPair, std::vector<Segment2>>;

CrossingsOfRooms supportedPairs(const SceneGraph& graph, const RegionSnapshot& snapshot,
                                const EntityAssignment& assignment,
                                const std::map<int, NodeId>& room_of_region) {
  const bool has_navigation = !graph.nodes(NodeType::kNavigation).empty();
  const std::set<RegionPair> joined = regionsJoinedByTravel(graph, assignment);
  CrossingsOfRooms pairs;
  for (const Crossing& crossing : snapshot.crossings()) {
    const auto a = room_of_region.find(crossing.region_a);
    const auto b = room_of_region.find(crossing.region_b);
    if (a == room_of_region.end() || b == room_of_region.end() || a == b) continue;
    if (!snapshot.has(a->first) || !snapshot.has(b->first)) continue;
    if (has_navigation && joined.count(std::minmax(a->first, b->first)) == 0) continue;
    pairs[std::minmax(a->second, b->second)].push_back(crossing.segment);
  }
  for (auto& [rooms, segments] : pairs) std::sort(segments.begin(), segments.end(), isWider);
  return pairs;
}

}  // namespace

void updateRoomAdjacency(SceneGraph& graph, const RegionSnapshot& snapshot,
                         const EntityAssignment& assignment,
                         const std::map<int, NodeId>& room_of_region) {
  CrossingsOfRooms pairs = supportedPairs(graph, snapshot, assignment, room_of_region);
  std::vector<IdPair> outdated;
  for (const auto& [rooms, edge] : graph.edges(EdgeType::kRoomAdjacency)) {
    const bool is_supported = snapshot.has(graph.room(rooms.first).region_id) &&
                              snapshot.has(graph.room(rooms.second).region_id);
    if (is_supported && pairs.count(rooms) == 0) outdated.push_back(rooms);
  }
  for (const IdPair& rooms : outdated)
    graph.disconnect(EdgeType::kRoomAdjacency, rooms.first, rooms.second);
  for (auto& [rooms, segments] : pairs)
    graph.connect({EdgeType::kRoomAdjacency, rooms.first, rooms.second, std::move(segments)});
}

}  // namespace occusg
