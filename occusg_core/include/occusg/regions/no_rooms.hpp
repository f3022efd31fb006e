// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// Why a free-space layer gives no room, in one sentence an operator can act on: how much of it is
/// free and in how large pieces (4-connected), or what it holds instead.
/// @param min_region_area_m2 of the decomposer: what is smaller becomes no region.
[[nodiscard]] std::string whyNoRooms(const FreeSpace& layer, double min_region_area_m2);

}  // namespace occusg
