// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "occusg/graph/graph_state.hpp"

namespace occusg {

/// How often two objects were seen in the same frame as two things, which tells neighbours of a
/// class whose boxes overlap from pieces of one object.
class SeenApart {
 public:
  SeenApart() = default;
  explicit SeenApart(const ObjectPairCounts& pairs);

  void add(NodeId a, NodeId b);
  [[nodiscard]] int count(NodeId a, NodeId b) const;
  /// `gone` has become part of `kept`: what was apart from it is apart from `kept`.
  void merge(NodeId kept, NodeId gone);
  void erase(NodeId id);
  [[nodiscard]] ObjectPairCounts pairs() const;

 private:
  std::map<NodeId, std::map<NodeId, int>> frames_;  ///< Both ways.
};

}  // namespace occusg
