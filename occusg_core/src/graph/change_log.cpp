// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/change_log.hpp"

#include <algorithm>
#include <map>

namespace occusg {
namespace {

struct NetChange {
  bool was_there = false;
  bool is_there = false;
};

void note(NetChange& change, ChangeKind kind, bool is_first) {
  if (is_first) change.was_there = kind != ChangeKind::kAdded;
  change.is_there = kind != ChangeKind::kRemoved;
}

template <typename Key>
void sortOut(const std::map<Key, NetChange>& changes, std::vector<Key>& added,
             std::vector<Key>& changed, std::vector<Key>& removed) {
  for (const auto& [key, change] : changes) {
    if (change.is_there) {
      (change.was_there ? changed : added).push_back(key);
    } else if (change.was_there) {
      removed.push_back(key);
    }
  }
}

}  // namespace

void ChangeLog::setStamp(double stamp_s) {
  stamp_s_ = has_stamp_ ? std::max(stamp_s_, stamp_s) : stamp_s;
  has_stamp_ = true;
}

void ChangeLog::record(ChangeKind kind, NodeId node) {
  record(Entry{stamp_s_, kind, false, {EdgeType::kTemporal, node, node}});
}

void ChangeLog::record(ChangeKind kind, const EdgeKey& edge) {
  record(Entry{stamp_s_, kind, true, edge});
}

void ChangeLog::record(Entry entry) {
  entries_.push_back(entry);
  ++revision_;
  if (entries_.size() > kCapacity) entries_.pop_front();
}

Revision ChangeLog::revisionAt(double stamp_s) const {
  const auto later =
      std::upper_bound(entries_.begin(), entries_.end(), stamp_s,
                       [](double stamp, const Entry& entry) { return stamp < entry.stamp_s; });
  return revision_ - static_cast<Revision>(entries_.end() - later);
}

GraphChanges ChangeLog::since(Revision revision) const {
  GraphChanges changes;
  const Revision forgotten = revision_ - entries_.size();
  changes.complete = revision >= forgotten && revision <= revision_;
  if (!changes.complete) return changes;
  std::map<NodeId, NetChange> nodes;
  std::map<EdgeKey, NetChange> edges;
  for (auto entry = entries_.begin() + static_cast<std::ptrdiff_t>(revision - forgotten);
       entry != entries_.end(); ++entry) {
    if (entry->is_edge) {
      const auto [item, is_first] = edges.try_emplace(entry->key);
      note(item->second, entry->kind, is_first);
    } else {
      const auto [item, is_first] = nodes.try_emplace(entry->key.source);
      note(item->second, entry->kind, is_first);
    }
  }
  sortOut(nodes, changes.added_nodes, changes.changed_nodes, changes.removed_nodes);
  sortOut(edges, changes.added_edges, changes.changed_edges, changes.removed_edges);
  return changes;
}

}  // namespace occusg
