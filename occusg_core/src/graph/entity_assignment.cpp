// SPDX-License-Identifier: BSD-3-Clause
#include "graph/entity_assignment.hpp"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

namespace occusg {
namespace {

// In the order of their ids.
constexpr NodeType kEntityTypes[] = {NodeType::kAgent, NodeType::kObject, NodeType::kNavigation};

// Lets a point at exactly the tolerance in, and tells the inside from the boundary.
constexpr double kRoundingM = 1e-9;

Bounds2 grown(const Bounds2& bounds, double margin_m) {
  return {{bounds.min.x - margin_m, bounds.min.y - margin_m},
          {bounds.max.x + margin_m, bounds.max.y + margin_m}};
}

bool isEntity(NodeId id) {
  return (id >= firstId(NodeType::kAgent) && id < firstId(NodeType::kRoom)) || id >= kFurtherAgents;
}

/// What decides between regions, in this order, smallest first: the innermost; the one before;
/// distance to the polygon and to the centroid; id.
using Rank = std::tuple<double, bool, double, double, int>;

Rank rankOf(const Region& region, const Point2& point, bool is_inside,
            std::optional<int> previous) {
  const double boundary_m = boundaryDistance(region.polygon, point);
  // On a common boundary neighbours hold the point equally: none is inside the other.
  const bool is_strictly_inside = is_inside && boundary_m > kRoundingM;
  return {is_strictly_inside ? region.area_m2 : 0.0, previous != region.id,
          is_inside ? 0.0 : boundary_m, distance(region.centroid, point), region.id};
}

}  // namespace

std::optional<int> regionAt(const RegionSnapshot& snapshot, const Point2& point, double tolerance_m,
                            std::optional<int> previous) {
  const double reach_m = tolerance_m + kRoundingM;
  std::vector<const Region*> near;
  std::vector<const Region*> around;
  for (const int id : snapshot.touching(grown({point, point}, reach_m))) {
    const Region& region = snapshot.regions().at(id).region;
    if (contains(region.polygon, point)) {
      around.push_back(&region);
    } else if (boundaryDistance(region.polygon, point) <= reach_m) {
      near.push_back(&region);
    }
  }
  const bool is_inside = !around.empty();
  const auto& candidates = is_inside ? around : near;
  if (candidates.empty()) return std::nullopt;
  if (candidates.size() == 1) return candidates.front()->id;
  const Region* const best = *std::min_element(
      candidates.begin(), candidates.end(), [&](const Region* a, const Region* b) {
        return rankOf(*a, point, is_inside, previous) < rankOf(*b, point, is_inside, previous);
      });
  return best->id;
}

EntityAssignment::EntityAssignment(double boundary_tolerance_m)
    : tolerance_m_(boundary_tolerance_m) {}

void EntityAssignment::restore(const SceneGraph& graph) {
  *this = EntityAssignment(tolerance_m_);
  for (const auto& [ends, edge] : graph.edges(EdgeType::kContains)) {
    const int region = graph.room(edge.source).region_id;
    entries_[edge.target] = {graph.at(edge.target).groundPosition(), region};
    entities_of_region_[region].insert(edge.target);
    restored_.insert(edge.target);
  }
  revision_ = graph.revision();
}

void EntityAssignment::update(const SceneGraph& graph, const RegionSnapshot& snapshot) {
  resolved_count_ = 0;
  reassigned_.clear();
  const GraphChanges changes = graph.changesSince(revision_);
  std::set<NodeId> entities = affected(graph, snapshot);
  if (snapshot.state() == SnapshotState::kFresh) {
    for (const NodeId id : std::exchange(restored_, {}))
      if (graph.find(id) != nullptr) entities.insert(id);
  }
  if (changes.complete) {
    for (const NodeId id : changes.removed_nodes) forget(id);
    for (const NodeId id : changes.added_nodes)
      if (isEntity(id)) entities.insert(id);
    for (const NodeId id : changes.changed_nodes) {
      if (!isEntity(id)) continue;
      const auto known = entries_.find(id);
      if (known == entries_.end() || known->second.position != graph.at(id).groundPosition())
        entities.insert(id);
    }
  } else {
    forgetMissing(graph);
    for (const NodeType type : kEntityTypes)
      for (const auto& [id, node] : graph.nodes(type)) entities.insert(id);
  }
  revision_ = graph.revision();
  for (const NodeId id : entities) resolve(graph.at(id), snapshot);
}

std::set<NodeId> EntityAssignment::affected(const SceneGraph& graph,
                                            const RegionSnapshot& snapshot) const {
  std::set<NodeId> entities;
  for (const Bounds2& bounds : snapshot.changes()) {
    const Bounds2 reach = grown(bounds, tolerance_m_ + kRoundingM);
    for (const NodeType type : kEntityTypes)
      for (const NodeId id : graph.inBox(type, reach)) entities.insert(id);
  }
  return entities;
}

void EntityAssignment::resolve(const Node& entity, const RegionSnapshot& snapshot) {
  ++resolved_count_;
  const auto [item, is_new] = entries_.try_emplace(entity.id);
  Entry& entry = item->second;
  const std::optional<int> before = entry.region;
  entry.position = entity.groundPosition();
  entry.region = regionAt(snapshot, entry.position, tolerance_m_, before);
  if (!is_new && entry.region == before) return;
  reassigned_.push_back(entity.id);
  if (before) entities_of_region_[*before].erase(entity.id);
  if (entry.region) entities_of_region_[*entry.region].insert(entity.id);
  if (before && entities_of_region_[*before].empty()) entities_of_region_.erase(*before);
}

void EntityAssignment::forget(NodeId entity) {
  const auto entry = entries_.find(entity);
  if (entry == entries_.end()) return;
  if (entry->second.region) {
    const auto held = entities_of_region_.find(*entry->second.region);
    held->second.erase(entity);
    if (held->second.empty()) entities_of_region_.erase(held);
  }
  entries_.erase(entry);
}

void EntityAssignment::forgetMissing(const SceneGraph& graph) {
  std::vector<NodeId> missing;
  for (const auto& [id, entry] : entries_)
    if (graph.find(id) == nullptr) missing.push_back(id);
  for (const NodeId id : missing) forget(id);
}

std::optional<int> EntityAssignment::regionOf(NodeId entity) const {
  const auto entry = entries_.find(entity);
  return entry == entries_.end() ? std::nullopt : entry->second.region;
}

const std::set<NodeId>& EntityAssignment::entitiesOf(int region) const {
  static const std::set<NodeId> none;
  const auto held = entities_of_region_.find(region);
  return held == entities_of_region_.end() ? none : held->second;
}

}  // namespace occusg
