// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "occusg/geometry/grid.hpp"
#include "occusg/geometry/tiled_grid.hpp"
#include "occusg/mapping/free_space.hpp"
#include "regions/lintels.hpp"

namespace occusg {

/// Name of a patch: positive for open space, rooms with a low ceiling included, negative for space
/// under a lintel.
using PatchId = std::int32_t;
inline constexpr PatchId kNoPatch = 0;

[[nodiscard]] constexpr bool isOpenPatch(PatchId id) { return id > kNoPatch; }

/// A 4-connected set of free cells with something overhead that counts as a lintel, or of those
/// without. What is wide enough for a room among the former is a patch of its own, the rest around
/// it is one or several (regions/low_ceilings.hpp).
struct Patch {
  std::vector<Cell> cells;
  CellBox bounds;
  std::vector<PatchId> parted;  ///< The patches it was parted from, if any: they change together.
};

/// Which patches an update replaced.
struct PatchChanges {
  std::map<PatchId, Patch> gone;
  std::vector<PatchId> fresh;
  std::set<PatchId> beside;  ///< Kept, but a cell beside them became free or stopped being so.
};

/// The free space of a layer as patches, kept up to date at the cost of the patches that change. A
/// patch keeps its name for as long as it keeps its cells.
class FreePatches {
 public:
  explicit FreePatches(const LintelHeights& heights) : heights_(heights) {}

  /// @param changed holds every cell whose value or gap differs from the last update's layer.
  [[nodiscard]] PatchChanges update(const FreeSpace& layer, const CellBox& changed);

  /// The patch a cell belongs to, or kNoPatch: it is not free.
  [[nodiscard]] PatchId at(const Cell& cell) const { return ids_.at(cell); }
  [[nodiscard]] const Patch& patch(PatchId id) const { return patches_.at(id); }
  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  /// The cells whose kind changed, and the patches they belong to or touch.
  struct Flips {
    std::vector<Cell> cells;
    std::vector<PatchId> kinds;  ///< By cell: kOpen, kLintel or kNoPatch.
    std::set<PatchId> patches;
    std::set<PatchId> beside;  ///< Patches beside such a cell.
  };

  [[nodiscard]] Flips flipsIn(const FreeSpace& layer, const CellBox& changed) const;
  void takeOut(PatchId id, std::map<PatchId, Patch>& gone);
  [[nodiscard]] PatchId flood(const Cell& start, Grid<PatchId>& ids);
  [[nodiscard]] std::vector<PatchId> partLowRooms(PatchId lintel, double resolution_m,
                                                  Grid<PatchId>& ids);

  LintelHeights heights_;
  TiledGrid<PatchId> ids_{kNoPatch};
  std::map<PatchId, Patch> patches_;
  PatchId last_ = 0;      ///< Largest name of a patch that is no room with a low ceiling.
  PatchId last_low_ = 0;  ///< The same of those that are.
};

}  // namespace occusg
