// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "occusg/graph/edge.hpp"
#include "occusg/graph/node.hpp"

namespace occusg {

/// Counts the changes of a graph: zero before the first.
using Revision = std::uint64_t;

/// What names an edge.
struct EdgeKey {
  EdgeType type = EdgeType::kTemporal;
  NodeId source = 0;
  NodeId target = 0;

  friend bool operator==(const EdgeKey& a, const EdgeKey& b) {
    return a.type == b.type && a.source == b.source && a.target == b.target;
  }
  /// By type, source, target.
  friend bool operator<(const EdgeKey& a, const EdgeKey& b) {
    if (a.type != b.type) return a.type < b.type;
    return a.source != b.source ? a.source < b.source : a.target < b.target;
  }
};

/// How a graph differs from what it was: the net effect, so what came and went again is not in it.
/// All lists are sorted.
struct GraphChanges {
  bool complete = true;  ///< False: the log does not reach back so far; take the whole graph.
  std::vector<NodeId> added_nodes;
  std::vector<NodeId> changed_nodes;
  std::vector<NodeId> removed_nodes;
  std::vector<EdgeKey> added_edges;
  std::vector<EdgeKey> changed_edges;
  std::vector<EdgeKey> removed_edges;
};

enum class ChangeKind { kAdded, kChanged, kRemoved };

/// The last changes of a graph, so that a follower need not compare whole graphs. Memory is
/// bounded: the oldest are forgotten.
class ChangeLog {
 public:
  static constexpr std::size_t kCapacity = std::size_t{1} << 16U;

  /// Changes recorded from now on belong to this stamp; one before the last counts as the last.
  void setStamp(double stamp_s);
  void record(ChangeKind kind, NodeId node);
  void record(ChangeKind kind, const EdgeKey& edge);

  [[nodiscard]] Revision revision() const { return revision_; }
  /// The revision after all remembered changes up to `stamp_s`.
  [[nodiscard]] Revision revisionAt(double stamp_s) const;
  /// The net changes after `revision`. Cost follows their number.
  [[nodiscard]] GraphChanges since(Revision revision) const;

 private:
  struct Entry {
    double stamp_s = 0.0;
    ChangeKind kind = ChangeKind::kAdded;
    bool is_edge = false;
    EdgeKey key;  ///< Of a node: its id is the source.
  };

  void record(Entry entry);

  std::deque<Entry> entries_;  ///< The last of them made `revision_`.
  Revision revision_ = 0;
  double stamp_s_ = 0.0;
  bool has_stamp_ = false;
};

}  // namespace occusg
