// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/free_space_projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "mapping/column_bits.hpp"
#include "mapping/measured_evidence.hpp"
#include "mapping/voxel_columns.hpp"
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
  (void)checked(config);
  const VoxelRun heights = heightsBetween(config, frame.resolution_m);
  if (heights.length() < voxelsFor(config.min_free_gap_m, frame.resolution_m)) {
    throw refuse("highest_z_m", "is " + std::to_string(config.highest_z_m) + " m",
                 "it must leave min_free_gap_m = " + std::to_string(config.min_free_gap_m) +
                     " m of whole voxels above lowest_z_m = " + std::to_string(config.lowest_z_m));
  }
}

/// Within this distance the floor of one place says what the floor of another is.
constexpr double kFloorReach_m = 1.0;

/// What is free up to here above the floor's height has no floor there.
constexpr double kFloorThickness_m = 0.1;

int floorReach_tiles(double resolution_m) {
  constexpr int kFarthest_tiles = 16;
  const double tiles = std::ceil(kFloorReach_m / (kFloorTile_cells * resolution_m) - 0.5);
  return static_cast<int>(std::clamp<double>(tiles, 1, kFarthest_tiles));
}

const FreeSpaceLayerConfig& usable(const FreeSpaceLayerConfig& config, const GridFrame& frame) {
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

std::size_t cellsIn(const CellBox& box) {
  return static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height());
}

CellBox boundsOf(const std::vector<Cell>& columns) {
  CellBox box;
  for (const Cell& column : columns) box = box.including(column);
  return box;
}

/// To what degree a column fills a free run beside it, 0..100: full from one half on.
int obstacleLevel(const ColumnBits& column, const VoxelRun& free) {
  return std::min<int>(kFullObstacle, 2 * (100 * column.occupiedIn(free) / free.length()));
}

}  // namespace

/// The map being read, and what is reused between its columns.
struct FreeSpaceProjection::Reading {
  const VoxelColumns& columns;
  EvidenceHeights evidence_heights;
  ColumnBits bits;
};

FreeSpaceProjection::FreeSpaceProjection(const FreeSpaceLayerConfig& config, const GridFrame& frame)
    : config_(usable(config, frame)),
      needed_voxels_(voxelsFor(config.min_free_gap_m, frame.resolution_m)),
      heights_(heightsBetween(config, frame.resolution_m)),
      floors_(evidenceHeights(config.evidence, frame.resolution_m).ceiling,
              floorReach_tiles(frame.resolution_m)) {
  layer_.frame = frame;
}

const FreeSpace& FreeSpaceProjection::update(const OccupancyMap& map, const MapChange& change) {
  checkResolution(map);
  apply(map.columns(), change.columns);
  return layer_;
}

const FreeSpace& FreeSpaceProjection::recompute(const OccupancyMap& map) {
  checkResolution(map);
  return rebuild(VoxelColumns::of(map.tree()));
}

const FreeSpace& FreeSpaceProjection::confine(const OccupancyMap& map, const HeightSpan& span) {
  checkResolution(map);
  const double resolution_m = layer_.frame.resolution_m;
  storey_ = {clampedHeight(std::round(span.bottom_m / resolution_m)),
             clampedHeight(std::round(span.top_m / resolution_m))};
  return rebuild(map.columns());
}

const FreeSpace& FreeSpaceProjection::rebuild(const VoxelColumns& columns) {
  FreeSpaceProjection fresh(config_, layer_.frame);
  fresh.storey_ = storey_;
  fresh.apply(columns, columns.knownColumns());
  fresh.queue_.shrink_to_fit();  // it held every cell
  const CellBox box = fresh.layer_.cells.box().including(layer_.cells.box());
  fresh.layer_.changed = fresh.layer_.cells.differingFrom(layer_.cells);
  fresh.layer_.gaps_changed = fresh.layer_.evidence.differingFrom(layer_.evidence, box);
  *this = std::move(fresh);
  return layer_;
}

void FreeSpaceProjection::reset() {
  const VoxelRun storey = storey_;
  *this = FreeSpaceProjection(config_, layer_.frame);
  storey_ = storey;
}

std::size_t FreeSpaceProjection::memoryBytes() const {
  return layer_.cells.memoryBytes() + layer_.evidence.memoryBytes() + columns_.memoryBytes() +
         floors_.memoryBytes() + queue_.capacity() * sizeof(Cell);
}

void FreeSpaceProjection::checkResolution(const OccupancyMap& map) const {
  const double of_map = map.config().resolution_m;
  if (of_map == layer_.frame.resolution_m) return;
  throw refuse("free-space layer", "got a map of resolution " + std::to_string(of_map) + " m",
               "the layer was made for " + std::to_string(layer_.frame.resolution_m) + " m");
}

bool FreeSpaceProjection::canCover(const CellBox& box) const {
  return cellsIn(layer_.cells.box().including(widened(box))) <= kMaxLayerCells;
}

void FreeSpaceProjection::cover(const CellBox& known_columns) {
  const CellBox box = layer_.cells.box().including(widened(known_columns));
  if (cellsIn(box) > kMaxLayerCells) {
    throw refuse("free-space layer",
                 "the map spans " + std::to_string(box.width()) + " x " +
                     std::to_string(box.height()) + " cells",
                 "at most " + std::to_string(kMaxLayerCells) +
                     " cells are supported: look for a pose that jumped, or use larger cells");
  }
  layer_.cells.cover(box);
}

void FreeSpaceProjection::read(Reading& reading, const Cell& cell) const {
  reading.columns.read(cell, reading.bits);
  if (storey_ == kAllHeights) return;
  const int fall = static_cast<int>(std::ceil(kLeastFall_m / layer_.frame.resolution_m));
  const int through = static_cast<int>(
      std::ceil((kStoreyBelowFloor_m + kFloorThickness_m) / layer_.frame.resolution_m));
  const VoxelRun below = reading.bits.nextFree(storey_.bottom - fall);
  const bool opens_downwards = !below.empty() && below.bottom == storey_.bottom - fall &&
                               below.top >= storey_.bottom + through;
  reading.bits.keep(opens_downwards ? VoxelRun{} : storey_);
}

void FreeSpaceProjection::apply(const VoxelColumns& columns, const std::vector<Cell>& changed) {
  cover(boundsOf(changed));
  layer_.changed = {};
  layer_.gaps_changed = {};
  Reading reading{columns, evidenceHeights(config_.evidence, layer_.frame.resolution_m), {}};
  for (const Cell& cell : changed) {
    read(reading, cell);
    floors_.set(cell, shownFloor(reading.bits, needed_voxels_));
  }
  const std::vector<Cell>& moved_floors = floors_.update();
  for (const Cell& cell : changed) {
    if (floors_.hasMoved(cell)) continue;  // comes with its tile
    read(reading, cell);
    remeasure(reading, cell);
  }
  for (const Cell& tile : moved_floors) {
    for (int i = 0; i < kFloorTile_cells * kFloorTile_cells; ++i) {
      const Cell cell{kFloorTile_cells * tile.x + i % kFloorTile_cells,
                      kFloorTile_cells * tile.y + i / kFloorTile_cells};
      read(reading, cell);
      if (!reading.bits.empty()) remeasure(reading, cell);
    }
  }
  for (const Cell& cell : queue_) evaluate(reading, cell);
  queue_.clear();
}

/// Takes over the column of `cell` and queues the cells whose value may follow from it.
void FreeSpaceProjection::remeasure(const Reading& reading, const Cell& cell) {
  const std::int16_t floor = floors_.at(cell);
  const ColumnEvidence evidence = measuredEvidence(reading.bits, floor, reading.evidence_heights);
  const ColumnEvidence& before = layer_.evidence.at(cell);
  if (!haveSameGap(before, evidence)) layer_.gaps_changed = layer_.gaps_changed.including(cell);
  if (before != evidence) layer_.evidence.touch(cell) = evidence;

  const VoxelRun run = reading.bits.lowestFree(heightsAt(floor), needed_voxels_);
  queue(cell);
  ColumnState& column = columns_.touch(cell);
  if (column.lowest_free == run) return;
  column.lowest_free = run;
  for (const Cell& step : kNeighbours) queue(cell + step);
}

VoxelRun FreeSpaceProjection::heightsAt(std::int16_t floor) const {
  if (config_.height_reference == HeightReference::kMap) return heights_;
  if (floor == kNoFloor) return kAllHeights;
  return {floor + heights_.bottom, floor + heights_.top};
}

void FreeSpaceProjection::queue(const Cell& cell) {
  // Beyond the box no voxel is known, so no obstacle either.
  if (!layer_.cells.box().contains(cell)) return;
  bool& queued = columns_.touch(cell).queued;
  if (queued) return;
  queued = true;
  queue_.push_back(cell);
}

void FreeSpaceProjection::evaluate(Reading& reading, const Cell& cell) {
  columns_.touch(cell).queued = false;
  const std::int8_t value = valueOf(reading, cell);
  std::int8_t& stored = layer_.cells.at(cell);
  if (stored == value) return;
  stored = value;
  layer_.changed = layer_.changed.including(cell);
}

std::int8_t FreeSpaceProjection::valueOf(Reading& reading, const Cell& cell) const {
  if (!columns_.at(cell).lowest_free.empty()) return kFree;
  std::array<VoxelRun, kNeighbours.size()> free_beside;
  std::size_t count = 0;
  for (const Cell& step : kNeighbours) {
    const VoxelRun run = columns_.at(cell + step).lowest_free;
    if (!run.empty()) free_beside[count++] = run;
  }
  if (count == 0) return kUnknown;

  read(reading, cell);
  int level = 0;
  for (std::size_t i = 0; i < count; ++i)
    level = std::max(level, obstacleLevel(reading.bits, free_beside[i]));
  // A level of zero would read as free.
  return level >= std::max(1, config_.min_obstacle_level) ? static_cast<std::int8_t>(level)
                                                          : kUnknown;
}

}  // namespace occusg
