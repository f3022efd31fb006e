// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_candidates.hpp"
#include "regions/squared_distance.hpp"

namespace occusg {

Grid<std::int32_t> squaredClearance(const Grid<std::uint8_t>& open) {
  return squaredDistances(open);
}

}  // namespace occusg
