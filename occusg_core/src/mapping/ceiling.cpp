// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/ceiling.hpp"

#include <cstddef>
#include <map>

namespace occusg {
namespace {

/// What hangs lower is a lintel, a lamp or a cupboard.
constexpr double kLowestCeiling_m = 1.8;

}  // namespace

std::optional<double> ceilingOf(const FreeSpace& layer, double floor_z_m) {
  std::map<int, std::size_t> columns_at;
  const CellBox& box = layer.cells.box();
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const ColumnEvidence& evidence = layer.evidence.at({x, y});
      if (evidence.overhead != Overhead::kOccupied) continue;
      const int height = evidence.floor + evidence.gap_top;
      if (height * layer.frame.resolution_m >= floor_z_m + kLowestCeiling_m) ++columns_at[height];
    }
  }
  std::size_t most = 0;
  std::optional<double> ceiling_z_m;
  for (const auto& [height, columns] : columns_at) {
    if (columns <= most) continue;
    most = columns;
    ceiling_z_m = height * layer.frame.resolution_m;
  }
  return ceiling_z_m;
}

}  // namespace occusg
