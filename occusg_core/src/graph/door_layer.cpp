// SPDX-License-Identifier: BSD-3-Clause
#include "graph/door_layer.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace occusg {
namespace {

// A passage is about that wide: two doors are farther apart, one door seen twice is nearer.
constexpr double kSamePlace_m = 0.75;

const DoorAttributes& doorIn(const Node& node) { return std::get<DoorAttributes>(node.attributes); }

std::pair<NodeId, NodeId> roomsOf(const DoorAttributes& door) { return {door.room_a, door.room_b}; }

}  // namespace

void DoorLayer::restore(const SceneGraph& graph) {
  *this = DoorLayer();
  for (const auto& [id, node] : graph.nodes(NodeType::kDoor)) remember(id, roomsOf(doorIn(node)));
}

void DoorLayer::update(SceneGraph& graph, const std::set<RoomPair>& changed, double stamp_s) {
  const std::vector<NodeId> doors = doorsAffected(graph, changed);
  std::vector<Opening> openings;
  for (const RoomPair& rooms : changed) {
    const Edge* const edge = graph.findEdge(EdgeType::kRoomAdjacency, rooms.first, rooms.second);
    if (edge == nullptr) continue;
    for (const Segment2& segment : edge->crossings) openings.push_back({rooms, segment});
  }
  std::vector<bool> has_door(openings.size(), false);
  std::set<NodeId> kept;
  for (const Match& match : matched(graph, openings, doors)) {
    const Opening& opening = openings[match.opening];
    has_door[match.opening] = true;
    kept.insert(match.door);
    Node node = graph.at(match.door);
    forget(match.door, roomsOf(doorIn(node)));
    const Point2 at = midpoint(opening.segment);
    node.position.head<2>() << at.x, at.y;
    node.last_seen_s = stamp_s;
    node.attributes = DoorAttributes{opening.segment, length(opening.segment), opening.rooms.first,
                                     opening.rooms.second};
    graph.update(std::move(node));
    remember(match.door, opening.rooms);
  }
  for (const NodeId door : doors) {
    if (kept.count(door) > 0) continue;
    forget(door, roomsOf(doorIn(graph.at(door))));
    graph.remove(door);
  }
  for (std::size_t i = 0; i < openings.size(); ++i) {
    if (has_door[i]) continue;
    const auto& [rooms, segment] = openings[i];
    const Point2 at = midpoint(segment);
    const double floor_z_m = graph.at(rooms.first).position.z();
    remember(graph
                 .add({at.x, at.y, floor_z_m}, stamp_s,
                      DoorAttributes{segment, length(segment), rooms.first, rooms.second})
                 .id,
             rooms);
  }
}

std::vector<NodeId> DoorLayer::doorsAffected(const SceneGraph& graph,
                                             const std::set<RoomPair>& changed) {
  std::set<RoomPair> pairs = changed;
  const GraphChanges changes = graph.changesSince(revision_);
  revision_ = graph.revision();
  const auto isGone = [&](NodeId room) { return graph.find(room) == nullptr; };
  if (changes.complete) {
    for (const EdgeKey& edge : changes.removed_edges)
      if (edge.type == EdgeType::kRoomAdjacency) pairs.emplace(edge.source, edge.target);
  } else {
    for (const auto& [rooms, doors] : doors_of_rooms_)
      if (isGone(rooms.first) || isGone(rooms.second)) pairs.insert(rooms);
  }
  std::vector<NodeId> doors;
  for (const RoomPair& rooms : pairs) {
    const auto known = doors_of_rooms_.find(rooms);
    const bool is_affected =
        changed.count(rooms) > 0 || isGone(rooms.first) || isGone(rooms.second);
    if (known != doors_of_rooms_.end() && is_affected)
      doors.insert(doors.end(), known->second.begin(), known->second.end());
  }
  return doors;
}

std::vector<DoorLayer::Match> DoorLayer::matched(const SceneGraph& graph,
                                                 const std::vector<Opening>& openings,
                                                 const std::vector<NodeId>& doors) {
  // Same rooms first, then the nearest, then the oldest door.
  std::vector<std::tuple<bool, double, NodeId, std::size_t>> candidates;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const Point2 at = midpoint(openings[i].segment);
    for (const NodeId id : doors) {
      const Node& door = graph.at(id);
      const double distance_m = distance(door.groundPosition(), at);
      const bool is_of_others = roomsOf(doorIn(door)) != openings[i].rooms;
      if (distance_m <= kSamePlace_m) candidates.emplace_back(is_of_others, distance_m, id, i);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<Match> matches;
  std::set<NodeId> taken;
  std::set<std::size_t> served;
  for (const auto& [is_of_others, distance_m, door, opening] : candidates) {
    if (taken.count(door) > 0 || served.count(opening) > 0) continue;
    taken.insert(door);
    served.insert(opening);
    matches.push_back({opening, door});
  }
  return matches;
}

void DoorLayer::remember(NodeId door, const RoomPair& rooms) {
  doors_of_rooms_[rooms].insert(door);
}

void DoorLayer::forget(NodeId door, const RoomPair& rooms) {
  const auto known = doors_of_rooms_.find(rooms);
  if (known == doors_of_rooms_.end()) return;
  known->second.erase(door);
  if (known->second.empty()) doors_of_rooms_.erase(known);
}

}  // namespace occusg
