// SPDX-License-Identifier: BSD-3-Clause
#include "regions/passages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "occusg/regions/region.hpp"
#include "regions/basins.hpp"
#include "regions/cell_walks.hpp"
#include "regions/contacts.hpp"

namespace occusg {
namespace {

/// How far around a saddle jambs are looked for, as a share of its clearance and in cells.
constexpr double kReachShare = 1.5;
constexpr double kReachCells = 2.0;

std::int64_t dot(const Cell& a, const Cell& b) {
  return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y;
}
Cell minus(const Cell& a, const Cell& b) { return {a.x - b.x, a.y - b.y}; }
Cell plus(const Cell& a, const Cell& b) { return {a.x + b.x, a.y + b.y}; }

/// The narrower cell of the widest pair along a contact.
Cell saddleOf(const Contact& contact, const Grid<std::int32_t>& squared) {
  Cell saddle = contact.pairs.front().low;
  std::int32_t widest = -1;
  for (const CellPair& pair : contact.pairs) {
    const Cell narrower = squared.at(pair.high) < squared.at(pair.low) ? pair.high : pair.low;
    if (squared.at(narrower) <= widest) continue;
    widest = squared.at(narrower);
    saddle = narrower;
  }
  return saddle;
}

bool isWall(const Grid<std::uint8_t>& open, const Cell& cell) {
  if (open.at(cell) != 0) return false;
  const std::array<Cell, 4> beside = sideNeighbours(cell);
  return std::any_of(beside.begin(), beside.end(),
                     [&](const Cell& side) { return open.valueOr(side, 0) != 0; });
}

/// Offsets from `saddle` of the closed cells beside open ones within reach, nearest first.
std::vector<Cell> wallsAround(const Cell& saddle, const Clearance& clearance) {
  const double reach = kReachShare * std::sqrt(clearance.squared.at(saddle)) + kReachCells;
  const CellBox box = CellBox{saddle, plus(saddle, {1, 1})}
                          .grown(static_cast<int>(reach))
                          .intersected(clearance.open.box());
  std::vector<Cell> walls;
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Cell offset = minus({x, y}, saddle);
      if (static_cast<double>(dot(offset, offset)) > reach * reach) continue;
      if (isWall(clearance.open, {x, y})) walls.push_back(offset);
    }
  }
  std::stable_sort(walls.begin(), walls.end(),
                   [](const Cell& a, const Cell& b) { return dot(a, a) < dot(b, b); });
  return walls;
}

/// True when the saddle sees the two offsets at least 120 degrees apart: on opposite sides.
bool areOpposite(const Cell& a, const Cell& b) {
  const std::int64_t product = dot(a, b);
  return product < 0 && 4 * product * product >= dot(a, a) * dot(b, b);
}

/// The shortest segment between opposite walls; of equally long ones the nearest to the saddle.
std::optional<PassageCut> cutAt(const Cell& saddle, const Clearance& clearance) {
  const std::vector<Cell> walls = wallsAround(saddle, clearance);
  std::optional<std::pair<std::int64_t, std::int64_t>> best;
  PassageCut cut;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Cell& a = walls[i];
      const Cell& b = walls[j];
      const std::int64_t spread = dot(a, a) + dot(b, b);
      // The angle makes every segment longer than its spread, and the walls are sorted.
      if (best && spread > best->first) break;
      if (!areOpposite(a, b)) continue;
      const Cell span = minus(a, b);
      const std::pair<std::int64_t, std::int64_t> cost{dot(span, span), spread};
      if (best && cost >= *best) continue;
      best = cost;
      cut = {plus(saddle, std::min(a, b)), plus(saddle, std::max(a, b))};
    }
  }
  if (!best) return std::nullopt;
  return cut;
}

/// Which basins have become one.
class Joins {
 public:
  Joins(const Grid<std::int32_t>& basins, const Grid<std::int32_t>& squared) {
    const auto deepest = std::max_element(basins.values().begin(), basins.values().end());
    const std::size_t count = deepest == basins.values().end() ? 0 : *deepest;
    squared_depth_.assign(count + 1, 0);
    cells_.assign(count + 1, 0.0);
    parent_.resize(count + 1);
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t i = 0; i < basins.values().size(); ++i) {
      std::int32_t& depth = squared_depth_[basins.values()[i]];
      depth = std::max(depth, squared.values()[i]);
      cells_[basins.values()[i]] += 1.0;
    }
  }

  [[nodiscard]] std::int32_t root(std::int32_t basin) const {
    while (parent_[basin] != basin) basin = parent_[basin];
    return basin;
  }
  [[nodiscard]] double depth(std::int32_t root) const { return halfWidth(squared_depth_[root]); }

  /// Area of what has become one.
  [[nodiscard]] double cells(std::int32_t root) const { return cells_[root]; }

  void join(std::int32_t root_a, std::int32_t root_b) {
    const auto [low, high] = std::minmax({root_a, root_b});
    parent_[high] = low;
    squared_depth_[low] = std::max(squared_depth_[low], squared_depth_[high]);
    cells_[low] += cells_[high];
  }

 private:
  std::vector<std::int32_t> parent_;
  std::vector<std::int32_t> squared_depth_;
  std::vector<double> cells_;
};

/// The labels with those of what has become one alike.
Grid<std::int32_t> joined(Grid<std::int32_t> labels, const Joins& joins) {
  for (std::int32_t& label : labels.values()) label = joins.root(label);
  return labels;
}

/// The space on both sides of a passage, as far as the two basins that meet there reach.
class PassageSides {
 public:
  PassageSides(const Grid<std::int32_t>& basins, const Joins& joins, std::int32_t root_a,
               std::int32_t root_b, const PassageCut& cut)
      : basins_(basins), joins_(joins), root_a_(root_a), root_b_(root_b) {
    const double dx = cut.jamb_b.x - cut.jamb_a.x;
    const double dy = cut.jamb_b.y - cut.jamb_a.y;
    const double length = std::hypot(dx, dy);
    along_ = {dx / length, dy / length};
    middle_ = {0.5 * (cut.jamb_a.x + cut.jamb_b.x + 1), 0.5 * (cut.jamb_a.y + cut.jamb_b.y + 1)};
    width_ = std::max(1.0, length - 1.0);
  }

  /// True when both sides, within `reach` cells, measure `times` the passage's own width.
  [[nodiscard]] bool bothWiden(double times, double reach) const {
    return widens(1.0, times * width_, reach) && widens(-1.0, times * width_, reach);
  }

 private:
  [[nodiscard]] bool widens(double side, double enough, double reach) const {
    for (double step = 1.0; step <= reach; step += 1.0) {
      const Point2 at{middle_.x - side * step * along_.y, middle_.y + side * step * along_.x};
      if (!isInside(at)) return false;
      if (widthAt(at, enough) >= enough) return true;
    }
    return false;
  }

  /// Width parallel to the passage in whole cells, counted no further than `enough`.
  [[nodiscard]] double widthAt(const Point2& at, double enough) const {
    double width = 1.0;
    for (const double side : {-1.0, 1.0}) {
      double step = 1.0;
      while (width < enough &&
             isInside({at.x + side * step * along_.x, at.y + side * step * along_.y})) {
        step += 1.0;
        width += 1.0;
      }
    }
    return width;
  }

  [[nodiscard]] bool isInside(const Point2& at) const {
    const Cell cell{static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y))};
    const std::int32_t basin = basins_.valueOr(cell, kNoRegion);
    if (basin == kNoRegion) return false;
    const std::int32_t root = joins_.root(basin);
    return root == root_a_ || root == root_b_;
  }

  const Grid<std::int32_t>& basins_;
  const Joins& joins_;
  std::int32_t root_a_;
  std::int32_t root_b_;
  Point2 along_;   ///< Unit vector of the cut, in cells.
  Point2 middle_;  ///< Of the cut, in cells.
  double width_ = 0.0;
};

/// Where two regions meet.
struct Opening {
  Contact contact;
  double width_cells = 0.0;
  std::optional<PassageCut> cut;
  bool is_door = false;
};

std::vector<Opening> openingsOf(const Grid<std::int32_t>& regions, const Clearance& clearance) {
  std::vector<Opening> openings;
  for (Contact& contact : contactsOf(regions)) {
    const Cell saddle = saddleOf(contact, clearance.squared);
    const double width_cells = 2.0 * halfWidth(clearance.squared.at(saddle));
    openings.push_back({std::move(contact), width_cells, cutAt(saddle, clearance)});
  }
  return openings;
}

/// The opening that is widest for the size of the smaller region beside it, above `least_ratio` and
/// no door; none: null.
Opening* mostOpen(std::vector<Opening>& openings, const Joins& joins, double least_ratio) {
  Opening* most = nullptr;
  for (Opening& opening : openings) {
    const std::int32_t a = joins.root(opening.contact.label_a);
    const std::int32_t b = joins.root(opening.contact.label_b);
    if (a == b || opening.is_door) continue;
    const double side_cells = std::sqrt(std::min(joins.cells(a), joins.cells(b)));
    const double ratio = opening.width_cells / side_cells;
    if (ratio <= least_ratio) continue;
    least_ratio = ratio;
    most = &opening;
  }
  return most;
}

}  // namespace

Grid<std::int32_t> joinedAcrossOpenings(const Clearance& clearance,
                                        const Grid<std::int32_t>& basins,
                                        const NarrowingRules& rules) {
  const std::vector<Contact> contacts = contactsOf(basins);
  std::vector<std::tuple<std::int32_t, std::size_t, Cell>> widest_first;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Cell saddle = saddleOf(contacts[i], clearance.squared);
    widest_first.emplace_back(-clearance.squared.at(saddle), i, saddle);
  }
  std::sort(widest_first.begin(), widest_first.end());

  Joins joins(basins, clearance.squared);
  for (const auto& [minus_squared, i, saddle] : widest_first) {
    const std::int32_t a = joins.root(contacts[i].label_a);
    const std::int32_t b = joins.root(contacts[i].label_b);
    if (a == b) continue;
    const double half_width = halfWidth(-minus_squared);
    const double depth = std::min(joins.depth(a), joins.depth(b));
    bool is_open = 2.0 * half_width > rules.widest_passage_cells;
    if (!is_open && half_width >= rules.depth_ratio * depth) {
      const auto cut = cutAt(saddle, clearance);
      is_open =
          !cut ||
          !PassageSides(basins, joins, a, b, *cut).bothWiden(rules.widening, rules.reach_cells);
    }
    if (is_open) joins.join(a, b);
  }
  return joined(basins, joins);
}

Grid<std::int32_t> withoutNiches(const Clearance& clearance, const Grid<std::int32_t>& regions,
                                 const NicheRules& rules) {
  if (regions.values().empty()) return regions;
  Joins joins(regions, clearance.squared);
  std::vector<Opening> openings = openingsOf(regions, clearance);
  while (Opening* worst = mostOpen(openings, joins, rules.most_open_ratio)) {
    const std::int32_t a = joins.root(worst->contact.label_a);
    const std::int32_t b = joins.root(worst->contact.label_b);
    const bool is_door = worst->cut && PassageSides(regions, joins, a, b, *worst->cut)
                                           .bothWiden(rules.widening, rules.reach_cells);
    if (is_door) {
      worst->is_door = true;  // a wall with an opening stays one when its sides grow
    } else {
      joins.join(a, b);
    }
  }
  return joined(regions, joins);
}

std::vector<PassageCut> passageCuts(const Clearance& clearance, const Grid<std::int32_t>& basins) {
  std::vector<PassageCut> cuts;
  for (const Contact& contact : contactsOf(basins)) {
    const auto cut = cutAt(saddleOf(contact, clearance.squared), clearance);
    if (cut) cuts.push_back(*cut);
  }
  return cuts;
}

}  // namespace occusg
