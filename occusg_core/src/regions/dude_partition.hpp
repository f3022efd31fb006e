// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/cell_outline.hpp"
#include "occusg/geometry/grid.hpp"
#include "occusg/regions/dude_decomposer.hpp"
#include "regions/dude_mask.hpp"
#include "regions/dude_selection.hpp"

namespace occusg {

/// A cut that was chosen, by its ends (cell corners of the map).
struct DudeCut {
  Cell a;
  Cell b;
  std::int32_t label_a = 0;
  std::int32_t label_b = 0;
  double depth_cells = 0.0;
};

struct DudePartitionRules {
  DudeSelectionRules selection;
  double longest_cut_cells = 100.0;
  double keep_bonus = 0.2;  ///< For cuts between corners that were cut before.
};

/// What led to the cuts, in map cells.
struct DudeSteps {
  std::vector<std::pair<Cell, double>> minima;  ///< With their depths [cells].
  std::vector<Cell> feet;
  std::vector<DudeCut> candidates;
};

struct DudePartition {
  Grid<std::int32_t> labels;   ///< 1 .. count, 0 outside.
  std::vector<CellBox> boxes;  ///< Bounds of the cells of label i + 1.
  std::vector<DudeCut> cuts;   ///< Ordered as found.

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(boxes.size()); }
};

/// Ends of cuts that were there before, to be found quickly.
class DudeOldCuts {
 public:
  explicit DudeOldCuts(const std::vector<DudeCut>& cuts);
  /// True when a cut ran between these two corners, give or take a few cells at each end.
  [[nodiscard]] bool has(const Cell& a, const Cell& b) const;

 private:
  std::vector<std::pair<Cell, Cell>> ends_;  ///< Smaller corner first; sorted.
};

/// Cuts the components of `mask` into pieces, each by itself in its canonical place: equal
/// components give equal pieces wherever and however turned they lie. Components below the smallest
/// area get no label.
/// @param open not 0 where the map is free; contains `mask`, so that a border of the mask inside
///     free space is not taken for a wall.
/// @param steps filled when not null.
[[nodiscard]] DudePartition partitioned(const DudeMask& mask, const Grid<std::uint8_t>& open,
                                        const DudePartitionRules& rules,
                                        const DudeOldCuts& old_cuts, DudeCounters& counters,
                                        DudeSteps* steps = nullptr);

/// Free cells of a component.
[[nodiscard]] std::int64_t cellCount(const CellOutline& outline);

}  // namespace occusg
