// SPDX-License-Identifier: BSD-3-Clause
#include "graph/seen_apart.hpp"

namespace occusg {

SeenApart::SeenApart(const ObjectPairCounts& pairs) {
  for (const auto& [ids, frames] : pairs) {
    frames_[ids.first][ids.second] = frames;
    frames_[ids.second][ids.first] = frames;
  }
}

void SeenApart::add(NodeId a, NodeId b) {
  ++frames_[a][b];
  ++frames_[b][a];
}

int SeenApart::count(NodeId a, NodeId b) const {
  const auto row = frames_.find(a);
  if (row == frames_.end()) return 0;
  const auto entry = row->second.find(b);
  return entry == row->second.end() ? 0 : entry->second;
}

void SeenApart::merge(NodeId kept, NodeId gone) {
  const auto row = frames_.find(gone);
  if (row == frames_.end()) return;
  const std::map<NodeId, int> others = row->second;
  erase(gone);
  for (const auto& [other, frames] : others) {
    if (other == kept) continue;
    frames_[kept][other] += frames;
    frames_[other][kept] += frames;
  }
}

void SeenApart::erase(NodeId id) {
  const auto row = frames_.find(id);
  if (row == frames_.end()) return;
  for (const auto& [other, frames] : row->second) {
    const auto mirrored = frames_.find(other);
    mirrored->second.erase(id);
    if (mirrored->second.empty()) frames_.erase(mirrored);
  }
  frames_.erase(id);
}

ObjectPairCounts SeenApart::pairs() const {
  ObjectPairCounts pairs;
  for (const auto& [id, row] : frames_) {
    for (const auto& [other, frames] : row)
      if (id < other) pairs.emplace(std::pair(id, other), frames);
  }
  return pairs;
}

}  // namespace occusg
