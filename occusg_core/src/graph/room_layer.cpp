// SPDX-License-Identifier: BSD-3-Clause
#include "graph/room_layer.hpp"

#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "graph/interior_point.hpp"

namespace occusg {
namespace {

constexpr double kStampRoundingS = 1e-6;

}  // namespace

RoomLayer::RoomLayer(const RoomLayerConfig& config)
    : config_(checked(config)), assignment_(config.boundary_tolerance_m) {}

void RoomLayer::update(SceneGraph& graph, const TrackedRegions& tracked,
                       const std::optional<Point2>& robot, double stamp_s,
                       Maintenance maintenance) {
  snapshot_.update(tracked);
  assignment_.update(graph, snapshot_);
  adjacency_.observe(graph, snapshot_, assignment_);
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
  adjacency_.observe(graph, snapshot_, assignment_);
  if (snapshot_.state() == SnapshotState::kFresh) maintain(graph, stamp_s, Decisions::kNow);
  syncContainment(graph);
}

void RoomLayer::restore(const SceneGraph& graph, const RoomLayerState& state) {
  *this = RoomLayer(config_);
  first_seen_s_ = state.first_seen_s;
  former_room_of_region_ = state.former_room_of_region;
  adjacency_.restore(graph);
  assignment_.restore(graph);
  for (const auto& item : first_seen_s_) restored_regions_.insert(item.first);
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const RoomAttributes& room = std::get<RoomAttributes>(node.attributes);
    room_of_region_.emplace(room.region_id, id);
    restored_regions_.insert(room.region_id);
    if (room.unsupported_since_s) lost_rooms_.insert(id);
    noteRoom(id);
  }
}

std::optional<NodeId> RoomLayer::ownerOf(int region) const {
  const auto found = room_of_region_.find(region);
  if (found == room_of_region_.end()) return std::nullopt;
  return found->second;
}

void RoomLayer::noteSupport(SceneGraph& graph, double stamp_s) {
  std::set<int> regions = std::exchange(restored_regions_, {});
  regions.insert(snapshot_.changedRegions().begin(), snapshot_.changedRegions().end());
  for (const int region : regions) {
    const bool is_there = snapshot_.has(region);
    if (is_there) {
      first_seen_s_.emplace(region, stamp_s);
      changed_footprints_.insert(region);
      if (!ownerOf(region)) unowned_regions_.insert(region);
    } else {
      absent_regions_.insert(region);
      changed_footprints_.erase(region);
      unowned_regions_.erase(region);
    }
    const std::optional<NodeId> room = ownerOf(region);
    if (!room || graph.room(*room).unsupported_since_s.has_value() != is_there) continue;
    Node node = graph.at(*room);
    std::get<RoomAttributes>(node.attributes).unsupported_since_s =
        is_there ? std::nullopt : std::optional<double>(stamp_s);
    graph.update(std::move(node));
    noteRoom(*room);
    if (is_there) {
      lost_rooms_.erase(*room);
    } else {
      lost_rooms_.insert(*room);
    }
  }
  dropForgottenRegions();
}

void RoomLayer::dropForgottenRegions() {
  for (auto item = absent_regions_.begin(); item != absent_regions_.end();) {
    const bool is_forgotten = !snapshot_.remembers(*item);
    if (is_forgotten) {
      first_seen_s_.erase(*item);
      former_room_of_region_.erase(*item);
    }
    item = is_forgotten || snapshot_.has(*item) ? absent_regions_.erase(item) : std::next(item);
  }
}

void RoomLayer::noteRoom(NodeId room) {
  changed_rooms_.insert(room);
  adjacency_.noteRoom(room);
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
  if (lost_rooms_.empty()) return;
  const std::vector<LostRoom> lost = lostRooms(graph);
  for (const Successor& successor : successorsOf(lost, unownedRegionsNear(lost), config_))
    moveRoom(graph, successor.room, successor.region, stamp_s);
}

std::vector<LostRoom> RoomLayer::lostRooms(const SceneGraph& graph) const {
  std::vector<LostRoom> lost;
  for (const NodeId id : lost_rooms_) {
    LostRoom entry{id, &graph.room(id).polygon, {}};
    for (const NodeId member : graph.targets(EdgeType::kContains, id))
      entry.members.push_back(graph.at(member).groundPosition());
    lost.push_back(std::move(entry));
  }
  return lost;
}

std::vector<const Region*> RoomLayer::unownedRegionsNear(const std::vector<LostRoom>& lost) const {
  std::set<int> near;
  for (const LostRoom& room : lost) {
    for (const int region : snapshot_.touching(bounds(*room.footprint)))
      if (!ownerOf(region)) near.insert(region);
  }
  std::vector<const Region*> unowned;
  unowned.reserve(near.size());
  for (const int region : near) unowned.push_back(&snapshot_.regions().at(region).region);
  return unowned;
}

void RoomLayer::followRobot(SceneGraph& graph, const std::optional<Point2>& robot, double stamp_s) {
  current_region_ = robot
                        ? regionAt(snapshot_, *robot, config_.boundary_tolerance_m, current_region_)
                        : std::nullopt;
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
  const std::set<int> changed = changed_footprints_;
  for (const int region : changed)
    if (const auto room = ownerOf(region)) refreshRoom(graph, *room, stamp_s);
  promote(graph, stamp_s, decisions);
  prune(graph, stamp_s, decisions);
  adjacency_.apply(graph, snapshot_, room_of_region_, stamp_s);
}

void RoomLayer::promote(SceneGraph& graph, double stamp_s, Decisions decisions) {
  const bool is_bootstrapped = graph.nextId(NodeType::kRoom) != firstId(NodeType::kRoom);
  const bool may_go_without =
      decisions == Decisions::kNow && config_.promotion == PromotionEvidence::kObservedArea;
  if (!is_bootstrapped && !may_go_without) return;
  std::vector<int> deserving;
  for (const int id : unowned_regions_) {
    if (deservesRoom(snapshot_.regions().at(id).region, stamp_s, decisions))
      deserving.push_back(id);
  }
  for (const int region : deserving) createRoom(graph, region, RoomReason::kPromoted, stamp_s);
}

bool RoomLayer::deservesRoom(const Region& region, double stamp_s, Decisions decisions) const {
  if (config_.promotion == PromotionEvidence::kAnyEntity)
    return !assignment_.entitiesOf(region.id).empty();
  if (region.area_m2 < config_.min_promoted_area_m2) return false;
  const double age_s = stamp_s - first_seen_s_.at(region.id);
  return decisions == Decisions::kNow || age_s >= config_.min_promoted_age_s - kStampRoundingS;
}

void RoomLayer::prune(SceneGraph& graph, double stamp_s, Decisions decisions) {
  std::vector<NodeId> gone;
  for (const NodeId id : lost_rooms_) {
    const RoomAttributes& room = graph.room(id);
    if (snapshot_.remembers(room.region_id)) continue;
    const double missing_s = stamp_s - *room.unsupported_since_s;
    if (decisions == Decisions::kNow || missing_s >= config_.removal_grace_s - kStampRoundingS)
      gone.push_back(id);
  }
  for (const NodeId room : gone) removeRoom(graph, room);
}

void RoomLayer::syncContainment(SceneGraph& graph) {
  std::set<NodeId> entities(assignment_.reassigned().begin(), assignment_.reassigned().end());
  for (const NodeId room : changed_rooms_) {
    if (graph.find(room) == nullptr) continue;
    const std::set<NodeId>& held = assignment_.entitiesOf(graph.room(room).region_id);
    entities.insert(held.begin(), held.end());
    for (const NodeId member : graph.targets(EdgeType::kContains, room)) entities.insert(member);
  }
  changed_rooms_.clear();
  for (const NodeId entity : entities) syncEntity(graph, entity);
}

// While its region is missing a room keeps the members no other room claims: they are what tells
// its successor.
void RoomLayer::syncEntity(SceneGraph& graph, NodeId entity) const {
  const std::optional<int> region = assignment_.regionOf(entity);
  const std::optional<NodeId> wanted = region ? ownerOf(*region) : std::nullopt;
  const std::optional<NodeId> held = graph.roomOf(entity);
  if (wanted) {
    if (held != wanted) graph.connect({EdgeType::kContains, *wanted, entity, {}});
  } else if (held && !graph.room(*held).unsupported_since_s) {
    graph.disconnect(EdgeType::kContains, *held, entity);
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
  unowned_regions_.erase(region);
  noteRoom(id);
  refreshRoom(graph, id, stamp_s);
}

void RoomLayer::moveRoom(SceneGraph& graph, NodeId room, int region, double stamp_s) {
  Node node = graph.at(room);
  auto& attributes = std::get<RoomAttributes>(node.attributes);
  room_of_region_.erase(attributes.region_id);
  if (snapshot_.remembers(attributes.region_id))
    former_room_of_region_[attributes.region_id] = room;
  if (snapshot_.has(attributes.region_id)) unowned_regions_.insert(attributes.region_id);
  unowned_regions_.erase(region);
  attributes.region_id = region;
  attributes.unsupported_since_s.reset();
  graph.update(std::move(node));
  room_of_region_.emplace(region, room);
  former_room_of_region_.erase(region);
  lost_rooms_.erase(room);
  noteRoom(room);
  refreshRoom(graph, room, stamp_s);
}

void RoomLayer::refreshRoom(SceneGraph& graph, NodeId room, double stamp_s) {
  Node node = graph.at(room);
  auto& attributes = std::get<RoomAttributes>(node.attributes);
  changed_footprints_.erase(attributes.region_id);
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
  const int region = graph.room(room).region_id;
  room_of_region_.erase(region);
  if (snapshot_.has(region)) unowned_regions_.insert(region);
  for (auto item = former_room_of_region_.begin(); item != former_room_of_region_.end();)
    item = item->second == room ? former_room_of_region_.erase(item) : std::next(item);
  if (current_room_ == room) current_room_.reset();
  lost_rooms_.erase(room);
  graph.remove(room);
}

}  // namespace occusg
