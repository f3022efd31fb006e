// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace occusg {

/// A piece of free space between candidate cuts.
struct DudePiece {
  double radius_cells = 0.0;  ///< Of the largest free circle whose middle lies in it.
  std::int64_t area_cells = 0;
};

/// A candidate cut between two pieces.
struct DudeLink {
  int piece_a = 0;
  int piece_b = 0;
  double length_cells = 0.0;
  double depth_cells = 0.0;
  double keep_bonus = 0.0;  ///< Above zero for a cut that was there before.
};

struct DudeSelectionRules {
  double depth_threshold_cells = 50.0;
  /// A cut stays only where half its length is below this share of the smaller side's radius.
  double max_width_ratio = 0.8;
  std::int64_t min_area_cells = 200;
};

struct DudeSelection {
  std::vector<char> is_kept;      ///< For every link.
  std::vector<int> merged_piece;  ///< For every piece: 0 .. count - 1, in order of first pieces.
  int count = 0;
};

/// Takes all candidates as cuts and drops, worst first, those that are no narrowing: half the cut
/// is not shorter than `max_width_ratio` of the radius on its smaller side. Then pieces below the
/// smallest area join the neighbour they share the longest cut with, and last the cuts shallower
/// than the threshold go. As nothing before the last step depends on the threshold, a larger one
/// never gives more pieces. Ties: shallower, longer, later first. O(n log n) but for the pieces'
/// radii, each of which can grow once a merge.
[[nodiscard]] DudeSelection selectCuts(const std::vector<DudePiece>& pieces,
                                       const std::vector<DudeLink>& links,
                                       const DudeSelectionRules& rules);

}  // namespace occusg
