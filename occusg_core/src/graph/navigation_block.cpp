// SPDX-License-Identifier: BSD-3-Clause
#include "graph/navigation_block.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <numeric>
#include <tuple>

namespace occusg {
namespace {

constexpr NavigationBlock::Part kNotYet = 0xFFFFU;

std::int64_t squaredDistance(std::int64_t dx, std::int64_t dy) { return dx * dx + dy * dy; }

}  // namespace

NavigationBlock::NavigationBlock(const FreeSpace& layer, const Cell& index, int side_cells,
                                 CellNeighbours neighbours)
    : first_{index.x * side_cells, index.y * side_cells},
      side_(side_cells),
      labels_(static_cast<std::size_t>(side_cells) * static_cast<std::size_t>(side_cells),
              kNoPart) {
  auto label_of_cell = labels_.begin();
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < side_; ++x, ++label_of_cell) {
      if (layer.cells.valueOr({first_.x + x, first_.y + y}, kUnknown) == kFree)
        *label_of_cell = kNotYet;
    }
  }
  label(neighbours);
  measure();
}

void NavigationBlock::label(CellNeighbours neighbours) {
  std::vector<int> open;
  Part last = kNoPart;
  for (std::size_t start = 0; start < labels_.size(); ++start) {
    if (labels_[start] != kNotYet) continue;
    labels_[start] = ++last;
    open.push_back(static_cast<int>(start));
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (neighbours == CellNeighbours::kSides && dx != 0 && dy != 0) continue;
          const int x = at % side_ + dx;
          const int y = at / side_ + dy;
          if (x < 0 || y < 0 || x >= side_ || y >= side_) continue;
          Part& beside = labels_[placeOf(x, y)];
          if (beside != kNotYet) continue;
          beside = last;
          open.push_back(y * side_ + x);
        }
      }
    }
  }
  parts_.resize(last);
}

void NavigationBlock::measure() {
  struct Sum {
    std::int64_t x = 0, y = 0;
  };
  std::vector<Sum> sums(parts_.size());
  const auto forEachFreeCell = [&](const auto& visit) {
    for (int y = 0; y < side_; ++y) {
      for (int x = 0; x < side_; ++x) {
        if (const Part part = partAt(x, y); part != kNoPart) visit(x, y, part - std::size_t{1});
      }
    }
  };
  forEachFreeCell([&](int x, int y, std::size_t part) {
    ++parts_[part].cells;
    sums[part].x += x;
    sums[part].y += y;
  });
  std::vector<std::int64_t> nearest(parts_.size(), -1);
  forEachFreeCell([&](int x, int y, std::size_t part) {
    // Scaled by the number of cells, so that the mean is whole.
    const std::int64_t n = parts_[part].cells;
    const std::int64_t squared = squaredDistance(n * x - sums[part].x, n * y - sums[part].y);
    if (nearest[part] >= 0 && squared >= nearest[part]) return;
    nearest[part] = squared;
    parts_[part].medoid = {first_.x + x, first_.y + y};
  });
}

bool NavigationBlock::hasSameCells(const NavigationBlock& other) const {
  if (labels_.empty() || other.labels_.empty()) return empty() && other.empty();
  return std::equal(labels_.begin(), labels_.end(), other.labels_.begin(), other.labels_.end(),
                    [](Part a, Part b) { return (a == kNoPart) == (b == kNoPart); });
}

int NavigationBlock::freeCells() const {
  return std::accumulate(parts_.begin(), parts_.end(), 0,
                         [](int sum, const Extent& part) { return sum + part.cells; });
}

std::size_t NavigationBlock::placeOf(int x, int y) const {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
         static_cast<std::size_t>(x);
}

NavigationBlock::Part NavigationBlock::partAt(int x, int y) const {
  return labels_.empty() ? kNoPart : labels_[placeOf(x, y)];
}

NavigationBlock::Part NavigationBlock::partAt(const Cell& cell) const {
  const int x = cell.x - first_.x;
  const int y = cell.y - first_.y;
  return x < 0 || y < 0 || x >= side_ || y >= side_ ? kNoPart : partAt(x, y);
}

NavigationBlock::Part NavigationBlock::partNearest(const Cell& cell) const {
  std::int64_t nearest = -1;
  Part best = kNoPart;
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < side_; ++x) {
      if (partAt(x, y) == kNoPart) continue;
      const std::int64_t squared =
          squaredDistance(std::int64_t{first_.x} + x - cell.x, std::int64_t{first_.y} + y - cell.y);
      if (nearest >= 0 && squared >= nearest) continue;
      nearest = squared;
      best = partAt(x, y);
    }
  }
  return best;
}

Cell NavigationBlock::cellNearestToMiddle() const {
  std::tuple<std::int64_t, int, int> best{-1, 0, 0};
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < side_; ++x) {
      if (partAt(x, y) == kNoPart) continue;
      // Twice the offset between the middles of cell and block.
      const std::tuple<std::int64_t, int, int> candidate{
          squaredDistance(2 * x + 1 - side_, 2 * y + 1 - side_), y, x};
      if (std::get<0>(best) < 0 || candidate < best) best = candidate;
    }
  }
  return {first_.x + std::get<2>(best), first_.y + std::get<1>(best)};
}

std::vector<int> NavigationBlock::commonCells(const NavigationBlock& old, Part part) const {
  std::vector<int> common(parts_.size() + 1, 0);
  if (old.labels_.size() != labels_.size()) return common;
  for (std::size_t i = 0; i < labels_.size(); ++i)
    if (old.labels_[i] == part) ++common[labels_[i]];
  common[kNoPart] = 0;
  return common;
}

std::vector<std::pair<NavigationBlock::Part, NavigationBlock::Part>> contactsBetween(
    const NavigationBlock& a, const NavigationBlock& b, int dx, int dy, int side_cells,
    CellNeighbours neighbours) {
  std::vector<std::pair<NavigationBlock::Part, NavigationBlock::Part>> contacts;
  const int last = side_cells - 1;
  const auto add = [&](int ax, int ay, int bx, int by) {
    const auto of_a = a.partAt(ax, ay);
    const auto of_b = b.partAt(bx, by);
    if (of_a != NavigationBlock::kNoPart && of_b != NavigationBlock::kNoPart)
      contacts.emplace_back(of_a, of_b);
  };
  const int reach = neighbours == CellNeighbours::kSidesAndCorners ? 1 : 0;
  if (dx != 0 && dy != 0) {
    add(dx > 0 ? last : 0, dy > 0 ? last : 0, dx > 0 ? 0 : last, dy > 0 ? 0 : last);
  } else {
    for (int i = 0; i < side_cells; ++i) {
      for (int j = std::max(0, i - reach); j <= std::min(last, i + reach); ++j) {
        if (dx != 0) {
          add(dx > 0 ? last : 0, i, dx > 0 ? 0 : last, j);
        } else {
          add(i, dy > 0 ? last : 0, j, dy > 0 ? 0 : last);
        }
      }
    }
  }
  std::sort(contacts.begin(), contacts.end());
  contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
  return contacts;
}

}  // namespace occusg
