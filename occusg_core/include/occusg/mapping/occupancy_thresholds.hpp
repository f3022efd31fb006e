// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace occusg {

/// From which occupancy on a cell of a 2D map bounds rooms, and below which it is free [percent].
struct OccupancyThresholds {
  double free_below = 50.0;
  double occupied_above = 50.0;
};

/// How many cells of a map have the occupancy 0, 1, ..., 100 %; unknown cells are not counted.
using OccupancyHistogram = std::array<std::size_t, 101>;

/// How the values of a map are meant.
enum class OccupancyKind {
  kDecided,      ///< Most cells are 0 or 100: free or occupied, the rest something between.
  kProbability,  ///< Most cells lie between: probabilities, as cartographer, slam_toolbox and
                 ///< gmapping give them.
};

/// A map is one of probabilities when more than half of its known cells lie between 0 and 100 and
/// take at least four different values. An empty map is decided.
[[nodiscard]] OccupancyKind occupancyKind(const OccupancyHistogram& counts);

/// The share of known cells that are neither 0 nor 100; 0 for an empty map.
[[nodiscard]] double shareBetween(const OccupancyHistogram& counts);

/// What a cell of occupancy `percent` is to a free-space layer: `kFree`, `kUnknown` between the
/// thresholds, else `kFullObstacle`. A value outside 0..100 is unknown.
[[nodiscard]] std::int8_t decidedCell(double percent, const OccupancyThresholds& thresholds);

}  // namespace occusg
