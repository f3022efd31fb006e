// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "occusg/regions/region.hpp"

namespace occusg {

/// The labels of a box; kNoRegion where `labels` does not reach.
[[nodiscard]] inline Grid<std::int32_t> labelsOver(const CellBox& box,
                                                   const Grid<std::int32_t>& labels) {
  Grid<std::int32_t> result(box, kNoRegion);
  const CellBox common = labels.box().intersected(box);
  for (int y = common.min.y; y < common.max.y; ++y)
    std::copy_n(&labels.at({common.min.x, y}), common.width(), &result.at({common.min.x, y}));
  return result;
}

}  // namespace occusg
