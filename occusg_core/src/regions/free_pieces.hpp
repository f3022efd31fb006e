// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "occusg/regions/constriction_decomposer.hpp"
#include "regions/basin_regions.hpp"
#include "regions/cell_sums.hpp"
#include "regions/free_patches.hpp"
#include "regions/small_pieces.hpp"

namespace occusg {

/// A piece of one open patch, with its share of the space under lintels beside it.
struct Piece {
  PatchId patch = kNoPatch;
  CellSums open;                              ///< Its cells that are not under lintels.
  std::int32_t squared_depth = 0;             ///< The largest squared clearance in it [cells2].
  std::map<PatchId, CellSums> under_lintels;  ///< Its cells by lintel patch.
  SharedEdges shared;                         ///< Cell edges shared with other pieces.
  CellSums sums;                              ///< Over all its cells.
};

/// Names of the pieces an update replaced, and of those that are new or have other cells now.
struct PieceChanges {
  std::set<std::int32_t> gone;
  std::set<std::int32_t> touched;
};

/// Free space cut into pieces, kept up to date at the cost of the open patches that change.
///
/// What an open patch is cut into follows from its cells alone: its clearance ends where it ends,
/// and lintels close the ways between patches. So the pieces after any sequence of updates are
/// those of the last layer alone. An island may hold patches of its own, such as the floor seen
/// under a table; the patch around it takes their cells.
class FreePieces {
 public:
  explicit FreePieces(const ConstrictionDecomposerConfig& config);

  /// @param changed holds every cell whose value or gap differs from the last update's layer.
  [[nodiscard]] PieceChanges update(const FreeSpace& layer, const CellBox& changed);

  /// The piece of every cell, or kNoRegion.
  [[nodiscard]] const TiledGrid<std::int32_t>& cells() const { return cells_; }
  [[nodiscard]] const std::map<std::int32_t, Piece>& pieces() const { return pieces_; }
  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  /// An open patch as it was cut.
  struct OpenPatch {
    std::vector<std::int32_t> pieces;  ///< None when the patch lies in an island of another one.
    std::vector<Cell> islands;         ///< Cells of islands that belong to its pieces.
    std::set<PatchId> lintels;         ///< Lintel patches beside it.
  };
  using CellsByPiece = std::map<std::int32_t, std::vector<Cell>>;
  /// A lintel patch as it was shared out.
  struct LintelPatch {
    CellsByPiece cells;      ///< That it gave to a piece.
    std::set<PatchId> open;  ///< Open patches beside it.
    std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> shared;
  };

  void takeBack(const PatchChanges& patches);
  void clearOpen(PatchId id, const std::vector<Cell>& cells);
  void clearLintel(PatchId id);
  void clearCovered(PatchId id);
  void erasePieces(OpenPatch& open);
  [[nodiscard]] bool owns(PatchId id, const Cell& cell) const;

  void cut(PatchId id, const GridFrame& frame);
  void write(PatchId id, const BasinRegions& regions);
  void writeRun(PatchId id, std::int32_t name, const CellBox& run,
                const Grid<std::int32_t>& squared);
  void cover(PatchId id, const Cell& cell);
  void shareOut(PatchId id);
  void countEdges(PatchId id, LintelPatch& lintel);
  void noteTouched();
  void addShared(std::int32_t a, std::int32_t b, std::int64_t edges);
  [[nodiscard]] std::int32_t create(PatchId patch);

  ConstrictionDecomposerConfig config_;
  FreePatches patches_;
  TiledGrid<std::int32_t> cells_{kNoRegion};
  std::map<std::int32_t, Piece> pieces_;
  std::map<PatchId, OpenPatch> open_;
  std::map<PatchId, LintelPatch> lintels_;
  std::vector<std::int32_t> unused_;  ///< Names of pieces that are gone.
  std::int32_t last_ = 0;

  std::set<PatchId> waiting_open_;              ///< To be cut in this update.
  std::set<PatchId> waiting_lintels_;           ///< To be shared out in this update.
  std::map<PatchId, CellsByPiece> taken_back_;  ///< What lintel patches gave before this update.
  PieceChanges changes_;
};

}  // namespace occusg
