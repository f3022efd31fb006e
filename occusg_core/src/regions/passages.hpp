// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/geometry/grid.hpp"
#include "regions/clearance.hpp"

namespace occusg {

/// The straight way across a passage: the closed cells of its two jambs.
struct PassageCut {
  Cell jamb_a;  ///< The smaller one.
  Cell jamb_b;
};

/// When the passage between two basins is a real narrowing.
struct NarrowingRules {
  double widest_passage_cells = 0.0;  ///< A wider passage never separates.
  double depth_ratio = 0.0;           ///< One below this share of the shallower basin's depth does.
  double widening = 1.0;     ///< So does one beyond which both sides get so many times wider ...
  double reach_cells = 0.0;  ///< ... within this distance: a door in the wall of a corridor.
};

/// The basins, those without a real narrowing between them joined, from the widest passage down.
[[nodiscard]] Grid<std::int32_t> joinedAcrossOpenings(const Clearance& clearance,
                                                      const Grid<std::int32_t>& basins,
                                                      const NarrowingRules& rules);

/// When a region is a niche of its neighbour.
struct NicheRules {
  double most_open_ratio = 0.55;  ///< Width of the opening to the side of a square of its area.
  double widening = 1.0;          ///< Not where both sides get so many times wider ...
  double reach_cells = 0.0;       ///< ... within this distance: an opening in a wall.
};

/// The regions, those whose opening is wide for their size joined to what they open to, the most
/// open first: corners behind desks and recesses of a wall are no rooms.
[[nodiscard]] Grid<std::int32_t> withoutNiches(const Clearance& clearance,
                                               const Grid<std::int32_t>& regions,
                                               const NicheRules& rules);

/// For every contact of two basins the shortest segment between the obstacles on either side of
/// its saddle, where there is one.
[[nodiscard]] std::vector<PassageCut> passageCuts(const Clearance& clearance,
                                                  const Grid<std::int32_t>& basins);

}  // namespace occusg
