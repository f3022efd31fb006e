// SPDX-License-Identifier: BSD-3-Clause
#include "regions/lintels.hpp"

#include <cmath>
#include <vector>

#include "occusg/regions/region.hpp"
#include "regions/cell_walks.hpp"

namespace occusg {
namespace {

/// A gap that begins higher is a window or lies above furniture [m].
constexpr double kHighestSill_m = 0.3;

bool canHaveLintels(const FreeSpace& layer, const LintelHeights& heights) {
  return !layer.evidence.empty() && heights.highest_m >= heights.lowest_m;
}

}  // namespace

void spreadLabels(std::vector<Cell> reached, const std::function<bool(const Cell&)>& isOpen,
                  Grid<std::int32_t>& labels) {
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const Cell from = reached[i];
    for (const Cell& cell : sideNeighbours(from)) {
      if (!labels.box().contains(cell) || labels.at(cell) != kNoRegion || !isOpen(cell)) continue;
      labels.at(cell) = labels.at(from);
      reached.push_back(cell);
    }
  }
}

bool isUnderLintel(const FreeSpace& layer, const Cell& cell, const LintelHeights& heights) {
  const ColumnEvidence& evidence = layer.evidence.at(cell);
  if (!canHaveLintels(layer, heights) || evidence.overhead != Overhead::kOccupied) return false;
  const auto voxels = [&](double height_m) {
    return std::lround(height_m / layer.frame.resolution_m);
  };
  return evidence.gap_bottom <= voxels(kHighestSill_m) &&
         evidence.gap_top >= voxels(heights.lowest_m) &&
         evidence.gap_top <= voxels(heights.highest_m);
}

}  // namespace occusg
