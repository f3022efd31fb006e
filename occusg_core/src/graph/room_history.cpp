// SPDX-License-Identifier: BSD-3-Clause
#include "graph/room_history.hpp"

#include <algorithm>

#include "occusg/geometry/polygon_overlap.hpp"

namespace occusg {
namespace {

constexpr double kSamePlace = 0.5;
constexpr std::size_t kMostRemembered = 1000;

bool isSamePlace(const RoomAttributes& a, const RoomAttributes& b) {
  return intersectionOverUnion(a.polygon, b.polygon) >= kSamePlace;
}

}  // namespace

void RoomHistory::update(const SceneGraph& graph) {
  GraphChanges changes = graph.changesSince(revision_);
  revision_ = graph.revision();
  if (!changes.complete) {
    // More happened at once than is remembered: as good as a new graph.
    rooms_.clear();
    for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) changes.changed_nodes.push_back(id);
  }
  for (const NodeId id : changes.removed_nodes)
    if (isRoomId(id)) noteRemoved(graph, id);
  for (const auto* list : {&changes.added_nodes, &changes.changed_nodes}) {
    for (const NodeId id : *list) {
      if (!isRoomId(id)) continue;
      const RoomAttributes& room = graph.room(id);
      const auto [item, is_new] = rooms_.try_emplace(id);
      item->second.room = room;
      item->second.was_confirmed |= room.state == RoomState::kConfirmed;
      if (is_new) noteAdded(room);
    }
  }
}

bool RoomHistory::wasReplaced(const SceneGraph& graph, NodeId id,
                              const RoomAttributes& room) const {
  if (!room.unsupported_since_s) return false;
  const auto& rooms = graph.nodes(NodeType::kRoom);
  return std::any_of(rooms.begin(), rooms.end(), [&](const auto& item) {
    const bool came_after = item.first > id && item.second.created_s >= *room.unsupported_since_s;
    return came_after && isSamePlace(graph.room(item.first), room);
  });
}

void RoomHistory::noteRemoved(const SceneGraph& graph, NodeId id) {
  const auto known = rooms_.find(id);
  if (known == rooms_.end()) return;
  const Known gone = known->second;
  rooms_.erase(known);
  if (!gone.was_confirmed) return;
  if (wasReplaced(graph, id, gone.room)) {
    ++id_switches_;
    return;
  }
  removed_.push_back(gone.room);
  if (removed_.size() > kMostRemembered) removed_.erase(removed_.begin());
}

void RoomHistory::noteAdded(const RoomAttributes& room) {
  const auto before =
      std::find_if(removed_.begin(), removed_.end(),
                   [&](const RoomAttributes& gone) { return isSamePlace(gone, room); });
  if (before == removed_.end()) return;
  removed_.erase(before);
  ++id_switches_;
}

}  // namespace occusg
