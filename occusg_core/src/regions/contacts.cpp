// SPDX-License-Identifier: BSD-3-Clause
#include "regions/contacts.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "occusg/regions/region.hpp"

namespace occusg {
namespace {

/// A cell edge between two labels.
struct Crack {
  std::int32_t label_a = kNoRegion;
  std::int32_t label_b = kNoRegion;
  CellPair pair;

  /// The two corners of the edge, the smaller first.
  [[nodiscard]] Cell from() const { return pair.high; }
  [[nodiscard]] Cell to() const { return {pair.low.x + 1, pair.low.y + 1}; }
};

using Cracks = std::vector<Crack>;

Cracks cracksOf(const Grid<std::int32_t>& labels) {
  Cracks cracks;
  const auto add = [&](std::int32_t a, std::int32_t b, const CellPair& pair) {
    if (a == b || a == kNoRegion || b == kNoRegion) return;
    cracks.push_back({std::min(a, b), std::max(a, b), pair});
  };
  const CellBox& box = labels.box();
  const std::int32_t* label = labels.values().data();
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x, ++label) {
      if (x + 1 < box.max.x) add(label[0], label[1], {{x, y}, {x + 1, y}});
      if (y + 1 < box.max.y) add(label[0], label[box.width()], {{x, y}, {x, y + 1}});
    }
  }
  std::stable_sort(cracks.begin(), cracks.end(), [](const Crack& a, const Crack& b) {
    return std::tie(a.label_a, a.label_b) < std::tie(b.label_a, b.label_b);
  });
  return cracks;
}

/// Joins the cracks of one pair of labels into chains, by the corners they share.
class Chains {
 public:
  Chains(Cracks::const_iterator first, Cracks::const_iterator last) : first_(first), last_(last) {
    for (auto crack = first; crack != last; ++crack) {
      corners_.push_back(crack->from());
      corners_.push_back(crack->to());
    }
    std::sort(corners_.begin(), corners_.end());
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    degree_.assign(corners_.size(), 0);
    parent_.resize(corners_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (auto crack = first; crack != last; ++crack) join(crack->from(), crack->to());
  }

  [[nodiscard]] std::vector<Contact> contacts() {
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < corners_.size(); ++i) members[root(i)].push_back(i);
    std::map<std::size_t, Contact> by_root;
    for (const auto& [first_corner, chain] : members) {
      const auto [from, to] = endsOf(chain);
      by_root[first_corner] = {first_->label_a, first_->label_b, from, to, {}};
    }
    for (auto crack = first_; crack != last_; ++crack)
      by_root[root(indexOf(crack->from()))].pairs.push_back(crack->pair);
    std::vector<Contact> contacts;
    contacts.reserve(by_root.size());
    for (auto& [first_corner, contact] : by_root) contacts.push_back(std::move(contact));
    return contacts;
  }

 private:
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(const Cell& from, const Cell& to) {
    const std::size_t i = indexOf(from);
    const std::size_t j = indexOf(to);
    ++degree_[i];
    ++degree_[j];
    const auto [low, high] = std::minmax({root(i), root(j)});
    parent_[high] = low;
  }

  [[nodiscard]] std::size_t indexOf(const Cell& corner) const {
    const auto found = std::lower_bound(corners_.begin(), corners_.end(), corner);
    return static_cast<std::size_t>(found - corners_.begin());
  }

  [[nodiscard]] Cell farthest(const std::vector<std::size_t>& chain, const Cell& from) const {
    const auto squared = [&](std::size_t i) {
      const std::int64_t dx = corners_[i].x - from.x;
      const std::int64_t dy = corners_[i].y - from.y;
      return dx * dx + dy * dy;
    };
    return corners_[*std::max_element(chain.begin(), chain.end(),
                                      [&](auto i, auto j) { return squared(i) < squared(j); })];
  }

  [[nodiscard]] std::pair<Cell, Cell> endsOf(const std::vector<std::size_t>& chain) const {
    std::vector<Cell> loose;
    for (const std::size_t i : chain)
      if (degree_[i] == 1) loose.push_back(corners_[i]);
    if (loose.size() == 2) return {loose.front(), loose.back()};
    const Cell one = farthest(chain, corners_[chain.front()]);
    const Cell other = farthest(chain, one);
    return {std::min(one, other), std::max(one, other)};
  }

  Cracks::const_iterator first_;
  Cracks::const_iterator last_;
  std::vector<Cell> corners_;  ///< Sorted, unique.
  std::vector<int> degree_;
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<Contact> contactsOf(const Grid<std::int32_t>& labels) {
  const Cracks cracks = cracksOf(labels);
  std::vector<Contact> contacts;
  for (auto first = cracks.begin(); first != cracks.end();) {
    const auto last = std::find_if(first, cracks.end(), [&](const Crack& crack) {
      return crack.label_a != first->label_a || crack.label_b != first->label_b;
    });
    for (Contact& contact : Chains(first, last).contacts()) contacts.push_back(std::move(contact));
    first = last;
  }
  std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) {
    return std::tie(a.label_a, a.label_b, a.from, a.to) <
           std::tie(b.label_a, b.label_b, b.from, b.to);
  });
  return contacts;
}

}  // namespace occusg
