// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/scene_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/graph/limits.hpp"

namespace occusg {
namespace {

constexpr const char* kWhere = "scene graph";

std::size_t indexOf(NodeType type) { return static_cast<std::size_t>(type); }
std::size_t indexOf(EdgeType type) { return static_cast<std::size_t>(type); }

constexpr EdgeType kEdgeTypes[kEdgeTypeCount] = {
    EdgeType::kTemporal, EdgeType::kContains, EdgeType::kTraversable, EdgeType::kNearestFreeSpace,
    EdgeType::kRoomAdjacency};

/// One past the last id before those of the next type begin.
NodeId endOfFirstIds(NodeType type) {
  const std::size_t next = indexOf(type) + 1;
  return next == kNodeTypeCount ? kFurtherAgents : kNodeTypes[next].first_id;
}

NodeId endOfIds(NodeType type) { return type == NodeType::kAgent ? kIdEnd : endOfFirstIds(type); }

void checkFinite(const Eigen::Vector3d& position, double created_s, double last_seen_s) {
  if (!isWithinGraph(position)) {
    throw refuse(kWhere, "a node's position is not finite or beyond 1e6 m",
                 "positions are in metres, map frame");
  }
  if (!std::isfinite(created_s) || !std::isfinite(last_seen_s))
    throw refuse(kWhere, "a node's stamp is not finite", "stamps are in seconds");
}

bool fits(EdgeType type, NodeType source, NodeType target) {
  switch (type) {
    case EdgeType::kTemporal:
      return source == NodeType::kAgent && target == NodeType::kAgent;
    case EdgeType::kContains:
      return source == NodeType::kRoom &&
             (target == NodeType::kAgent || target == NodeType::kObject ||
              target == NodeType::kNavigation);
    case EdgeType::kTraversable:
      return source == NodeType::kNavigation && target == NodeType::kNavigation;
    case EdgeType::kNearestFreeSpace:
      return source == NodeType::kObject && target == NodeType::kNavigation;
    case EdgeType::kRoomAdjacency:
      return source == NodeType::kRoom && target == NodeType::kRoom;
  }
  return false;
}

using Ends = std::pair<NodeId, NodeId>;

/// The key an edge is stored under.
Ends keyOf(EdgeType type, NodeId source, NodeId target) {
  if (!isDirected(type) && target < source) return {target, source};
  return {source, target};
}

const Ends& endsOf(const Ends& key) { return key; }
const Ends& endsOf(const SceneGraph::EdgeMap::value_type& item) { return item.first; }

/// Appends the second ends of the items of an ordered container that have that first end.
template <typename Container>
void appendPartners(const Container& container, NodeId first, std::vector<NodeId>& partners) {
  auto item = container.lower_bound({first, std::numeric_limits<NodeId>::min()});
  for (; item != container.end() && endsOf(*item).first == first; ++item) {
    partners.push_back(endsOf(*item).second);
  }
}

}  // namespace

std::optional<NodeType> typeOfId(NodeId id) {
  if (id < 0 || id >= kIdEnd) return std::nullopt;
  if (id >= kFurtherAgents) return NodeType::kAgent;
  std::size_t type = 0;
  while (id >= endOfFirstIds(static_cast<NodeType>(type))) ++type;
  return static_cast<NodeType>(type);
}

NodeId numberOfId(NodeType type, NodeId id) {
  const bool is_further = type == NodeType::kAgent && id >= kFurtherAgents;
  return is_further ? id - kFurtherAgents + endOfFirstIds(type) : id - firstId(type);
}

NodeId idOfNumber(NodeType type, NodeId number) {
  const NodeId id = firstId(type) + number;
  const bool is_further = type == NodeType::kAgent && id >= endOfFirstIds(type);
  return is_further ? id - endOfFirstIds(type) + kFurtherAgents : id;
}

const char* nameOf(NodeType type) { return kNodeTypes[indexOf(type)].name; }

const char* nameOf(EdgeType type) {
  constexpr const char* kNames[kEdgeTypeCount] = {
      "TEMPORAL_LINK", "ROOM_CONTAINS", "NAVIGABLE_PATH", "NEAREST_FREE_SPACE", "ROOM_ADJACENCY"};
  return kNames[indexOf(type)];
}

const Node& SceneGraph::add(const Eigen::Vector3d& position, double stamp_s,
                            NodeAttributes attributes, int floor_id) {
  checkFinite(position, stamp_s, stamp_s);
  Node node;
  node.position = position;
  node.created_s = stamp_s;
  node.last_seen_s = stamp_s;
  node.floor_id = floor_id;
  node.attributes = std::move(attributes);
  const NodeType type = node.type();
  node.id = nextId(type);
  if (node.id >= endOfIds(type)) {
    throw refuse(kWhere, std::string("no ids are left for nodes of type ") + nameOf(type),
                 "start a new graph");
  }
  ++added_[indexOf(type)];
  log_.record(ChangeKind::kAdded, node.id);
  return nodes_[indexOf(type)].append(std::move(node));
}

const Node& SceneGraph::restore(Node node) {
  checkFinite(node.position, node.created_s, node.last_seen_s);
  const NodeType type = node.type();
  if (typeOfId(node.id) != type || node.id < nextId(type)) {
    throw refuse(
        kWhere,
        "there is no place for " + std::string(nameOf(type)) + " node " + std::to_string(node.id),
        "ids from " + std::to_string(nextId(type)) + " to " + std::to_string(endOfIds(type) - 1) +
            " are free");
  }
  added_[indexOf(type)] = numberOfId(type, node.id) + 1;
  log_.record(ChangeKind::kAdded, node.id);
  return nodes_[indexOf(type)].append(std::move(node));
}

void SceneGraph::skipIdsBefore(NodeType type, NodeId id) {
  const bool is_end = id == endOfFirstIds(type);
  if (!is_end && typeOfId(id) != type) {
    throw refuse(kWhere, std::to_string(id) + " is no id of type " + nameOf(type),
                 "ids from " + std::to_string(firstId(type)) + " on are");
  }
  added_[indexOf(type)] = std::max(added_[indexOf(type)], numberOfId(type, id));
}

void SceneGraph::update(Node node) {
  checkFinite(node.position, node.created_s, node.last_seen_s);
  const NodeId id = node.id;
  const NodeType type = node.type();
  if (!nodes_[indexOf(type)].replace(std::move(node))) {
    throw refuse(
        kWhere,
        "there is no " + std::string(nameOf(type)) + " node " + std::to_string(id) + " to update",
        "add it first, and keep its type");
  }
  log_.record(ChangeKind::kChanged, id);
}

bool SceneGraph::remove(NodeId id) {
  const std::optional<NodeType> type = typeOfId(id);
  if (!type || nodes_[indexOf(*type)].find(id) == nullptr) return false;
  for (const EdgeType edge_type : kEdgeTypes) removeEdges(edge_type, id);
  nodes_[indexOf(*type)].erase(id);
  log_.record(ChangeKind::kRemoved, id);
  return true;
}

void SceneGraph::connect(Edge edge) {
  checkEnds(edge);
  const Ends key = keyOf(edge.type, edge.source, edge.target);
  edge.source = key.first;
  edge.target = key.second;
  if (edge.type == EdgeType::kContains) {
    const std::optional<NodeId> room = roomOf(edge.target);
    if (room && *room != edge.source) disconnect(EdgeType::kContains, *room, edge.target);
  }
  Edges& edges = edges_[indexOf(edge.type)];
  const EdgeKey name{edge.type, key.first, key.second};
  const bool is_new = edges.by_target.emplace(key.second, key.first).second;
  edges.by_source.insert_or_assign(key, std::move(edge));
  log_.record(is_new ? ChangeKind::kAdded : ChangeKind::kChanged, name);
}

bool SceneGraph::disconnect(EdgeType type, NodeId source, NodeId target) {
  const Ends key = keyOf(type, source, target);
  Edges& edges = edges_[indexOf(type)];
  edges.by_target.erase({key.second, key.first});
  if (edges.by_source.erase(key) == 0) return false;
  log_.record(ChangeKind::kRemoved, EdgeKey{type, key.first, key.second});
  return true;
}

NodeId SceneGraph::nextId(NodeType type) const { return idOfNumber(type, added_[indexOf(type)]); }

const Node* SceneGraph::find(NodeId id) const {
  const std::optional<NodeType> type = typeOfId(id);
  return type ? nodes_[indexOf(*type)].find(id) : nullptr;
}

const Node& SceneGraph::at(NodeId id) const {
  const Node* node = find(id);
  if (node == nullptr)
    throw refuse(kWhere, "there is no node " + std::to_string(id), "name a node of the graph");
  return *node;
}

const RoomAttributes& SceneGraph::room(NodeId id) const {
  const auto* room = std::get_if<RoomAttributes>(&at(id).attributes);
  if (room == nullptr)
    throw refuse(kWhere, "node " + std::to_string(id) + " is no room", "name a room");
  return *room;
}

const SceneGraph::NodeMap& SceneGraph::nodes(NodeType type) const {
  return nodes_[indexOf(type)].nodes();
}

std::size_t SceneGraph::nodeCount() const {
  std::size_t count = 0;
  for (const NodeTable& table : nodes_) count += table.nodes().size();
  return count;
}

const SceneGraph::EdgeMap& SceneGraph::edges(EdgeType type) const {
  return edges_[indexOf(type)].by_source;
}

std::size_t SceneGraph::edgeCount() const {
  std::size_t count = 0;
  for (const Edges& edges : edges_) count += edges.by_source.size();
  return count;
}

const Edge* SceneGraph::findEdge(EdgeType type, NodeId source, NodeId target) const {
  const EdgeMap& edges = edges_[indexOf(type)].by_source;
  const auto found = edges.find(keyOf(type, source, target));
  return found == edges.end() ? nullptr : &found->second;
}

std::vector<NodeId> SceneGraph::targets(EdgeType type, NodeId source) const {
  const Edges& edges = edges_[indexOf(type)];
  std::vector<NodeId> ids;
  // Undirected edges lead from smaller to larger: arriving first keeps the ids sorted.
  if (!isDirected(type)) appendPartners(edges.by_target, source, ids);
  appendPartners(edges.by_source, source, ids);
  return ids;
}

std::vector<NodeId> SceneGraph::sources(EdgeType type, NodeId target) const {
  if (!isDirected(type)) return targets(type, target);
  std::vector<NodeId> ids;
  appendPartners(edges_[indexOf(type)].by_target, target, ids);
  return ids;
}

std::optional<NodeId> SceneGraph::roomOf(NodeId member) const {
  const auto& by_member = edges_[indexOf(EdgeType::kContains)].by_target;
  const auto found = by_member.lower_bound({member, std::numeric_limits<NodeId>::min()});
  if (found == by_member.end() || found->first != member) return std::nullopt;
  return found->second;
}

std::optional<NodeId> SceneGraph::nearest(NodeType type, const Point2& point, double max_distance_m,
                                          const std::function<bool(const Node&)>& accept) const {
  const NodeTable& table = nodes_[indexOf(type)];
  return table.places().nearest(point, max_distance_m,
                                [&](NodeId id) { return accept(*table.find(id)); });
}

std::vector<NodeId> SceneGraph::withinRadius(NodeType type, const Point2& center,
                                             double radius_m) const {
  const NodeTable& table = nodes_[indexOf(type)];
  std::vector<std::pair<double, NodeId>> near;
  for (const NodeId id : table.places().touching({{center.x - radius_m, center.y - radius_m},
                                                  {center.x + radius_m, center.y + radius_m}})) {
    const double distance_m = distance(table.find(id)->groundPosition(), center);
    if (distance_m <= radius_m) near.emplace_back(distance_m, id);
  }
  std::sort(near.begin(), near.end());
  std::vector<NodeId> ids;
  ids.reserve(near.size());
  for (const auto& [distance_m, id] : near) ids.push_back(id);
  return ids;
}

std::vector<NodeId> SceneGraph::inBox(NodeType type, const Bounds2& box) const {
  return nodes_[indexOf(type)].places().touching(box);
}

void SceneGraph::setStamp(double stamp_s) {
  if (!std::isfinite(stamp_s))
    throw refuse(kWhere, "the stamp of its changes is not finite", "stamps are in seconds");
  log_.setStamp(stamp_s);
}

void SceneGraph::checkEnds(const Edge& edge) const {
  const auto ends = [&] {
    return std::string(nameOf(edge.type)) + " edge from " + std::to_string(edge.source) + " to " +
           std::to_string(edge.target);
  };
  const Node* source = find(edge.source);
  const Node* target = find(edge.target);
  if (source == nullptr || target == nullptr)
    throw refuse(kWhere, ends() + ": an end does not exist", "add both nodes first");
  if (!fits(edge.type, source->type(), target->type())) {
    throw refuse(kWhere, ends() + " joins nodes of the wrong types",
                 std::string("found ") + nameOf(source->type()) + " and " + nameOf(target->type()));
  }
  if (edge.source == edge.target)
    throw refuse(kWhere, ends() + " joins a node to itself", "name two nodes");
  if (edge.type == EdgeType::kTemporal && edge.source > edge.target)
    throw refuse(kWhere, ends() + " leads back in time", "name the older agent first");
}

void SceneGraph::removeEdges(EdgeType type, NodeId node) {
  for (const NodeId source : sources(type, node)) disconnect(type, source, node);
  for (const NodeId target : targets(type, node)) disconnect(type, node, target);
}

}  // namespace occusg
