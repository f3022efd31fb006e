// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// The height in the map frame at which most of a storey's columns have something overhead, from
/// 1.8 m above the floor on: its ceiling [m]. Empty where nothing was seen overhead.
[[nodiscard]] std::optional<double> ceilingOf(const FreeSpace& layer, double floor_z_m);

}  // namespace occusg
