// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_mask.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "regions/dude_holes.hpp"

namespace occusg {
namespace {

constexpr std::int8_t kLowestObstacle = 10;  ///< Published driver: below this counts as free.
constexpr std::int8_t kHardObstacle = 90;    ///< Published driver: above this counts as a wall.
constexpr std::uint8_t kFilled = 2;

/// How far a cell grows towards lower and towards higher coordinates.
struct Growth {
  int down = 0;
  int up = 0;
};
// A window of two cells and four growths by one; a window of ten and one growth.
constexpr Growth kWallGrowth{4, 5};
constexpr Growth kFreeGrowth{5, 6};

template <typename Predicate>
Grid<std::uint8_t> selected(const Grid<std::int8_t>& layer, const CellBox& box,
                            Predicate is_selected) {
  Grid<std::uint8_t> result(box, 0);
  const CellBox known = box.intersected(layer.box());
  for (int y = known.min.y; y < known.max.y; ++y) {
    for (int x = known.min.x; x < known.max.x; ++x)
      result.at({x, y}) = is_selected(layer.at({x, y})) ? 1 : 0;
  }
  return result;
}

/// Every set cell as a row of cells; turned by a diagonal mirror so that two calls grow squares.
Grid<std::uint8_t> grownAlongX(const Grid<std::uint8_t>& grid, const Growth& growth) {
  const CellBox& box = grid.box();
  Grid<std::uint8_t> result({{box.min.y, box.min.x}, {box.max.y, box.max.x}}, 0);
  for (int y = box.min.y; y < box.max.y; ++y) {
    int next = box.min.x;
    for (int x = box.min.x; x < box.max.x; ++x) {
      if (grid.at({x, y}) == 0) continue;
      const int end = std::min(x + growth.up + 1, box.max.x);
      for (next = std::max(next, x - growth.down); next < end; ++next) result.at({y, next}) = 1;
    }
  }
  return result;
}

Grid<std::uint8_t> grown(const Grid<std::uint8_t>& grid, const Growth& growth) {
  return grownAlongX(grownAlongX(grid, growth), growth);
}

Grid<std::uint8_t> publishedCleaning(const Grid<std::int8_t>& layer, const CellBox& box) {
  const CellBox reached = box.grown(cleaningReach(GridCleaning::kPublished));
  const Grid<std::uint8_t> open = grown(
      selected(layer, reached, [](auto value) { return value >= 0 && value < kLowestObstacle; }),
      kFreeGrowth);
  const Grid<std::uint8_t> walls = grown(
      selected(layer, reached, [](auto value) { return value > kHardObstacle; }), kWallGrowth);
  Grid<std::uint8_t> result(box, 0);
  const CellBox known = box.intersected(layer.box());
  for (int y = known.min.y; y < known.max.y; ++y) {
    for (int x = known.min.x; x < known.max.x; ++x)
      result.at({x, y}) = open.at({x, y}) != 0 && walls.at({x, y}) == 0 ? 1 : 0;
  }
  return result;
}

bool mayFill(const CornerRing& hole, const Grid<std::uint8_t>& cells,
             const std::function<bool(const Cell&)>& may_fill) {
  bool may = true;
  visitRing(hole, [&](const Cell& cell) { may = may && (cells.at(cell) != 0 || may_fill(cell)); });
  return may;
}

}  // namespace

int cleaningReach(GridCleaning cleaning) {
  return cleaning == GridCleaning::kPublished ? std::max(kFreeGrowth.up, kWallGrowth.up) : 0;
}

Grid<std::uint8_t> cleanedFreeSpace(const FreeSpaceCells& layer, const CellBox& box,
                                    GridCleaning cleaning) {
  if (box.empty()) return {};
  const Grid<std::int8_t> reached =
      layer.dense(box.grown(cleaningReach(cleaning)).intersected(layer.box()));
  if (cleaning == GridCleaning::kPublished) return publishedCleaning(reached, box);
  return selected(reached, box, [](auto value) { return value == kFree; });
}

DudeMask dudeMask(Grid<std::uint8_t> cells, double max_hole_cells,
                  const std::function<bool(const Cell&)>& may_fill) {
  DudeMask mask{std::move(cells), {}, {}};
  std::vector<CellOutline> outlines = outlinesOf(mask.cells);
  for (CellOutline& outline : outlines) {
    const auto is_ignored = [&](const CornerRing& hole) {
      return holeShape(hole).diameter_cells <= max_hole_cells &&
             mayFill(hole, mask.cells, may_fill);
    };
    const auto kept = std::stable_partition(outline.holes.begin(), outline.holes.end(),
                                            [&](const auto& hole) { return !is_ignored(hole); });
    std::move(kept, outline.holes.end(), std::back_inserter(mask.ignored_holes));
    outline.holes.erase(kept, outline.holes.end());
  }
  for (const CornerRing& hole : mask.ignored_holes)
    visitRing(hole, [&](const Cell& cell) { mask.cells.at(cell) = kFilled; });
  // The cell at the smallest corner of an outer ring belongs to the component.
  for (CellOutline& outline : outlines) {
    if (mask.cells.at(outline.outer.front()) != kFilled)
      mask.outlines.push_back(std::move(outline));
  }
  return mask;
}

}  // namespace occusg
