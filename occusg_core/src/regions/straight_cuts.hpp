// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/geometry/grid.hpp"
#include "regions/clearance.hpp"
#include "regions/passages.hpp"

namespace occusg {

/// The basins with their round fronts replaced by the cuts: what the cuts separate from a basin's
/// deepest cell goes to the basin on its own side. Where cuts do not separate two basins, their
/// watershed stays. The cells under a cut go to the smaller of the labels beside them.
[[nodiscard]] Grid<std::int32_t> straightened(const Clearance& clearance,
                                              const Grid<std::int32_t>& basins,
                                              const std::vector<PassageCut>& cuts);

}  // namespace occusg
