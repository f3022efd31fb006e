// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/cell_outline.hpp"

namespace occusg {

/// A hull edge that is no ring edge, and the chain of the ring behind it (Liu, Xi, Lien:
/// "Dual-space decomposition of 2D complex shapes", CVPR 2014: bridge and pocket). A pocket is a
/// shape of its own, whose hull has pockets again: even levels are obstacle that reaches into free
/// space, odd levels free space between obstacles.
struct DudeBridge {
  std::size_t first = 0;  ///< Position on the ring where the pocket starts.
  std::size_t last = 0;  ///< Position where it ends, beyond `first`; counts on past the ring's end.
  int parent = -1;       ///< Index of the bridge whose pocket this one lies in; -1 for hull edges.
  int level = 0;
};

/// Positions of the ring's corners that are corners of its convex hull, ascending. The ring may run
/// either way. O(n log n).
[[nodiscard]] std::vector<std::size_t> hullPositions(const CornerRing& ring);

/// The tree of pockets of a ring, parents before children, down to pockets nowhere deeper than
/// `min_depth_cells` and at most `max_levels` levels.
[[nodiscard]] std::vector<DudeBridge> pocketTree(const CornerRing& ring, double min_depth_cells,
                                                 int max_levels);

/// How deep every corner of an outer ring lies behind the bridge of the hull [cells]; 0 on the
/// hull.
[[nodiscard]] std::vector<double> pocketDepths(const CornerRing& ring);

/// Distance between a point and a segment, all given by corners [cells].
[[nodiscard]] double segmentDistance(const Cell& a, const Cell& b, const Cell& point);

}  // namespace occusg
