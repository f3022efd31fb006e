// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "graph/region_snapshot.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// The region that holds `point`: it is inside (boundary included) or at most `tolerance_m` away.
/// Inside wins over near, the innermost of nested regions over the others; then `previous`, the
/// smaller distance, the nearer centroid and the smaller id, in this order.
[[nodiscard]] std::optional<int> regionAt(const RegionSnapshot& snapshot, const Point2& point,
                                          double tolerance_m, std::optional<int> previous);

/// Which region holds which entity (agent, object, navigation node); at most one each.
class EntityAssignment {
 public:
  explicit EntityAssignment(double boundary_tolerance_m);

  /// Goes on with the containment of `graph`, until regions say more.
  void restore(const SceneGraph& graph);

  /// Resolves the entities that are new, have moved, or lie where the snapshot changed; no other is
  /// looked at. Always to be called with the same graph.
  void update(const SceneGraph& graph, const RegionSnapshot& snapshot);

  [[nodiscard]] std::optional<int> regionOf(NodeId entity) const;
  /// The entities a region holds, by id.
  [[nodiscard]] const std::set<NodeId>& entitiesOf(int region) const;
  /// The entities that are new or that the last update gave another region; by id.
  [[nodiscard]] const std::vector<NodeId>& reassigned() const { return reassigned_; }
  /// How many entities the last update resolved; the others kept their region.
  [[nodiscard]] std::size_t resolvedCount() const { return resolved_count_; }

 private:
  struct Entry {
    Point2 position;
    std::optional<int> region;
  };

  [[nodiscard]] std::set<NodeId> affected(const SceneGraph& graph,
                                          const RegionSnapshot& snapshot) const;
  void resolve(const Node& entity, const RegionSnapshot& snapshot);
  void forget(NodeId entity);
  void forgetMissing(const SceneGraph& graph);

  double tolerance_m_;
  std::unordered_map<NodeId, Entry> entries_;
  std::map<int, std::set<NodeId>> entities_of_region_;
  std::set<NodeId> restored_;  ///< Known to a saved graph, not yet resolved again.
  std::vector<NodeId> reassigned_;
  Revision revision_ = 0;  ///< Of the graph at the last update.
  std::size_t resolved_count_ = 0;
};

}  // namespace occusg
