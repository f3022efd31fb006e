// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "occusg/graph/region_snapshot.hpp"
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
  struct Entry {
    NodeId entity = 0;
    Point2 position;
    std::optional<int> region;
  };

  explicit EntityAssignment(double boundary_tolerance_m);

  /// Resolves the entities that are new, have moved, or lie where the snapshot changed.
  void update(const SceneGraph& graph, const RegionSnapshot& snapshot);

  [[nodiscard]] std::optional<int> regionOf(NodeId entity) const;
  /// All entities of the graph at the last update, in the order of their ids.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// How many entities the last update resolved; the others kept their region.
  [[nodiscard]] std::size_t resolvedCount() const { return resolved_count_; }

 private:
  double tolerance_m_;
  std::vector<Entry> entries_;   ///< By entity.
  std::vector<Entry> previous_;  ///< Those of the update before; kept for its memory.
  std::size_t resolved_count_ = 0;
};

}  // namespace occusg
