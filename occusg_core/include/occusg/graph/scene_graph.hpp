// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "occusg/graph/change_log.hpp"
#include "occusg/graph/edge.hpp"
#include "occusg/graph/node.hpp"
#include "occusg/graph/node_table.hpp"

namespace occusg {

/// The hierarchical 3D scene graph (paper, Sec. 3.1): nodes and edges, indexed by type, id and
/// place. Everything iterates in the order of ids. A node is found by its id in constant time, an
/// edge in logarithmic time, what is near a place at the cost of what is there; nothing scans.
///
/// Five functions change it: `add`, `update`, `remove`, `connect`, `disconnect`. They keep its
/// rules: edges join existing nodes of the right types, a member is in at most one room, temporal
/// edges lead to younger agents, and an id is never used twice. All they do is logged.
class SceneGraph {
 public:
  /// Nodes of a type, by id.
  using NodeMap = NodeTable::NodeMap;
  using EdgeMap = std::map<std::pair<NodeId, NodeId>, Edge>;  ///< By (source, target).

  /// Adds a node of the type of `attributes`, created and last seen at `stamp_s`.
  /// @throws Error when the position or the stamp is not finite, or the type has no ids left.
  const Node& add(const Eigen::Vector3d& position, double stamp_s, NodeAttributes attributes,
                  int floor_id = 0);

  /// Puts back a node that was saved, under its own id.
  /// @throws Error as `add`, and when the id is not of the node's type or not beyond all ids of the
  /// type there ever were.
  const Node& restore(Node node);
  /// The next node of the type gets `id` or a later one: ids of removed nodes stay used.
  /// @throws Error when the id is not of the type.
  void skipIdsBefore(NodeType type, NodeId id);

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

  /// The accepted node of the type nearest to `point` in the ground plane, at most `max_distance_m`
  /// away; the smaller id of two equally near.
  [[nodiscard]] std::optional<NodeId> nearest(
      NodeType type, const Point2& point, double max_distance_m,
      const std::function<bool(const Node&)>& accept = [](const Node&) { return true; }) const;
  /// Nodes of the type at most `radius_m` from `center` in the ground plane, nearest first.
  [[nodiscard]] std::vector<NodeId> withinRadius(NodeType type, const Point2& center,
                                                 double radius_m) const;
  /// Nodes of the type in the box, its edge included, by id.
  [[nodiscard]] std::vector<NodeId> inBox(NodeType type, const Bounds2& box) const;

  /// Changes from now on belong to this stamp (see `revisionAt`); it does not go back.
  /// @throws Error when it is not finite.
  void setStamp(double stamp_s);
  /// Counts the changes ever made.
  [[nodiscard]] Revision revision() const { return log_.revision(); }
  /// The revision after all remembered changes up to `stamp_s`.
  [[nodiscard]] Revision revisionAt(double stamp_s) const { return log_.revisionAt(stamp_s); }
  /// What was added, changed and removed after `revision`; the log holds the last
  /// `ChangeLog::kCapacity` changes, and the answer says when it does not reach back so far.
  [[nodiscard]] GraphChanges changesSince(Revision revision) const { return log_.since(revision); }

 private:
  struct Edges {
    EdgeMap by_source;
    std::set<std::pair<NodeId, NodeId>> by_target;  ///< (target, source).
  };

  void checkEnds(const Edge& edge) const;
  void removeEdges(EdgeType type, NodeId node);

  std::array<NodeTable, kNodeTypeCount> nodes_;
  std::array<NodeId, kNodeTypeCount> added_{};  ///< How many nodes of each type there ever were.
  std::array<Edges, kEdgeTypeCount> edges_;
  ChangeLog log_;
};

}  // namespace occusg
