// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include "occusg/mapping/free_space.hpp"

namespace occusg {

void divideHeights(std::vector<Storey>& storeys) {
  std::vector<Storey*> by_height;
  by_height.reserve(storeys.size());
  for (Storey& storey : storeys) {
    storey.span = {};
    by_height.push_back(&storey);
  }
  std::sort(by_height.begin(), by_height.end(),
            [](const Storey* a, const Storey* b) { return a->floor_z_m < b->floor_z_m; });
  for (std::size_t i = 1; i < by_height.size(); ++i) {
    const double boundary_m = by_height[i]->floor_z_m - kStoreyBelowFloor_m;
    by_height[i - 1]->span.top_m = boundary_m;
    by_height[i]->span.bottom_m = boundary_m;
  }
}

}  // namespace occusg
