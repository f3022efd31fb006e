// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/geometry/grid.hpp"
#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// Value of a label cell that belongs to no region.
inline constexpr std::int32_t kNoRegion = 0;

/// One piece of free space.
struct Region {
  int id = 0;                 ///< Positive: a label, or the id of a track.
  Polygon polygon;            ///< Simple, counter-clockwise, with holes, map frame [m].
  double area_m2 = 0.0;       ///< Area of `polygon`, holes taken out.
  Point2 centroid;            ///< Of `polygon`; may lie outside it.
  CellBox cells;              ///< Bounds of its cells in the label grid.
  std::vector<int> adjacent;  ///< Ids of regions it shares a crossing with; sorted, unique.
};

/// Where two regions meet: a straight segment that separates them, a door candidate.
struct Crossing {
  int region_a = 0;  ///< Smaller id.
  int region_b = 0;  ///< Larger id.
  Segment2 segment;  ///< Map frame [m].
};

/// Free space cut into regions. Ids are 1..n in list order and mean nothing beyond this value.
struct Decomposition {
  GridFrame frame;
  std::vector<Region> regions;
  std::vector<Crossing> crossings;  ///< Ordered by (region_a, region_b), then by position.
  Grid<std::int32_t> labels;        ///< Region id of every cell, kNoRegion elsewhere.
  /// Counts the updates of a decomposer that says what stayed the same. Zero: it does not say.
  std::uint64_t update = 0;
  /// By region, when `update` is not zero: its id in update `update` - 1 if it had the same cells
  /// there, else 0.
  std::vector<int> same_as{};
};

}  // namespace occusg
