// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "occusg/regions/region.hpp"
#include "regions/dude_partition.hpp"

namespace occusg {

/// A decomposition of which single regions can be replaced. Ids stay dense: new regions take the
/// ids of those they replace, and where fewer come than go, the last regions move down.
class DudeRegions {
 public:
  [[nodiscard]] const Decomposition& decomposition() const { return decomposition_; }
  /// Ordered by labels, then by ends.
  [[nodiscard]] const std::vector<DudeCut>& cuts() const { return cuts_; }
  [[nodiscard]] const Grid<std::int32_t>& labels() const { return decomposition_.labels; }
  [[nodiscard]] const CellBox& box(std::int32_t label) const {
    return decomposition_.regions[static_cast<std::size_t>(label - 1)].cells;
  }
  [[nodiscard]] std::size_t size() const { return decomposition_.regions.size(); }

  /// Starts over with all of `partition`.
  void assign(DudePartition partition, const GridFrame& frame);
  /// Makes room for cells of a grown layer.
  void cover(const CellBox& box) { decomposition_.labels.cover(box, kNoRegion); }
  /// Puts `partition` in the place of the regions `replaced` (sorted). Cuts between these and
  /// others stay as long as their two sides still meet there.
  void replace(const std::vector<std::int32_t>& replaced, const DudePartition& partition);

 private:
  /// Old and new id of a region that moved down.
  using Move = std::pair<std::int32_t, std::int32_t>;
  struct AffectedCuts {
    std::vector<DudeCut> remaining;        ///< Those whose sides still meet, with current labels.
    std::vector<std::int32_t> neighbours;  ///< Current labels of regions that had such a cut.
  };

  void erase(const std::vector<std::int32_t>& replaced);
  std::vector<std::int32_t> place(const std::vector<std::int32_t>& replaced,
                                  const DudePartition& partition);
  std::vector<Move> closeGaps(std::vector<std::int32_t> gaps);
  /// Takes the cuts of replaced and moved regions out of the list.
  AffectedCuts takeAffectedCuts(const std::vector<std::int32_t>& replaced,
                                const std::vector<Move>& moves, std::size_t old_size);
  void describe(std::int32_t label);
  /// Crossings of all regions and neighbours of those that are touched, from the cuts.
  void link(const std::vector<char>& is_touched);

  Decomposition decomposition_;
  std::vector<DudeCut> cuts_;
};

}  // namespace occusg
