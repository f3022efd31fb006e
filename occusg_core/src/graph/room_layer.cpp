// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/room_layer.hpp"

#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "occusg/graph/interior_point.hpp"
#include "occusg/graph/room_adjacency.hpp"

namespace occusg {
namespace {

constexpr double kStampRoundingS = 1e-6;

const RoomAttributes& roomIn(const Node& node) { return std::get<RoomAttributes>(node.attributes); }

/// Forgets what is held for regions the tracker will not bring back.
template <typename Value>
void dropForgotten(std::map<int, Value>& by_region, const RegionSnapshot& snapshot) {
  for (auto item = by_region.begin(); item != by_region.end();)
    item = snapshot.remembers(item->first) ? std::next(item) : by_region.erase(item);
}

}  // namespace

RoomLayer::RoomLayer(const RoomLayerConfig& config)
    : config_(config), assignment_(config.boundary_tolerance_m) {}

void RoomLayer::update(SceneGraph& graph, const TrackedRegions& tracked, const Point2& robot,
                       double stamp_s, Maintenance maintenance) {
  snapshot_.update(tracked);
  assignment_.update(graph, snapshot_);
  const bool is_fresh = snapshot_.state() == SnapshotState::kFresh;
  if (is_fresh) {
    noteSupport(graph, stamp_s);
    returnToFormerRegions(graph, stamp_s);
    moveToSuccessors(graph, stamp_s);
  }
  followRobot(graph, robot, stamp_s);
  if (is_fresh && maintenance == Maintenance::kDue) maintain(graph, stamp_s, Decisions::kWait);
  syncContainment(graph);
}

void RoomLayer::finish(SceneGraph& graph, double stamp_s) {
  assignment_.update(graph, snapshot_);
  if (snapshot_.state() == SnapshotState::kFresh) maintain(graph, stamp_s, Decisions::kNow);
  syncContainment(graph);
}

void RoomLayer::restore(const SceneGraph& graph, const RoomLayerState& state) {
  *this = RoomLayer(config_);
  first_seen_s_ = state.first_seen_s;
  former_room_of_region_ = state.former_room_of_region;
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom))
    room_of_region_.emplace(roomIn(node).region_id, id);
}

std::optional<NodeId> RoomLayer::ownerOf(int region) const {
  const auto found = room_of_region_.find(region);
  if (found == room_of_region_.end()) return std::nullopt;
  return found->second;
}

void RoomLayer::noteSupport(SceneGraph& graph, double stamp_s) {
  dropForgotten(first_seen_s_, snapshot_);
  dropForgotten(former_room_of_region_, snapshot_);
  for (const auto& [id, support] : snapshot_.regions()) first_seen_s_.emplace(id, stamp_s);
  for (const auto& [region, room] : room_of_region_) {
    const bool is_supported = snapshot_.has(region);
    if (graph.room(room).unsupported_since_s.has_value() != is_supported) continue;
    Node node = graph.at(room);
    auto& unsupported_since_s = std::get<RoomAttributes>(node.attributes).unsupported_since_s;
    unsupported_since_s = is_supported ? std::nullopt : std::optional<double>(stamp_s);
    graph.update(std::move(node));
  }
}

// A merge that lasts an update or two must cost no room its id: the successor is gone, the region
// the room left is back under its old track, and would overlap the merged footprint too little.
void RoomLayer::returnToFormerRegions(SceneGraph& graph, double stamp_s) {
  const auto former = former_room_of_region_;
  for (const auto& [region, room] : former) {
    const bool is_lost = graph.room(room).unsupported_since_s.has_value();
    if (is_lost && snapshot_.has(region) && !ownerOf(region))
      moveRoom(graph, room, region, stamp_s);
  }
}

void RoomLayer::moveToSuccessors(SceneGraph& graph, double stamp_s) {
  const std::vector<LostRoom> lost = lostRooms(graph);
  if (lost.empty()) return;
  std::vector<const Region*> unowned;
  for (const auto& [id, support] : snapshot_.regions())
    if (!ownerOf(id)) unowned.push_back(&support.region);
  for (const Successor& successor : successorsOf(lost, unowned, config_))
    moveRoom(graph, successor.room, successor.region, stamp_s);
}

std::vector<LostRoom> RoomLayer::lostRooms(const SceneGraph& graph) const {
  std::vector<LostRoom> lost;
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const RoomAttributes& room = roomIn(node);
    if (!room.unsupported_since_s) continue;
    LostRoom entry{id, &room.polygon, {}};
    for (const NodeId member : graph.targets(EdgeType::kContains, id))
      entry.members.push_back(graph.at(member).groundPosition());
    lost.push_back(std::move(entry));
  }
  return lost;
}

void RoomLayer::followRobot(SceneGraph& graph, const Point2& robot, double stamp_s) {
  current_region_ = regionAt(snapshot_, robot, config_.boundary_tolerance_m, current_region_);
  current_room_ = current_region_ ? ownerOf(*current_region_) : std::nullopt;
  if (!current_region_ || snapshot_.state() != SnapshotState::kFresh) return;
  if (current_room_) {
    refreshRoom(graph, *current_room_, stamp_s);
    return;
  }
  const bool is_first = graph.nextId(NodeType::kRoom) == firstId(NodeType::kRoom);
  createRoom(graph, *current_region_, is_first ? RoomReason::kBootstrap : RoomReason::kVisited,
             stamp_s);
  current_room_ = ownerOf(*current_region_);
}

void RoomLayer::maintain(SceneGraph& graph, double stamp_s, Decisions decisions) {
  for (const auto& [region, room] : room_of_region_)
    if (snapshot_.has(region)) refreshRoom(graph, room, stamp_s);
  promote(graph, stamp_s, decisions);
  prune(graph, stamp_s, decisions);
  updateRoomAdjacency(graph, snapshot_, assignment_, room_of_region_);
}

void RoomLayer::promote(SceneGraph& graph, double stamp_s, Decisions decisions) {
  const bool is_bootstrapped = graph.nextId(NodeType::kRoom) != firstId(NodeType::kRoom);
  const bool may_go_without =
      decisions == Decisions::kNow && config_.promotion == PromotionEvidence::kObservedArea;
  if (!is_bootstrapped && !may_go_without) return;
  std::set<int> inhabited;
  for (const auto& entry : assignment_.entries()) {
    if (entry.region) inhabited.insert(*entry.region);
  }
  for (const auto& [id, support] : snapshot_.regions()) {
    if (!ownerOf(id) && deservesRoom(support.region, inhabited, stamp_s, decisions)) {
      createRoom(graph, id, RoomReason::kPromoted, stamp_s);
    }
  }
}

bool RoomLayer::deservesRoom(const Region& region, const std::set<int>& inhabited, double stamp_s,
                             Decisions decisions) const {
  if (config_.promotion == PromotionEvidence::kAnyEntity) return inhabited.count(region.id) > 0;
  if (region.area_m2 < config_.min_promoted_area_m2) return false;
  const double age_s = stamp_s - first_seen_s_.at(region.id);
  return decisions == Decisions::kNow || age_s >= config_.min_promoted_age_s - kStampRoundingS;
}

void RoomLayer::prune(SceneGraph& graph, double stamp_s, Decisions decisions) {
  std::vector<NodeId> gone;
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const RoomAttributes& room = roomIn(node);
    if (!room.unsupported_since_s || snapshot_.remembers(room.region_id)) continue;
    const double missing_s = stamp_s - *room.unsupported_since_s;
    if (decisions == Decisions::kNow || missing_s >= config_.removal_grace_s - kStampRoundingS)
      gone.push_back(id);
  }
  for (const NodeId room : gone) removeRoom(graph, room);
}

// While its region is missing a room keeps the members no other room claims: they are what tells
// its successor.
void RoomLayer::syncContainment(SceneGraph& graph) const {
  const auto nobody = room_of_region_.end();
  for (const auto& [entity, position, region] : assignment_.entries()) {
    const auto wanted = region ? room_of_region_.find(*region) : nobody;
    const std::optional<NodeId> held = graph.roomOf(entity);
    if (wanted != nobody) {
      if (held != wanted->second) graph.connect({EdgeType::kContains, wanted->second, entity, {}});
    } else if (held && !graph.room(*held).unsupported_since_s) {
      graph.disconnect(EdgeType::kContains, *held, entity);
    }
  }
}

void RoomLayer::createRoom(SceneGraph& graph, int region, RoomReason reason, double stamp_s) {
  const int number = roomNumber(graph.nextId(NodeType::kRoom));
  RoomAttributes room;
  room.name = "room_" + std::to_string(number);
  room.region_id = region;
  room.reason = reason;
  const Eigen::Vector3d anywhere = Eigen::Vector3d::Zero();
  const NodeId id = graph.add(anywhere, stamp_s, std::move(room)).id;
  room_of_region_.emplace(region, id);
  refreshRoom(graph, id, stamp_s);
}

void RoomLayer::moveRoom(SceneGraph& graph, NodeId room, int region, double stamp_s) {
  Node node = graph.at(room);
  auto& attributes = std::get<RoomAttributes>(node.attributes);
  room_of_region_.erase(attributes.region_id);
  if (snapshot_.remembers(attributes.region_id))
    former_room_of_region_[attributes.region_id] = room;
  attributes.region_id = region;
  attributes.unsupported_since_s.reset();
  graph.update(std::move(node));
  room_of_region_.emplace(region, room);
  former_room_of_region_.erase(region);
  refreshRoom(graph, room, stamp_s);
}

void RoomLayer::refreshRoom(SceneGraph& graph, NodeId room, double stamp_s) const {
  Node node = graph.at(room);
  auto& attributes = std::get<RoomAttributes>(node.attributes);
  const Region& region = snapshot_.regions().at(attributes.region_id).region;
  node.last_seen_s = stamp_s;
  if (attributes.polygon.outer != region.polygon.outer ||
      attributes.polygon.holes != region.polygon.holes) {
    attributes.polygon = region.polygon;
    attributes.area_m2 = region.area_m2;
    const Point2 position = interiorPoint(region.polygon);
    node.position = {position.x, position.y, config_.floor_z_m};
  }
  graph.update(std::move(node));
}

void RoomLayer::removeRoom(SceneGraph& graph, NodeId room) {
  room_of_region_.erase(graph.room(room).region_id);
  for (auto item = former_room_of_region_.begin(); item != former_room_of_region_.end();)
    item = item->second == room ? former_room_of_region_.erase(item) : std::next(item);
  if (current_room_ == room) current_room_.reset();
  graph.remove(room);
}

}  // namespace occusg
