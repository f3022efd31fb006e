// SPDX-License-Identifier: BSD-3-Clause
#include "regions/basins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "occusg/regions/region.hpp"

namespace occusg {
namespace {

/// Open cells from the greatest clearance down; equal ones row by row.
std::vector<std::size_t> descending(const std::vector<std::int32_t>& squared) {
  const std::int32_t deepest = *std::max_element(squared.begin(), squared.end());
  std::vector<std::size_t> start(static_cast<std::size_t>(deepest) + 2, 0);
  for (const std::int32_t value : squared)
    if (value > 0) ++start[deepest - value + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  std::vector<std::size_t> order(start.back());
  for (std::size_t cell = 0; cell < squared.size(); ++cell)
    if (squared[cell] > 0) order[start[deepest - squared[cell]]++] = cell;
  return order;
}

class Flood {
 public:
  Flood(const Clearance& clearance, const BasinRules& rules)
      : squared_(clearance.squared.values()),
        rules_(rules),
        width_(clearance.open.box().width()),
        labels_(clearance.open.box(), kNoRegion) {}

  Grid<std::int32_t> run() {
    for (const std::size_t cell : descending(squared_)) visit(cell);
    for (std::int32_t& label : labels_.values()) label = root(label);
    return std::move(labels_);
  }

 private:
  void visit(std::size_t cell) {
    std::array<std::int32_t, 8> basins{};
    std::size_t count = 0;
    std::int32_t highest = -1;
    std::int32_t label = kNoRegion;
    forNeighbours(cell, [&](std::size_t next) {
      const std::int32_t other = labels_.values()[next];
      if (other == kNoRegion) return;
      if (squared_[next] > highest) {
        highest = squared_[next];
        label = other;
      }
      if (count == 0 || basins[count - 1] != other) basins[count++] = other;
    });
    if (label == kNoRegion) label = newBasin(squared_[cell]);
    labels_.values()[cell] = label;
    for (std::size_t i = 0; i < count; ++i) meet(label, basins[i], squared_[cell]);
  }

  /// The 8 neighbours, but a diagonal one only when one can get there past a side neighbour.
  template <typename Visitor>
  void forNeighbours(std::size_t cell, const Visitor& visitor) const {
    const std::size_t up = cell + width_;
    const std::size_t down = cell - width_;
    visitor(down);
    visitor(cell - 1);
    visitor(cell + 1);
    visitor(up);
    const auto open = [&](std::size_t i) { return squared_[i] > 0; };
    if (open(down) || open(cell - 1)) visitor(down - 1);
    if (open(down) || open(cell + 1)) visitor(down + 1);
    if (open(up) || open(cell - 1)) visitor(up - 1);
    if (open(up) || open(cell + 1)) visitor(up + 1);
  }

  std::int32_t newBasin(std::int32_t squared) {
    parent_.push_back(static_cast<std::int32_t>(parent_.size()));
    depth_.push_back(halfWidth(squared));
    return parent_.back();
  }

  void meet(std::int32_t a, std::int32_t b, std::int32_t squared_saddle) {
    // Basins are born in the order of their depth, so the lower number is the deeper one.
    const auto [deep, shallow] = std::minmax({root(a), root(b)});
    if (deep == shallow) return;
    const double saddle = halfWidth(squared_saddle);
    if (2.0 * saddle > rules_.widest_passage_cells || saddle >= rules_.open_ratio * depth_[shallow])
      parent_[shallow] = deep;
  }

  std::int32_t root(std::int32_t label) {
    while (parent_[label] != label) label = parent_[label] = parent_[parent_[label]];
    return label;
  }

  const std::vector<std::int32_t>& squared_;
  BasinRules rules_;
  std::size_t width_;
  Grid<std::int32_t> labels_;
  std::vector<std::int32_t> parent_{kNoRegion};
  std::vector<double> depth_{0.0};
};

}  // namespace

double halfWidth(std::int32_t squared_clearance) {
  return std::sqrt(static_cast<double>(squared_clearance)) - 0.5;
}

Grid<std::int32_t> basinsOf(const Clearance& clearance, const BasinRules& rules) {
  return Flood(clearance, rules).run();
}

}  // namespace occusg
