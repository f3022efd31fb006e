// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "occusg/graph/edge.hpp"
#include "occusg/graph/node.hpp"

namespace occusg {

/// The hierarchical 3D scene graph (paper, Sec. 3.1): nodes and edges, indexed by type and id.
/// Everything iterates in the order of ids. Look-ups are logarithmic; none scans.
///
/// Five functions change it: `add`, `update`, `remove`, `connect`, `disconnect`. They keep its
/// rules: edges join existing nodes of the right types, a member is in at most one room, temporal
/// edges lead to younger agents, and an id is never used twice.
class SceneGraph {
 public:
  using NodeMap = std::map<NodeId, Node>;
  using EdgeMap = std::map<std::pair<NodeId, NodeId>, Edge>;  ///< By (source, target).

  /// Adds a node of the type of `attributes`, created and last seen at `stamp_s`.
  /// @throws Error when the position or the stamp is not finite, or the type has no ids left.
  const Node& add(const Eigen::Vector3d& position, double stamp_s, NodeAttributes attributes);

  /// Replaces the node of that id.
  /// @throws Error when there is none, its type differs, or a value is not finite.
  void update(Node node);

  /// Removes the node and its edges; false when there is none.
  bool remove(NodeId id);

  /// Adds the edge or replaces its attributes; the ends of an undirected one in either order. A
  /// member connected to a room leaves the room it was in.
  /// @throws Error when an end is missing or of the wrong type, or both are the same.
  void connect(Edge edge);

  /// Removes the edge; false when there is none.
  bool disconnect(EdgeType type, NodeId source, NodeId target);

  /// The id the next node of that type will get.
  [[nodiscard]] NodeId nextId(NodeType type) const;
  /// Null when there is none. Stays valid until that node is removed.
  [[nodiscard]] const Node* find(NodeId id) const;
  /// @throws Error when there is none.
  [[nodiscard]] const Node& at(NodeId id) const;
  /// @throws Error when there is no room of that id.
  [[nodiscard]] const RoomAttributes& room(NodeId id) const;
  [[nodiscard]] const NodeMap& nodes(NodeType type) const;
  [[nodiscard]] std::size_t nodeCount() const;

  [[nodiscard]] const EdgeMap& edges(EdgeType type) const;
  [[nodiscard]] std::size_t edgeCount() const;
  /// Null when there is none; the ends of an undirected edge in either order.
  [[nodiscard]] const Edge* findEdge(EdgeType type, NodeId source, NodeId target) const;
  /// Ends of the edges that leave `source`; of an undirected type, all its neighbours. Sorted.
  [[nodiscard]] std::vector<NodeId> targets(EdgeType type, NodeId source) const;
  /// Starts of the edges that arrive at `target`; of an undirected type, all its neighbours.
  [[nodiscard]] std::vector<NodeId> sources(EdgeType type, NodeId target) const;
  /// The room that contains the node.
  [[nodiscard]] std::optional<NodeId> roomOf(NodeId member) const;

 private:
  struct Edges {
    EdgeMap by_source;
    std::set<std::pair<NodeId, NodeId>> by_target;  ///< (target, source).
  };

  void checkEnds(const Edge& edge) const;
  void removeEdges(EdgeType type, NodeId node);

  std::array<NodeMap, kNodeTypeCount> nodes_;
  std::array<NodeId, kNodeTypeCount> added_{};  ///< How many nodes of each type there ever were.
  std::array<Edges, kEdgeTypeCount> edges_;
};

}  // namespace occusg
