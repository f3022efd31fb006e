// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/occupancy_thresholds.hpp"

#include <algorithm>
#include <numeric>

#include "occusg/mapping/free_space_cells.hpp"

namespace occusg {

double shareBetween(const OccupancyHistogram& counts) {
  const std::size_t known = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  if (known == 0) return 0.0;
  const std::size_t decided = counts.front() + counts.back();
  return static_cast<double>(known - decided) / static_cast<double>(known);
}

OccupancyKind occupancyKind(const OccupancyHistogram& counts) {
  constexpr int kFewestValues = 4;
  const auto values = std::count_if(counts.begin() + 1, counts.end() - 1,
                                    [](std::size_t count) { return count > 0; });
  return shareBetween(counts) > 0.5 && values >= kFewestValues ? OccupancyKind::kProbability
                                                               : OccupancyKind::kDecided;
}

std::int8_t decidedCell(double percent, const OccupancyThresholds& thresholds) {
  // Written so that NaN is unknown.
  if (!(percent >= 0.0 && percent <= 100.0)) return kUnknown;
  if (percent > thresholds.occupied_above) return kFullObstacle;
  return percent < thresholds.free_below ? kFree : kUnknown;
}

}  // namespace occusg
