// SPDX-License-Identifier: BSD-3-Clause
#include "graph/free_space_links.hpp"

#include <set>
#include <vector>

namespace occusg {
namespace {

constexpr double kHysteresis_m = 0.05;

bool isOf(NodeType type, NodeId id) {
  return id >= firstId(type) && id < firstId(static_cast<NodeType>(static_cast<int>(type) + 1));
}

}  // namespace

FreeSpaceLinks::FreeSpaceLinks(double max_distance_m) : max_distance_m_(max_distance_m) {}

void FreeSpaceLinks::update(SceneGraph& graph) {
  const GraphChanges changes = graph.changesSince(revision_);
  std::set<NodeId> objects;
  if (changes.complete) {
    for (const auto* list : {&changes.added_nodes, &changes.changed_nodes}) {
      for (const NodeId id : *list) {
        if (isOf(NodeType::kObject, id)) objects.insert(id);
        if (!isOf(NodeType::kNavigation, id)) continue;
        const Point2 at = graph.at(id).groundPosition();
        for (const NodeId near : graph.withinRadius(NodeType::kObject, at, max_distance_m_))
          objects.insert(near);
      }
    }
    for (const EdgeKey& edge : changes.removed_edges) {
      if (edge.type == EdgeType::kNearestFreeSpace && graph.find(edge.source) != nullptr)
        objects.insert(edge.source);
    }
  } else {
    for (const auto& [id, node] : graph.nodes(NodeType::kObject)) objects.insert(id);
  }
  for (const NodeId object : objects) link(graph, object);
  revision_ = graph.revision();
}

void FreeSpaceLinks::link(SceneGraph& graph, NodeId object) const {
  const Point2 at = graph.at(object).groundPosition();
  const auto best = graph.nearest(NodeType::kNavigation, at, max_distance_m_);
  const std::vector<NodeId> current = graph.targets(EdgeType::kNearestFreeSpace, object);
  const auto distanceOf = [&](NodeId id) { return distance(graph.at(id).groundPosition(), at); };
  if (best && current.size() == 1 && distanceOf(current.front()) <= max_distance_m_ &&
      distanceOf(*best) >= distanceOf(current.front()) - kHysteresis_m)
    return;
  for (const NodeId old : current) graph.disconnect(EdgeType::kNearestFreeSpace, object, old);
  if (best) graph.connect({EdgeType::kNearestFreeSpace, object, *best, {}});
}

}  // namespace occusg
