// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/entity_assignment.hpp"

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

bool isWithin(const Bounds2& bounds, const Point2& point, double margin_m) {
  return point.x >= bounds.min.x - margin_m && point.x <= bounds.max.x + margin_m &&
         point.y >= bounds.min.y - margin_m && point.y <= bounds.max.y + margin_m;
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
  for (const auto& [id, support] : snapshot.regions()) {
    if (!isWithin(support.bounds, point, reach_m)) continue;
    const Polygon& polygon = support.region.polygon;
    if (contains(polygon, point)) {
      around.push_back(&support.region);
    } else if (boundaryDistance(polygon, point) <= reach_m) {
      near.push_back(&support.region);
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

void EntityAssignment::update(const SceneGraph& graph, const RegionSnapshot& snapshot) {
  resolved_count_ = 0;
  const auto isNearChange = [&](const Point2& point) {
    const auto& changes = snapshot.changes();
    return std::any_of(changes.begin(), changes.end(), [&](const Bounds2& bounds) {
      return isWithin(bounds, point, tolerance_m_ + kRoundingM);
    });
  };
  // Nodes and entries are both in the order of ids: one pass over the two.
  std::swap(entries_, previous_);
  entries_.clear();
  auto old = previous_.cbegin();
  for (const NodeType type : kEntityTypes) {
    for (const auto& [id, node] : graph.nodes(type)) {
      while (old != previous_.cend() && old->entity < id) ++old;
      const bool is_known = old != previous_.cend() && old->entity == id;
      const Point2 position = node.groundPosition();
      if (is_known && old->position == position && !isNearChange(position)) {
        entries_.push_back(*old);
        continue;
      }
      const std::optional<int> before = is_known ? old->region : std::nullopt;
      entries_.push_back({id, position, regionAt(snapshot, position, tolerance_m_, before)});
      ++resolved_count_;
    }
  }
}

std::optional<int> EntityAssignment::regionOf(NodeId entity) const {
  const auto found =
      std::lower_bound(entries_.begin(), entries_.end(), entity,
                       [](const Entry& entry, NodeId id) { return entry.entity < id; });
  if (found == entries_.end() || found->entity != entity) return std::nullopt;
  return found->region;
}

}  // namespace occusg
