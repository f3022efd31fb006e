// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/local_floor.hpp"

#include <algorithm>
#include <cstddef>

namespace occusg {
namespace {

int tileOfCell(int cell) {
  return cell >= 0 ? cell / kFloorTile_cells : -((kFloorTile_cells - 1 - cell) / kFloorTile_cells);
}

}  // namespace

LocalFloor::LocalFloor(int storey_voxels, int reach_tiles)
    : storey_voxels_(storey_voxels), reach_tiles_(reach_tiles), heights_(kNoFloor) {}

Cell LocalFloor::tileOf(const Cell& column) { return {tileOfCell(column.x), tileOfCell(column.y)}; }

std::int16_t LocalFloor::at(const Cell& column) const { return tiles_.at(tileOf(column)).local; }

std::size_t LocalFloor::memoryBytes() const {
  return heights_.memoryBytes() + tiles_.memoryBytes();
}

void LocalFloor::set(const Cell& column, std::int16_t height) {
  if (heights_.at(column) == height) return;
  heights_.touch(column) = height;
  const Cell name = tileOf(column);
  Tile& tile = tiles_.touch(name);
  if (tile.own_is_due) return;
  tile.own_is_due = true;
  own_due_.push_back(name);
}

const std::vector<Cell>& LocalFloor::update() {
  for (const Cell& name : own_due_) {
    Tile& tile = tiles_.touch(name);
    tile.own_is_due = false;
    const std::int16_t own = ownFloor(name);
    if (own == tile.own) continue;
    tile.own = own;
    for (int y = name.y - reach_tiles_; y <= name.y + reach_tiles_; ++y) {
      for (int x = name.x - reach_tiles_; x <= name.x + reach_tiles_; ++x) {
        Tile& beside = tiles_.touch({x, y});
        if (!beside.local_is_due) local_due_.push_back({x, y});
        beside.local_is_due = true;
      }
    }
  }
  own_due_.clear();

  for (const Cell& name : changed_) tiles_.touch(name).moved = false;
  changed_.clear();
  for (const Cell& name : local_due_) {
    Tile& tile = tiles_.touch(name);
    tile.local_is_due = false;
    const std::int16_t local = localFloor(name);
    if (local == tile.local) continue;
    tile.local = local;
    tile.moved = true;
    changed_.push_back(name);
  }
  local_due_.clear();
  return changed_;
}

std::int16_t LocalFloor::ownFloor(const Cell& tile) {
  sorted_.clear();
  for (int y = 0; y < kFloorTile_cells; ++y) {
    for (int x = 0; x < kFloorTile_cells; ++x) {
      const std::int16_t height =
          heights_.at({kFloorTile_cells * tile.x + x, kFloorTile_cells * tile.y + y});
      if (height != kNoFloor) sorted_.push_back(height);
    }
  }
  std::sort(sorted_.begin(), sorted_.end());
  for (std::size_t last = kFloorColumns - 1; last < sorted_.size(); ++last)
    if (sorted_[last] - sorted_[last + 1 - kFloorColumns] <= 1) return sorted_[last];
  return kNoFloor;
}

std::int16_t LocalFloor::localFloor(const Cell& tile) const {
  const CellBox around = CellBox{tile, {tile.x + 1, tile.y + 1}}.grown(reach_tiles_);
  const auto forEachFloor = [&](auto&& visit) {
    for (int y = around.min.y; y < around.max.y; ++y) {
      for (int x = around.min.x; x < around.max.x; ++x) {
        const std::int16_t own = tiles_.at({x, y}).own;
        if (own != kNoFloor) visit(own);
      }
    }
  };
  std::int16_t reference = tiles_.at(tile).own;
  if (reference == kNoFloor)
    forEachFloor([&](std::int16_t own) { reference = std::max(reference, own); });
  std::int16_t lowest = reference;
  forEachFloor([&](std::int16_t own) {
    if (own >= reference - storey_voxels_) lowest = std::min(lowest, own);
  });
  return lowest;
}

}  // namespace occusg
