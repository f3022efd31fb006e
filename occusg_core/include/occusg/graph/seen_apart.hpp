// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>

#include "occusg/graph/node.hpp"

namespace occusg {

/// How often two objects were seen in the same frame as two things, which tells neighbours of a
/// class whose boxes overlap from pieces of one object.
class SeenApart {
 public:
  /// In how many frames; the smaller id first.
  using Pairs = std::map<std::pair<NodeId, NodeId>, int>;

  SeenApart() = default;
  explicit SeenApart(const Pairs& pairs);

  void add(NodeId a, NodeId b);
  [[nodiscard]] int count(NodeId a, NodeId b) const;
  /// `gone` has become part of `kept`: what was apart from it is apart from `kept`.
  void merge(NodeId kept, NodeId gone);
  void erase(NodeId id);
  [[nodiscard]] Pairs pairs() const;

 private:
  std::map<NodeId, std::map<NodeId, int>> frames_;  ///< Both ways.
};

}  // namespace occusg
