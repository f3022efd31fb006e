// SPDX-License-Identifier: BSD-3-Clause
#include "graph/adjacency_layer.hpp"

#include <algorithm>
#include <tuple>

namespace occusg {
namespace {

bool isWider(const Segment2& a, const Segment2& b) {
  return std::make_tuple(-length(a), a.a.x, a.a.y, a.b.x, a.b.y) <
         std::make_tuple(-length(b), b.a.x, b.a.y, b.b.x, b.b.y);
}

bool areSame(const std::vector<Segment2>& a, const std::vector<Segment2>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Segment2& s, const Segment2& t) { return s.a == t.a && s.b == t.b; });
}

}  // namespace

void AdjacencyLayer::restore(const SceneGraph& graph) {
  *this = AdjacencyLayer();
  doors_.restore(graph);
}

void AdjacencyLayer::observe(const SceneGraph& graph, const RegionSnapshot& snapshot,
                             const EntityAssignment& assignment) {
  joins_.update(graph, assignment);
  noteContacts(snapshot);
  changed_regions_.insert(joins_.changed().begin(), joins_.changed().end());
  const bool has_navigation = !graph.nodes(NodeType::kNavigation).empty();
  if (has_navigation == has_navigation_) return;
  // What counts as evidence is another for all pairs.
  has_navigation_ = has_navigation;
  for (const auto& [region, partners] : partners_)
    for (const int partner : partners) changed_regions_.insert(std::minmax(region, partner));
}

void AdjacencyLayer::noteContacts(const RegionSnapshot& snapshot) {
  for (const RegionPair& regions : snapshot.changedContacts()) {
    changed_regions_.insert(regions);
    if (snapshot.crossingsBetween(regions).empty()) {
      partners_[regions.first].erase(regions.second);
      partners_[regions.second].erase(regions.first);
    } else {
      partners_[regions.first].insert(regions.second);
      partners_[regions.second].insert(regions.first);
    }
    for (const int region : {regions.first, regions.second})
      if (partners_[region].empty()) partners_.erase(region);
  }
}

void AdjacencyLayer::apply(SceneGraph& graph, const RegionSnapshot& snapshot,
                           const std::map<int, NodeId>& room_of_region, double stamp_s) {
  std::set<RoomPair> changed;
  for (const RoomPair& rooms : affectedRooms(graph, room_of_region)) {
    const bool are_there = snapshot.has(graph.room(rooms.first).region_id) &&
                           snapshot.has(graph.room(rooms.second).region_id);
    if (!are_there) continue;
    std::vector<Segment2> crossings = supportedCrossings(graph, snapshot, rooms);
    const Edge* const edge = graph.findEdge(EdgeType::kRoomAdjacency, rooms.first, rooms.second);
    if (edge == nullptr ? crossings.empty() : areSame(edge->crossings, crossings)) continue;
    changed.insert(rooms);
    if (crossings.empty()) {
      graph.disconnect(EdgeType::kRoomAdjacency, rooms.first, rooms.second);
    } else {
      graph.connect({EdgeType::kRoomAdjacency, rooms.first, rooms.second, std::move(crossings)});
    }
  }
  doors_.update(graph, changed, stamp_s);
  changed_regions_.clear();
  changed_rooms_.clear();
}

std::set<AdjacencyLayer::RoomPair> AdjacencyLayer::affectedRooms(
    const SceneGraph& graph, const std::map<int, NodeId>& room_of_region) const {
  std::set<RoomPair> pairs;
  const auto insert = [&](NodeId a, int region_b) {
    const auto b = room_of_region.find(region_b);
    if (b != room_of_region.end() && b->second != a) pairs.insert(std::minmax(a, b->second));
  };
  for (const RegionPair& regions : changed_regions_) {
    const auto a = room_of_region.find(regions.first);
    if (a != room_of_region.end()) insert(a->second, regions.second);
  }
  for (const NodeId room : changed_rooms_) {
    if (graph.find(room) == nullptr) continue;
    const auto partners = partners_.find(graph.room(room).region_id);
    if (partners != partners_.end())
      for (const int partner : partners->second) insert(room, partner);
    for (const NodeId beside : graph.targets(EdgeType::kRoomAdjacency, room))
      pairs.insert(std::minmax(room, beside));
  }
  return pairs;
}

std::vector<Segment2> AdjacencyLayer::supportedCrossings(const SceneGraph& graph,
                                                         const RegionSnapshot& snapshot,
                                                         const RoomPair& rooms) const {
  const RegionPair regions =
      std::minmax(graph.room(rooms.first).region_id, graph.room(rooms.second).region_id);
  if (has_navigation_ && !joins_.areJoined(regions)) return {};
  std::vector<Segment2> crossings = snapshot.crossingsBetween(regions);
  std::sort(crossings.begin(), crossings.end(), isWider);
  return crossings;
}

}  // namespace occusg
