// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/geometry/grid.hpp"
#include "occusg/regions/region.hpp"

namespace occusg {

/// The segments along which two labels touch, those shorter than `min_crossing_m` left out; ordered
/// by the labels, then by position.
[[nodiscard]] std::vector<Crossing> crossingsOf(const Grid<std::int32_t>& labels,
                                                const GridFrame& frame, double min_crossing_m);

/// Orders crossings by their regions; those of one pair stay in the order they have.
void sortByRegions(std::vector<Crossing>& crossings);

/// Names in every region those it shares a crossing with.
/// @pre regions[i] has id i + 1.
void nameNeighbours(const std::vector<Crossing>& crossings, std::vector<Region>& regions);

}  // namespace occusg
