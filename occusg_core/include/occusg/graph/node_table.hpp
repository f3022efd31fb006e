// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "occusg/graph/node.hpp"
#include "occusg/graph/spatial_index.hpp"

namespace occusg {

/// The nodes of one type: in the order of their ids, by id in constant time, and by place.
class NodeTable {
 public:
  /// By id.
  using NodeMap = std::map<NodeId, Node>;

  NodeTable() = default;
  NodeTable(const NodeTable& other);
  NodeTable& operator=(const NodeTable& other);
  NodeTable(NodeTable&&) = default;
  NodeTable& operator=(NodeTable&&) = default;
  ~NodeTable() = default;

  /// @pre the id is one of the type and larger than all there were.
  const Node& append(Node node);
  /// Replaces the node of that id; false when there is none.
  bool replace(Node node);
  bool erase(NodeId id);

  /// Null when there is none.
  [[nodiscard]] const Node* find(NodeId id) const;
  [[nodiscard]] const NodeMap& nodes() const { return nodes_; }
  [[nodiscard]] const SpatialIndex& places() const { return places_; }

 private:
  NodeMap nodes_;
  /// By id less the type's first id; null where one was removed.
  std::vector<Node*> by_number_;
  SpatialIndex places_;
};

}  // namespace occusg
