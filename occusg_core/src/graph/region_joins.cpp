// SPDX-License-Identifier: BSD-3-Clause
#include "graph/region_joins.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace occusg {

void RegionJoins::update(const SceneGraph& graph, const EntityAssignment& assignment) {
  changed_.clear();
  const GraphChanges changes = graph.changesSince(revision_);
  revision_ = graph.revision();
  std::set<Ends> edges;
  if (changes.complete) {
    for (const auto* list : {&changes.added_edges, &changes.removed_edges}) {
      for (const EdgeKey& edge : *list)
        if (edge.type == EdgeType::kTraversable) edges.emplace(edge.source, edge.target);
    }
  } else {
    for (const auto& [ends, regions] : joins_) edges.insert(ends);
    for (const auto& [ends, edge] : graph.edges(EdgeType::kTraversable)) edges.insert(ends);
  }
  for (const NodeId entity : assignment.reassigned()) {
    for (const NodeId beside : graph.targets(EdgeType::kTraversable, entity))
      edges.insert(std::minmax(entity, beside));
  }
  for (const Ends& edge : edges) refresh(graph, assignment, edge);
}

void RegionJoins::refresh(const SceneGraph& graph, const EntityAssignment& assignment,
                          const Ends& edge) {
  drop(edge);
  if (graph.findEdge(EdgeType::kTraversable, edge.first, edge.second) == nullptr) return;
  const std::optional<int> from = assignment.regionOf(edge.first);
  const std::optional<int> to = assignment.regionOf(edge.second);
  if (!from || !to || *from == *to) return;
  const RegionPair regions = std::minmax(*from, *to);
  joins_.emplace(edge, regions);
  if (++count_[regions] == 1) changed_.insert(regions);
}

void RegionJoins::drop(const Ends& edge) {
  const auto join = joins_.find(edge);
  if (join == joins_.end()) return;
  const auto count = count_.find(join->second);
  if (--count->second == 0) {
    changed_.insert(join->second);
    count_.erase(count);
  }
  joins_.erase(join);
}

}  // namespace occusg
