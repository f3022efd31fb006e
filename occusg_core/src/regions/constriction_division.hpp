// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "occusg/regions/constriction_decomposer.hpp"
#include "occusg/regions/region.hpp"
#include "regions/free_pieces.hpp"

namespace occusg {

/// The decomposition of a layer with column evidence, kept from update to update: what follows
/// from patches of open space that did not change is not computed again. Equal layers have equal
/// decompositions, whatever came before.
class ConstrictionDivision {
 public:
  /// @param updates so many updates are counted before the first.
  ConstrictionDivision(const ConstrictionDecomposerConfig& config, std::uint64_t updates);

  /// @param changed holds every cell whose value or gap differs from the last update's layer.
  const Decomposition& update(const FreeSpace& layer, const CellBox& changed);

  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  using PieceNames = std::set<std::int32_t>;
  /// A region, or a set of cells too narrow for one. Its name is that of the piece that has the
  /// others, which are small.
  struct Group {
    std::vector<std::int32_t> pieces;
    CellSums sums;
    std::int32_t squared_depth = 0;  ///< The largest squared clearance in it [cells2].
  };
  /// A region in the order of ids.
  struct Place {
    Cell first;  ///< Of its cells; the order of ids follows it.
    std::int32_t group = 0;
    int old_id = 0;  ///< In the last decomposition, if it had the same cells; else 0.

    friend bool operator<(const Place& a, const Place& b) { return a.first < b.first; }
  };

  [[nodiscard]] std::int64_t minCells() const;
  [[nodiscard]] std::map<std::int32_t, std::int32_t> heirs() const;
  [[nodiscard]] PieceNames regroup(const PieceChanges& changes);
  [[nodiscard]] PieceNames movedPieces(const PieceChanges& changes);
  [[nodiscard]] bool isTooNarrow(const Group& group) const;
  [[nodiscard]] std::vector<CellBox> reorder(const PieceNames& changed);
  void writeLabels(const std::vector<CellBox>& boxes);
  void drawRegions();
  void updateCrossings();
  [[nodiscard]] std::vector<Crossing> crossingsOfNewRegions() const;
  [[nodiscard]] std::int32_t groupOf(std::int32_t piece) const;

  ConstrictionDecomposerConfig config_;
  FreePieces pieces_;
  PieceNames small_;                            ///< Pieces that are no region of their own.
  std::map<std::int32_t, std::int32_t> heirs_;  ///< By small piece: what has it, or kNoRegion.
  std::map<std::int32_t, Group> groups_;        ///< By name.
  std::vector<std::int32_t> group_of_piece_;    ///< By piece; kNoRegion: in none.
  std::vector<Place> order_;                    ///< The i-th place belongs to id i + 1.
  std::vector<int> id_of_piece_;                ///< By piece; 0: in no region.
  Decomposition decomposition_;
};

}  // namespace occusg
