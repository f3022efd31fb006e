// SPDX-License-Identifier: BSD-3-Clause
#include "regions/cell_sums.hpp"

#include <algorithm>

#include "geometry/cell_outline.hpp"

namespace occusg {

void CellSums::addRun(int x_begin, int x_end, int row) {
  const std::int64_t length = x_end - x_begin;
  if (count == 0 || Cell{x_begin, row} < first) first = {x_begin, row};
  count += length;
  x += length * (std::int64_t{x_begin} + x_end - 1) / 2;
  y += length * row;
  bounds = bounds.including(CellBox{{x_begin, row}, {x_end, row + 1}});
}

void CellSums::add(const CellSums& other) {
  if (other.count == 0) return;
  first = count == 0 ? other.first : std::min(first, other.first);
  count += other.count;
  x += other.x;
  y += other.y;
  bounds = bounds.including(other.bounds);
}

Region regionOf(const Grid<std::int32_t>& labels, std::int32_t label, int id,
                const GridFrame& frame, const CellSums& sums) {
  Region region;
  region.id = id;
  region.polygon = toPolygon(outlinesOf(labels, label, sums.bounds).front(), frame);
  region.area_m2 = static_cast<double>(sums.count) * frame.cellArea();
  const auto count = static_cast<double>(sums.count);
  region.centroid = {(static_cast<double>(sums.x) / count + 0.5) * frame.resolution_m,
                     (static_cast<double>(sums.y) / count + 0.5) * frame.resolution_m};
  region.cells = sums.bounds;
  return region;
}

}  // namespace occusg
