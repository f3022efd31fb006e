// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/node_table.hpp"

#include <cstddef>
#include <utility>

namespace occusg {
namespace {

std::size_t numberOf(NodeId id, NodeType type) {
  return static_cast<std::size_t>(numberOfId(type, id));
}

Bounds2 placeOf(const Node& node) { return {node.groundPosition(), node.groundPosition()}; }

}  // namespace

NodeTable::NodeTable(const NodeTable& other)
    : nodes_(other.nodes_), by_number_(other.by_number_.size(), nullptr), places_(other.places_) {
  for (auto& [id, node] : nodes_) by_number_[numberOf(id, node.type())] = &node;
}

NodeTable& NodeTable::operator=(const NodeTable& other) {
  if (this != &other) *this = NodeTable(other);
  return *this;
}

const Node& NodeTable::append(Node node) {
  const NodeId id = node.id;
  const std::size_t number = numberOf(id, node.type());
  places_.insert(id, placeOf(node));
  Node& stored = nodes_.emplace_hint(nodes_.end(), id, std::move(node))->second;
  by_number_.resize(number + 1, nullptr);
  by_number_[number] = &stored;
  return stored;
}

bool NodeTable::replace(Node node) {
  if (typeOfId(node.id) != node.type()) return false;
  const std::size_t number = numberOf(node.id, node.type());
  if (number >= by_number_.size()) return false;
  Node* const stored = by_number_[number];
  if (stored == nullptr) return false;
  if (stored->groundPosition() != node.groundPosition()) {
    places_.erase(node.id, placeOf(*stored));
    places_.insert(node.id, placeOf(node));
  }
  *stored = std::move(node);
  return true;
}

bool NodeTable::erase(NodeId id) {
  const Node* const node = find(id);
  if (node == nullptr) return false;
  places_.erase(id, placeOf(*node));
  by_number_[numberOf(id, node->type())] = nullptr;
  nodes_.erase(id);
  return true;
}

const Node* NodeTable::find(NodeId id) const {
  if (nodes_.empty()) return nullptr;
  const NodeType type = nodes_.begin()->second.type();
  if (typeOfId(id) != type) return nullptr;
  const std::size_t number = numberOf(id, type);
  return number < by_number_.size() ? by_number_[number] : nullptr;
}

}  // namespace occusg
