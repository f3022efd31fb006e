// SPDX-License-Identifier: BSD-3-Clause
#include "regions/lintels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "occusg/regions/region.hpp"

namespace occusg {
namespace {

/// A gap that begins higher is a window or lies above furniture [m].
constexpr double kHighestSill_m = 0.3;

constexpr std::array<Cell, 4> kSides = {{{0, -1}, {-1, 0}, {1, 0}, {0, 1}}};

/// Spreads the labels of `reached` over the unlabelled cells `isOpen` allows, in breadth, so that
/// each gets the label that is the fewest steps away.
template <typename IsOpen>
void spread(std::vector<Cell> reached, const IsOpen& isOpen, Grid<std::int32_t>& labels) {
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const Cell from = reached[i];
    for (const Cell& side : kSides) {
      const Cell cell{from.x + side.x, from.y + side.y};
      if (!labels.box().contains(cell) || labels.at(cell) != kNoRegion || !isOpen(cell)) continue;
      labels.at(cell) = labels.at(from);
      reached.push_back(cell);
    }
  }
}

template <typename Visit>
void forEachCell(const CellBox& box, const Visit& visit) {
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) visit(Cell{x, y});
}

}  // namespace

Grid<std::int8_t> withLintelsClosed(const FreeSpace& layer, const LintelHeights& heights) {
  Grid<std::int8_t> cells = layer.cells.dense();
  if (layer.evidence.empty() || heights.highest_m < heights.lowest_m) return cells;
  const double resolution_m = layer.frame.resolution_m;
  const auto voxels = [&](double height_m) { return std::lround(height_m / resolution_m); };
  const auto isLintel = [&](const ColumnEvidence& evidence) {
    return evidence.overhead == Overhead::kOccupied &&
           evidence.gap_bottom <= voxels(kHighestSill_m) &&
           evidence.gap_top >= voxels(heights.lowest_m) &&
           evidence.gap_top <= voxels(heights.highest_m);
  };
  forEachCell(cells.box(), [&](const Cell& cell) {
    std::int8_t& value = cells.at(cell);
    if (value == kFree && isLintel(layer.evidence.at(cell))) value = kFullObstacle;
  });
  return cells;
}

void openLintels(const FreeSpaceCells& cells, const Grid<std::int8_t>& closed,
                 Grid<std::int32_t>& labels) {
  const auto isFree = [](const auto& grid, const Cell& cell) {
    return grid.valueOr(cell, kUnknown) == kFree;
  };
  std::int32_t last = 0;
  for (const std::int32_t label : labels.values()) last = std::max(last, label);
  forEachCell(labels.box(), [&](const Cell& cell) {
    if (labels.at(cell) != kNoRegion || !isFree(closed, cell)) return;
    labels.at(cell) = ++last;
    spread(
        {cell}, [&](const Cell& beside) { return isFree(closed, beside); }, labels);
  });

  std::vector<Cell> labelled;
  forEachCell(labels.box(), [&](const Cell& cell) {
    if (labels.at(cell) != kNoRegion) labelled.push_back(cell);
  });
  spread(
      std::move(labelled),
      [&](const Cell& cell) { return isFree(cells, cell) && !isFree(closed, cell); }, labels);
}

}  // namespace occusg
