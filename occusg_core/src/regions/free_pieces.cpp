// SPDX-License-Identifier: BSD-3-Clause
#include "regions/free_pieces.hpp"

#include <algorithm>
#include <cstddef>

#include "regions/cell_walks.hpp"
#include "regions/lintels.hpp"

namespace occusg {
namespace {

/// [m] Lower than a low door: something that hangs lower is furniture.
constexpr double kLowestLintel_m = 1.7;

/// Closed everywhere but in `patch`.
Grid<std::int8_t> closedAround(const Patch& patch) {
  Grid<std::int8_t> cells(patch.bounds, kFullObstacle);
  for (const Cell& cell : patch.cells) cells.at(cell) = kFree;
  return cells;
}

/// Gives every 4-connected set of cells of a patch that has no label one of its own.
void labelTheRest(const Grid<std::int8_t>& closed, const std::vector<Cell>& cells,
                  Grid<std::int32_t>& labels) {
  std::int32_t last = 0;
  for (const Cell& cell : cells) last = std::max(last, labels.at(cell));
  for (const Cell& cell : cells) {
    if (labels.at(cell) != kNoRegion) continue;
    labels.at(cell) = ++last;
    spreadLabels(
        {cell}, [&](const Cell& beside) { return closed.valueOr(beside, kUnknown) == kFree; },
        labels);
  }
}

}  // namespace

FreePieces::FreePieces(const ConstrictionDecomposerConfig& config)
    : config_(config), patches_({kLowestLintel_m, config.highest_lintel_m}) {}

PieceChanges FreePieces::update(const FreeSpace& layer, const CellBox& changed) {
  changes_ = {};
  waiting_open_.clear();
  waiting_lintels_.clear();
  taken_back_.clear();
  const PatchChanges patches = patches_.update(layer, changed);
  takeBack(patches);
  for (const PatchId id : patches.fresh)
    (isOpenPatch(id) ? waiting_open_ : waiting_lintels_).insert(id);
  for (const PatchId id : waiting_open_) cut(id, layer.frame);
  for (const PatchId id : waiting_lintels_) shareOut(id);
  noteTouched();
  unused_.insert(unused_.end(), changes_.gone.begin(), changes_.gone.end());
  return changes_;
}

std::size_t FreePieces::memoryBytes() const {
  return patches_.memoryBytes() + cells_.memoryBytes();
}

/// Takes from the pieces whatever follows from patches that changed.
void FreePieces::takeBack(const PatchChanges& patches) {
  for (const PatchId id : patches.beside)
    if (!isOpenPatch(id)) clearLintel(id);
  for (const auto& [id, patch] : patches.gone)
    if (!isOpenPatch(id)) clearLintel(id);
  for (const auto& [id, patch] : patches.gone)
    if (isOpenPatch(id)) clearOpen(id, patch.cells);
  for (const auto& [id, patch] : patches.gone) {
    open_.erase(id);
    lintels_.erase(id);
    waiting_open_.erase(id);
    waiting_lintels_.erase(id);
  }
}

void FreePieces::clearOpen(PatchId id, const std::vector<Cell>& cells) {
  OpenPatch& open = open_[id];
  for (const PatchId lintel : std::set<PatchId>(open.lintels)) clearLintel(lintel);
  // Nobody else takes single cells of an open patch: all are its own, or none.
  if (!open.pieces.empty())
    for (const Cell& cell : cells) cells_.touch(cell) = kNoRegion;
  std::set<PatchId> uncovered;
  for (const Cell& cell : open.islands) {
    if (!owns(id, cell)) continue;
    cells_.touch(cell) = kNoRegion;
    const PatchId under = patches_.at(cell);
    if (under != kNoPatch && under != id) uncovered.insert(under);
  }
  erasePieces(open);
  for (const PatchId under : uncovered) {
    // A fresh patch waits already, and nothing is known of it yet.
    if (isOpenPatch(under) && open_.count(under) > 0 && waiting_open_.insert(under).second)
      clearOpen(under, patches_.patch(under).cells);
    if (!isOpenPatch(under) && lintels_.count(under) > 0) clearLintel(under);
  }
}

void FreePieces::clearLintel(PatchId id) {
  const auto found = lintels_.find(id);
  if (found == lintels_.end()) return;
  waiting_lintels_.insert(id);
  LintelPatch& lintel = found->second;
  for (const auto& [piece, cells] : lintel.cells) {
    for (const Cell& cell : cells) cells_.touch(cell) = kNoRegion;
    pieces_.at(piece).under_lintels.erase(id);
  }
  for (const auto& [pieces, edges] : lintel.shared) addShared(pieces.first, pieces.second, -edges);
  for (const PatchId open : lintel.open) open_.at(open).lintels.erase(id);
  taken_back_.emplace(id, std::move(lintel.cells));
  lintel = {};
}

/// Makes way for an island over a patch that was cut or shared out before.
void FreePieces::clearCovered(PatchId id) {
  if (!isOpenPatch(id)) {
    clearLintel(id);
    return;
  }
  const auto open = open_.find(id);
  if (open != open_.end() && !open->second.pieces.empty()) clearOpen(id, patches_.patch(id).cells);
}

void FreePieces::erasePieces(OpenPatch& open) {
  for (const std::int32_t piece : open.pieces) {
    for (const auto& [other, edges] : pieces_.at(piece).shared)
      pieces_.at(other).shared.erase(piece);
    pieces_.erase(piece);
    changes_.gone.insert(piece);
  }
  open = {};
}

/// True when the cell belongs to a piece of that open patch.
bool FreePieces::owns(PatchId id, const Cell& cell) const {
  const std::int32_t piece = cells_.at(cell);
  return piece != kNoRegion && pieces_.at(piece).patch == id;
}

/// Cuts an open patch into pieces.
void FreePieces::cut(PatchId id, const GridFrame& frame) {
  const Patch& patch = patches_.patch(id);
  open_[id];
  // The patch lies in an island of the one around it, which has taken its cells.
  if (cells_.at(patch.cells.front()) != kNoRegion) return;
  const Grid<std::int8_t> closed = closedAround(patch);
  BasinRegions regions = basinRegionsOf(closed, frame, config_);
  // What is small between its doors may be a room with its share of them.
  if (config_.highest_lintel_m > 0.0) labelTheRest(closed, patch.cells, regions.labels);
  write(id, regions);
}

/// Makes pieces of the labels of an open patch.
void FreePieces::write(PatchId id, const BasinRegions& regions) {
  const Grid<std::int32_t>& labels = regions.labels;
  const CellBox& box = labels.box();
  std::vector<std::int32_t> piece_of{kNoRegion};
  const auto pieceOf = [&](std::int32_t label) {
    const auto i = static_cast<std::size_t>(label);
    if (i >= piece_of.size()) piece_of.resize(i + 1, kNoRegion);
    if (label != kNoRegion && piece_of[i] == kNoRegion) piece_of[i] = create(id);
    return piece_of[i];
  };
  const auto countEdge = [&](std::int32_t a, std::int32_t b) {
    if (a != b && a != kNoRegion && b != kNoRegion) addShared(pieceOf(a), pieceOf(b), 1);
  };
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x;) {
      const std::int32_t label = labels.at({x, y});
      int end = x + 1;
      while (end < box.max.x && labels.at({end, y}) == label) ++end;
      if (label != kNoRegion) writeRun(id, pieceOf(label), {{x, y}, {end, y + 1}}, regions.squared);
      if (end < box.max.x) countEdge(label, labels.at({end, y}));
      x = end;
    }
    for (int x = box.min.x; y + 1 < box.max.y && x < box.max.x; ++x)
      countEdge(labels.at({x, y}), labels.at({x, y + 1}));
  }
}

/// Gives a part of a row to a piece.
void FreePieces::writeRun(PatchId id, std::int32_t name, const CellBox& run,
                          const Grid<std::int32_t>& squared) {
  Piece& piece = pieces_.at(name);
  piece.open.addRun(run.min.x, run.max.x, run.min.y);
  forEachCell(run, [&](const Cell& cell) {
    if (patches_.at(cell) != id) cover(id, cell);
    cells_.touch(cell) = name;
    piece.squared_depth = std::max(piece.squared_depth, squared.at(cell));
  });
}

/// Takes a cell of an island of the open patch `id` from the patch that lies there.
void FreePieces::cover(PatchId id, const Cell& cell) {
  const PatchId under = patches_.at(cell);
  if (under != kNoPatch) clearCovered(under);
  // A patch inside the island may itself have had an island here.
  const std::int32_t piece = cells_.at(cell);
  if (piece != kNoRegion) clearCovered(pieces_.at(piece).patch);
  open_.at(id).islands.push_back(cell);
}

/// Shares the cells of a lintel patch out to the nearest pieces beside it.
void FreePieces::shareOut(PatchId id) {
  LintelPatch& lintel = lintels_[id];
  const Patch& patch = patches_.patch(id);
  Grid<std::int32_t> labels = cells_.dense(patch.bounds.grown(1));
  std::vector<Cell> reached;
  forEachCell(labels.box(), [&](const Cell& cell) {
    if (labels.at(cell) != kNoRegion) reached.push_back(cell);
  });
  spreadLabels(
      std::move(reached), [&](const Cell& cell) { return patches_.at(cell) == id; }, labels);
  for (const Cell& cell : patch.cells) {
    for (const Cell& beside : sideNeighbours(cell)) {
      const PatchId open = patches_.at(beside);
      if (!isOpenPatch(open)) continue;
      open_.at(open).lintels.insert(id);
      lintel.open.insert(open);
    }
    const std::int32_t piece = labels.at(cell);
    if (piece == kNoRegion || cells_.at(cell) != kNoRegion) continue;
    cells_.touch(cell) = piece;
    lintel.cells[piece].push_back(cell);
    pieces_.at(piece).under_lintels[id].addRun(cell.x, cell.x + 1, cell.y);
  }
  countEdges(id, lintel);
}

/// Counts the edges that the cells of a lintel patch share with pieces other than their own.
void FreePieces::countEdges(PatchId id, LintelPatch& lintel) {
  for (const auto& [piece, cells] : lintel.cells) {
    for (const Cell& cell : cells) {
      for (const Cell& beside : sideNeighbours(cell)) {
        const std::int32_t other = cells_.at(beside);
        if (other == kNoRegion || other == piece) continue;
        // An edge inside the patch is met from both sides.
        if (patches_.at(beside) == id && beside < cell) continue;
        ++lintel.shared[std::minmax(piece, other)];
      }
    }
  }
  for (const auto& [pieces, edges] : lintel.shared) addShared(pieces.first, pieces.second, edges);
}

/// Notes the pieces that lintel patches gave other cells than before, and sums up what is new.
void FreePieces::noteTouched() {
  for (const PatchId id : waiting_lintels_) taken_back_[id];
  static const CellsByPiece kNone;
  for (const auto& [id, before] : taken_back_) {
    const auto found = lintels_.find(id);
    const CellsByPiece& now = found == lintels_.end() ? kNone : found->second.cells;
    for (const auto& [piece, cells] : before) {
      const auto same = now.find(piece);
      if (same == now.end() || same->second != cells) changes_.touched.insert(piece);
    }
    for (const auto& [piece, cells] : now)
      if (before.count(piece) == 0) changes_.touched.insert(piece);
  }
  for (const std::int32_t piece : changes_.gone) changes_.touched.erase(piece);
  for (const std::int32_t name : changes_.touched) {
    Piece& piece = pieces_.at(name);
    piece.sums = piece.open;
    for (const auto& [lintel, sums] : piece.under_lintels) piece.sums.add(sums);
  }
}

void FreePieces::addShared(std::int32_t a, std::int32_t b, std::int64_t edges) {
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    SharedEdges& shared = pieces_.at(from).shared;
    if ((shared[to] += edges) == 0) shared.erase(to);
  }
}

std::int32_t FreePieces::create(PatchId patch) {
  std::int32_t piece = 0;
  if (unused_.empty()) {
    piece = ++last_;
  } else {
    piece = unused_.back();
    unused_.pop_back();
  }
  pieces_[piece].patch = patch;
  open_.at(patch).pieces.push_back(piece);
  changes_.touched.insert(piece);
  return piece;
}

}  // namespace occusg
