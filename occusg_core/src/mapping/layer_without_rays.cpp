// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/layer_without_rays.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "mapping/voxel_tree.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

/// Occupied voxels of one column, from the lowest to behind the highest [voxels].
struct OccupiedRun {
  Cell column;
  int bottom;
  int top;
};

struct OccupiedVoxels {
  std::vector<OccupiedRun> runs;  ///< By column, then from the lowest up.
  CellBox box;
  int bottom = std::numeric_limits<int>::max();
  int top = std::numeric_limits<int>::min();
};

int voxelOf(octomap::key_type key) { return static_cast<int>(key) - kZeroKey; }

void addLeaf(const octomap::OcTreeKey& first, int side, OccupiedVoxels& voxels) {
  const Cell corner{voxelOf(first[0]), voxelOf(first[1])};
  const int bottom = voxelOf(first[2]);
  voxels.box = voxels.box.including(CellBox{corner, {corner.x + side, corner.y + side}});
  const auto cells = static_cast<std::uint64_t>(voxels.box.width()) *
                     static_cast<std::uint64_t>(voxels.box.height());
  if (cells > kMaxLayerCells) {
    throw refuse("occupancy map",
                 "spans " + std::to_string(voxels.box.width()) + " x " +
                     std::to_string(voxels.box.height()) + " cells",
                 "at most " + std::to_string(kMaxLayerCells) + " cells are projected");
  }
  voxels.bottom = std::min(voxels.bottom, bottom);
  voxels.top = std::max(voxels.top, bottom + side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      voxels.runs.push_back({{corner.x + x, corner.y + y}, bottom, bottom + side});
  }
}

OccupiedVoxels occupiedVoxels(const octomap::OcTree& tree) {
  OccupiedVoxels voxels;
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const unsigned above = tree.getTreeDepth() - leaf.getDepth();
    addLeaf(leaf.getIndexKey(), 1 << above, voxels);
  }
  std::sort(voxels.runs.begin(), voxels.runs.end(), [](const OccupiedRun& a, const OccupiedRun& b) {
    return std::tie(a.column.y, a.column.x, a.bottom) < std::tie(b.column.y, b.column.x, b.bottom);
  });
  return voxels;
}

/// Marks the columns whose occupied voxels leave no gap of `needed` voxels between `bottom` and
/// `top`.
void markObstacles(const OccupiedVoxels& voxels, int bottom, int top, int needed,
                   Grid<std::int8_t>& cells) {
  for (auto run = voxels.runs.begin(); run != voxels.runs.end();) {
    const Cell column = run->column;
    int reached = bottom;
    int widest = 0;
    bool touched = false;
    for (; run != voxels.runs.end() && run->column == column; ++run) {
      if (run->top <= bottom || run->bottom >= top) continue;
      touched = true;
      widest = std::max(widest, run->bottom - reached);
      reached = std::max(reached, run->top);
    }
    widest = std::max(widest, top - reached);
    if (touched && widest < needed) cells.at(column) = kFullObstacle;
  }
}

/// Unknown cells that obstacles enclose become free.
void freeEnclosed(Grid<std::int8_t>& cells) {
  // A ring of cells around the grid is one piece of the outside.
  const CellBox around = cells.box().grown(1);
  Grid<std::uint8_t> outside(around, 0);
  std::vector<Cell> open{around.min};
  outside.at(around.min) = 1;
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    for (const Cell& step : {Cell{-1, 0}, Cell{1, 0}, Cell{0, -1}, Cell{0, 1}}) {
      const Cell next{cell.x + step.x, cell.y + step.y};
      if (!around.contains(next) || outside.at(next) != 0 ||
          cells.valueOr(next, kUnknown) == kFullObstacle)
        continue;
      outside.at(next) = 1;
      open.push_back(next);
    }
  }
  for (int y = cells.box().min.y; y < cells.box().max.y; ++y) {
    for (int x = cells.box().min.x; x < cells.box().max.x; ++x)
      if (cells.at({x, y}) == kUnknown && outside.at({x, y}) == 0) cells.at({x, y}) = kFree;
  }
}

}  // namespace

bool hasFreeVoxel(const octomap::OcTree& tree) {
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf)
    if (!tree.isNodeOccupied(*leaf)) return true;
  return false;
}

FreeSpace layerWithoutRays(const octomap::OcTree& tree, const FreeSpaceLayerConfig& config,
                           UnseenSpace unseen) {
  const GridFrame frame{tree.getResolution()};
  const OccupiedVoxels voxels = occupiedVoxels(tree);
  if (voxels.runs.empty()) return {frame, {}, {}};
  constexpr double kVoxelTolerance = 0.002;
  const auto limit = [&](double z_m, int none) {
    return std::isfinite(z_m) ? static_cast<int>(std::lround(z_m / frame.resolution_m)) : none;
  };
  const int bottom = std::max(voxels.bottom, limit(config.lowest_z_m, voxels.bottom));
  const int top = std::min(voxels.top, limit(config.highest_z_m, voxels.top));
  const int needed = std::max(
      1, static_cast<int>(std::ceil(config.min_free_gap_m / frame.resolution_m - kVoxelTolerance)));
  Grid<std::int8_t> cells(voxels.box, kUnknown);
  markObstacles(voxels, bottom, top, needed, cells);
  if (unseen == UnseenSpace::kFree) freeEnclosed(cells);
  return {frame, FreeSpaceCells(cells), voxels.box};
}

}  // namespace occusg
