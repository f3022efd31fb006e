// SPDX-License-Identifier: BSD-3-Clause
#include "regions/free_patches.hpp"

#include <cstddef>
#include <limits>
#include <utility>

#include "regions/cell_walks.hpp"
#include "regions/low_ceilings.hpp"

namespace occusg {
namespace {

/// Names of cells that belong to no patch yet.
constexpr PatchId kOpen = std::numeric_limits<PatchId>::max();
constexpr PatchId kLowRoom = kOpen - 1;
constexpr PatchId kLintel = std::numeric_limits<PatchId>::min();

/// From here on, patches are rooms with a low ceiling.
constexpr PatchId kFirstLowRoom = PatchId{1} << 30;

/// What a cell of that patch is by itself: kOpen, kLintel or kNoPatch.
PatchId kindOf(PatchId id) {
  if (id == kNoPatch) return kNoPatch;
  return isOpenPatch(id) && id < kFirstLowRoom ? kOpen : kLintel;
}

}  // namespace

PatchChanges FreePatches::update(const FreeSpace& layer, const CellBox& changed) {
  const Flips flips = flipsIn(layer, changed);
  PatchChanges changes;
  std::vector<Cell> unsorted;
  for (const PatchId id : flips.patches) takeOut(id, changes.gone);
  for (const auto& [id, patch] : changes.gone)
    unsorted.insert(unsorted.end(), patch.cells.begin(), patch.cells.end());
  for (std::size_t i = 0; i < flips.cells.size(); ++i) {
    ids_.touch(flips.cells[i]) = flips.kinds[i];
    unsorted.push_back(flips.cells[i]);
  }
  for (const PatchId id : flips.beside)
    if (changes.gone.count(id) == 0) changes.beside.insert(id);
  CellBox box;
  for (const auto& [id, patch] : changes.gone) box = box.including(patch.bounds);
  for (const Cell& cell : flips.cells) box = box.including(cell);
  // One ring more, so that every cell has neighbours.
  Grid<PatchId> ids = ids_.dense(box.grown(1));
  for (const Cell& cell : unsorted) {
    const PatchId kind = ids.at(cell);
    if (kind != kOpen && kind != kLintel) continue;
    const PatchId id = flood(cell, ids);
    const std::vector<PatchId> parts =
        kind == kLintel ? partLowRooms(id, layer.frame.resolution_m, ids) : std::vector{id};
    changes.fresh.insert(changes.fresh.end(), parts.begin(), parts.end());
  }
  return changes;
}

std::size_t FreePatches::memoryBytes() const {
  std::size_t bytes = ids_.memoryBytes();
  for (const auto& [id, patch] : patches_) bytes += patch.cells.capacity() * sizeof(Cell);
  return bytes;
}

FreePatches::Flips FreePatches::flipsIn(const FreeSpace& layer, const CellBox& changed) const {
  Flips flips;
  const Grid<PatchId> ids = ids_.dense(changed.grown(1));
  const Grid<std::int8_t> values = layer.cells.dense(changed);
  for (int y = changed.min.y; y < changed.max.y; ++y) {
    for (int x = changed.min.x; x < changed.max.x; ++x) {
      const Cell cell{x, y};
      PatchId kind = kNoPatch;
      if (values.at(cell) == kFree) kind = isUnderLintel(layer, cell, heights_) ? kLintel : kOpen;
      const PatchId before = ids.at(cell);
      if (kindOf(before) == kind) continue;
      flips.cells.push_back(cell);
      flips.kinds.push_back(kind);
      if (before != kNoPatch) flips.patches.insert(before);
      for (const Cell& beside : sideNeighbours(cell)) {
        const PatchId id = ids.at(beside);
        if (id != kNoPatch) (kindOf(id) == kind ? flips.patches : flips.beside).insert(id);
      }
    }
  }
  return flips;
}

/// Moves a patch, and those it was parted from, to `gone`.
void FreePatches::takeOut(PatchId id, std::map<PatchId, Patch>& gone) {
  auto node = patches_.extract(id);
  if (node.empty()) return;
  for (const Cell& cell : node.mapped().cells) ids_.touch(cell) = kindOf(id);
  const Patch& patch = gone.emplace(id, std::move(node.mapped())).first->second;
  for (const PatchId other : patch.parted) takeOut(other, gone);
}

/// Names the patch around `start`.
/// @param ids of a box that holds it and one ring of cells more.
PatchId FreePatches::flood(const Cell& start, Grid<PatchId>& ids) {
  const PatchId kind = ids.at(start);
  const PatchId id = kind == kLowRoom ? kFirstLowRoom + ++last_low_
                     : kind == kOpen  ? ++last_
                                      : -++last_;
  Patch patch;
  patch.cells.push_back(start);
  ids.at(start) = id;
  for (std::size_t i = 0; i < patch.cells.size(); ++i) {
    const Cell cell = patch.cells[i];
    ids_.touch(cell) = id;
    patch.bounds = patch.bounds.including(cell);
    for (const Cell& beside : sideNeighbours(cell)) {
      if (ids.at(beside) != kind) continue;
      ids.at(beside) = id;
      patch.cells.push_back(beside);
    }
  }
  patches_.emplace(id, std::move(patch));
  return id;
}

/// Parts a lintel patch into the rooms under it and the rest; gives the names of the parts, which
/// is the patch itself when there are no such rooms.
std::vector<PatchId> FreePatches::partLowRooms(PatchId lintel, double resolution_m,
                                               Grid<PatchId>& ids) {
  const Patch& whole = patches_.at(lintel);
  const std::vector<Cell> inner = cellsUnderLowCeilings(whole.cells, whole.bounds, resolution_m);
  if (inner.empty()) return {lintel};
  const std::vector<Cell> cells = patches_.extract(lintel).mapped().cells;
  for (const Cell& cell : cells) ids.at(cell) = kLintel;
  for (const Cell& cell : inner) ids.at(cell) = kLowRoom;
  std::vector<PatchId> parts;
  for (const Cell& cell : cells) {
    const PatchId id = ids.at(cell);
    if (id == kLintel || id == kLowRoom) parts.push_back(flood(cell, ids));
  }
  for (const PatchId part : parts) patches_.at(part).parted = parts;
  return parts;
}

}  // namespace occusg
