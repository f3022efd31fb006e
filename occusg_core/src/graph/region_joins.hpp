// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <utility>

#include "graph/entity_assignment.hpp"
#include "graph/region_snapshot.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Between which regions a traversable edge leads: one end in the one, one in the other.
class RegionJoins {
 public:
  /// Follows the edges of the graph and the regions of their ends; looks at what changed. Always to
  /// be called with the same graph, after `assignment` was updated with it.
  void update(const SceneGraph& graph, const EntityAssignment& assignment);

  [[nodiscard]] bool areJoined(const RegionPair& regions) const {
    return count_.count(regions) > 0;
  }
  /// The pairs the last update joined or parted.
  [[nodiscard]] const std::set<RegionPair>& changed() const { return changed_; }

 private:
  using Ends = std::pair<NodeId, NodeId>;

  void refresh(const SceneGraph& graph, const EntityAssignment& assignment, const Ends& edge);
  void drop(const Ends& edge);

  std::map<Ends, RegionPair> joins_;  ///< By edge; those that lead from region to region.
  std::map<RegionPair, int> count_;   ///< How many such edges there are.
  std::set<RegionPair> changed_;
  Revision revision_ = 0;
};

}  // namespace occusg
