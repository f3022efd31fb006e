// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "occusg/geometry/grid.hpp"

namespace occusg {

/// The squared Euclidean distance [cells2] of every cell to the nearest closed one, exact in
/// integers for grids of any shape; what lies outside the grid is closed. `open` holds 0 for closed
/// cells. Linear in the number of cells. Source: Meijster, Roerdink and Hesselink, "A general
/// algorithm for computing distance transforms in linear time", 2000. Transforms in floating point
/// are wrong from 4097 columns on, where squares exceed 24 bits.
[[nodiscard]] Grid<std::int32_t> squaredDistances(const Grid<std::uint8_t>& open);

}  // namespace occusg
