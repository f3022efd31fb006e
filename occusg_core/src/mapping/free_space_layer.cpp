// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/free_space_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "mapping/column.hpp"
#include "mapping/voxel_tree.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

/// Voxels by which a length may miss a whole number and still count as it: 0.30 m is 6 voxels of
/// 0.05 m whatever the division rounds to. Fredriksson et al. widen every voxel by as much.
constexpr double kVoxelTolerance = 0.002;

constexpr std::array<Cell, 8> kNeighbours = {
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

Cell operator+(const Cell& a, const Cell& b) { return {a.x + b.x, a.y + b.y}; }

/// Voxels a free run needs to be at least `gap_m` long.
int voxelsFor(double gap_m, double resolution_m) {
  return std::max(1, static_cast<int>(std::ceil(gap_m / resolution_m - kVoxelTolerance)));
}

int clampedHeight(double voxels) {
  return static_cast<int>(std::min<double>(std::max<double>(voxels, -kZeroKey), kZeroKey));
}

VoxelRun heightsBetween(const FreeSpaceLayerConfig& config, double resolution_m) {
  return {clampedHeight(std::ceil(config.lowest_z_m / resolution_m - kVoxelTolerance)),
          clampedHeight(std::floor(config.highest_z_m / resolution_m + kVoxelTolerance))};
}

void check(const FreeSpaceLayerConfig& config, const GridFrame& frame) {
  if (!std::isfinite(frame.resolution_m) || frame.resolution_m <= 0.0) {
    throw refuse("resolution_m", "is " + std::to_string(frame.resolution_m) + " m",
                 "it must be finite and positive");
  }
  if (!(config.min_free_gap_m > 0.0 && config.min_free_gap_m <= 100.0)) {
    throw refuse("min_free_gap_m", "is " + std::to_string(config.min_free_gap_m) + " m",
                 "it must be in (0, 100]");
  }
  if (config.min_obstacle_level < 0 || config.min_obstacle_level > kFullObstacle) {
    throw refuse("min_obstacle_level", "is " + std::to_string(config.min_obstacle_level),
                 "it must be in [0, 100]");
  }
  if (std::isnan(config.lowest_z_m))
    throw refuse("lowest_z_m", "is not a number", "it must be a height in metres or -.inf");
  const VoxelRun heights = heightsBetween(config, frame.resolution_m);
  if (std::isnan(config.highest_z_m) ||
      heights.length() < voxelsFor(config.min_free_gap_m, frame.resolution_m)) {
    throw refuse("highest_z_m", "is " + std::to_string(config.highest_z_m) + " m",
                 "it must leave min_free_gap_m = " + std::to_string(config.min_free_gap_m) +
                     " m of whole voxels above lowest_z_m = " + std::to_string(config.lowest_z_m));
  }
}

const FreeSpaceLayerConfig& checked(const FreeSpaceLayerConfig& config, const GridFrame& frame) {
  check(config, frame);
  return config;
}

int roundedDown(int cells) {
  const int remainder = cells % kLayerBoxStep_cells;
  return cells - remainder - (remainder < 0 ? kLayerBoxStep_cells : 0);
}

CellBox widened(const CellBox& box) {
  if (box.empty()) return {};
  return {{roundedDown(box.min.x), roundedDown(box.min.y)},
          {-roundedDown(-box.max.x), -roundedDown(-box.max.y)}};
}

CellBox boundsOf(const std::vector<Cell>& columns) {
  CellBox box;
  for (const Cell& column : columns) box = box.including(column);
  return box;
}

CellBox knownColumns(const octomap::OcTree& tree) {
  CellBox box;
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    const octomap::OcTreeKey key = leaf.getIndexKey();  // lowest voxel of the leaf
    const Cell corner{key[0] - kZeroKey, key[1] - kZeroKey};
    const int side = 1 << (tree.getTreeDepth() - leaf.getDepth());
    box = box.including(CellBox{corner, {corner.x + side, corner.y + side}});
  }
  return box;
}

/// Lowest free run of at least `needed_voxels`; empty when the column has none.
VoxelRun lowestFreeRun(const Column& column, int needed_voxels) {
  VoxelRun run;
  bool found = false;
  column.forEachLeaf([&](bool occupied, const VoxelRun& leaf) {
    if (occupied || found) return;
    if (!run.empty() && run.top == leaf.bottom) {
      run.top = leaf.top;
    } else if (run.length() >= needed_voxels) {
      found = true;
    } else {
      run = leaf;
    }
  });
  return run.length() >= needed_voxels ? run : VoxelRun{};
}

/// To what degree the occupied runs fill a free run beside them, 0..100: full from one half on.
int obstacleLevel(const std::vector<VoxelRun>& occupied, const VoxelRun& free) {
  int filled = 0;
  for (const VoxelRun& run : occupied) filled += run.overlap(free);
  return std::min<int>(kFullObstacle, 2 * (100 * filled / free.length()));
}

CellBox differingCells(const Grid<std::int8_t>& before, const Grid<std::int8_t>& after) {
  const CellBox both = before.box().including(after.box());
  CellBox changed;
  for (int y = both.min.y; y < both.max.y; ++y) {
    for (int x = both.min.x; x < both.max.x; ++x) {
      if (before.valueOr({x, y}, kUnknown) != after.valueOr({x, y}, kUnknown))
        changed = changed.including(Cell{x, y});
    }
  }
  return changed;
}

}  // namespace

FreeSpaceLayer::FreeSpaceLayer(const FreeSpaceLayerConfig& config, const GridFrame& frame)
    : config_(checked(config, frame)),
      needed_voxels_(voxelsFor(config.min_free_gap_m, frame.resolution_m)),
      heights_(heightsBetween(config, frame.resolution_m)) {
  layer_.frame = frame;
}

const FreeSpace& FreeSpaceLayer::update(const OccupancyMap& map, const MapChange& change) {
  checkResolution(map);
  cover(boundsOf(change.columns));
  layer_.changed = {};
  for (const Cell& cell : change.columns) remeasure(map.tree(), cell);
  for (const Cell& cell : queue_) evaluate(map.tree(), cell);
  queue_.clear();
  return layer_;
}

const FreeSpace& FreeSpaceLayer::recompute(const OccupancyMap& map) {
  checkResolution(map);
  FreeSpaceLayer fresh(config_, layer_.frame);
  fresh.cover(knownColumns(map.tree()));
  const CellBox box = fresh.layer_.cells.box();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) fresh.remeasure(map.tree(), {x, y});
  for (const Cell& cell : fresh.queue_) fresh.evaluate(map.tree(), cell);
  fresh.queue_.clear();
  fresh.layer_.changed = differingCells(layer_.cells, fresh.layer_.cells);
  *this = std::move(fresh);
  return layer_;
}

void FreeSpaceLayer::reset() { *this = FreeSpaceLayer(config_, layer_.frame); }

void FreeSpaceLayer::checkResolution(const OccupancyMap& map) const {
  const double of_map = map.config().resolution_m;
  if (of_map == layer_.frame.resolution_m) return;
  throw refuse("free-space layer", "got a map of resolution " + std::to_string(of_map) + " m",
               "the layer was made for " + std::to_string(layer_.frame.resolution_m) + " m");
}

void FreeSpaceLayer::cover(const CellBox& known_columns) {
  const CellBox box = layer_.cells.box().including(widened(known_columns));
  const std::size_t cells =
      static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height());
  if (cells > kMaxLayerCells) {
    throw refuse("free-space layer",
                 "the map spans " + std::to_string(box.width()) + " x " +
                     std::to_string(box.height()) + " cells",
                 "at most " + std::to_string(kMaxLayerCells) +
                     " cells are supported: look for a pose that jumped, or use larger cells");
  }
  columns_.cover(box, ColumnState{});
  layer_.cells.cover(box, kUnknown);
}

/// Reads the column of `cell` and queues the cells whose value may follow from it.
void FreeSpaceLayer::remeasure(const octomap::OcTree& tree, const Cell& cell) {
  const VoxelRun run = lowestFreeRun({tree, cell, heights_}, needed_voxels_);
  queue(cell);
  ColumnState& column = columns_.at(cell);
  if (column.lowest_free == run) return;
  column.lowest_free = run;
  for (const Cell& step : kNeighbours) queue(cell + step);
}

void FreeSpaceLayer::queue(const Cell& cell) {
  // Beyond the box no voxel is known, so no obstacle either.
  if (!columns_.box().contains(cell) || columns_.at(cell).queued) return;
  columns_.at(cell).queued = true;
  queue_.push_back(cell);
}

void FreeSpaceLayer::evaluate(const octomap::OcTree& tree, const Cell& cell) {
  columns_.at(cell).queued = false;
  const std::int8_t value = valueOf(tree, cell);
  std::int8_t& stored = layer_.cells.at(cell);
  if (stored == value) return;
  stored = value;
  layer_.changed = layer_.changed.including(cell);
}

std::int8_t FreeSpaceLayer::valueOf(const octomap::OcTree& tree, const Cell& cell) {
  if (!columns_.at(cell).lowest_free.empty()) return kFree;
  std::array<VoxelRun, kNeighbours.size()> free_beside;
  std::size_t count = 0;
  for (const Cell& step : kNeighbours) {
    const VoxelRun run = columns_.valueOr(cell + step, ColumnState{}).lowest_free;
    if (!run.empty()) free_beside[count++] = run;
  }
  if (count == 0) return kUnknown;

  occupied_.clear();
  Column(tree, cell, heights_).forEachLeaf([this](bool occupied, const VoxelRun& leaf) {
    if (occupied) occupied_.push_back(leaf);
  });
  int level = 0;
  for (std::size_t i = 0; i < count; ++i)
    level = std::max(level, obstacleLevel(occupied_, free_beside[i]));
  // A level of zero would read as free.
  return level >= std::max(1, config_.min_obstacle_level) ? static_cast<std::int8_t>(level)
                                                          : kUnknown;
}

}  // namespace occusg
