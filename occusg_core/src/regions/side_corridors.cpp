// SPDX-License-Identifier: BSD-3-Clause
#include "regions/side_corridors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "occusg/regions/label_regions.hpp"
#include "occusg/regions/region.hpp"
#include "regions/basins.hpp"
#include "regions/cell_walks.hpp"
#include "regions/squared_distance.hpp"

namespace occusg {
namespace {

/// What is shorter, in widths, is a niche or the end of a room that tapers.
constexpr double kLeastLength = 4.0;

/// The longest mouth, in widths. The slivers along the hall's walls that no wide disc covers belong
/// to the corridor's cells, so its mouth is longer than the corridor is wide.
constexpr double kLongestMouth = 3.0;

/// By region: half the greatest width of an arm [cells], which is half the depth of the hall.
std::vector<double> armHalfWidths(const Grid<std::int32_t>& regions,
                                  const Grid<std::int32_t>& squared, double widest_cells) {
  const auto most = std::max_element(regions.values().begin(), regions.values().end());
  std::vector<std::int32_t> deepest(static_cast<std::size_t>(*most) + 1, 0);
  for (std::size_t i = 0; i < regions.values().size(); ++i) {
    std::int32_t& depth = deepest[static_cast<std::size_t>(regions.values()[i])];
    depth = std::max(depth, squared.values()[i]);
  }
  std::vector<double> half_widths(deepest.size(), 0.0);
  for (std::size_t region = 1; region < half_widths.size(); ++region)
    half_widths[region] = 0.5 * std::min(widest_cells, halfWidth(deepest[region]));
  return half_widths;
}

/// The cells of each region that no disc wider than its arms covers, numbered by connected piece.
Grid<std::int32_t> armsOf(const Grid<std::int32_t>& regions, const Grid<std::int32_t>& squared,
                          const std::vector<double>& half_widths) {
  const double widest = *std::max_element(half_widths.begin(), half_widths.end());
  // The edge of the grid would count as core.
  const int margin = static_cast<int>(std::ceil(widest)) + 1;
  Grid<std::uint8_t> beyond_core(regions.box().grown(margin), 1);
  forEachCell(regions.box(), [&](const Cell& cell) {
    const auto region = static_cast<std::size_t>(regions.at(cell));
    if (region != kNoRegion && halfWidth(squared.at(cell)) > half_widths[region])
      beyond_core.at(cell) = 0;
  });
  const Grid<std::int32_t> to_core = squaredDistances(beyond_core);
  Grid<std::int32_t> arms(regions.box(), kNoRegion);
  forEachCell(regions.box(), [&](const Cell& cell) {
    const auto region = static_cast<std::size_t>(regions.at(cell));
    if (region == kNoRegion) return;
    const double reach = half_widths[region] + 0.5;
    if (static_cast<double>(to_core.at(cell)) > reach * reach) arms.at(cell) = regions.at(cell);
  });
  return numberedPieces(arms);
}

/// A connected set of cells too narrow for the hall they belong to.
struct Arm {
  std::size_t cells = 0;
  std::size_t mouth = 0;  ///< Cell edges to the rest of the region.
  std::int32_t squared_depth = 0;
};

std::vector<Arm> measured(const Grid<std::int32_t>& arms, const Grid<std::int32_t>& regions,
                          const Grid<std::int32_t>& squared) {
  const auto most = std::max_element(arms.values().begin(), arms.values().end());
  std::vector<Arm> measures(static_cast<std::size_t>(*most) + 1);
  forEachCell(arms.box(), [&](const Cell& cell) {
    if (arms.at(cell) == kNoRegion) return;
    Arm& arm = measures[static_cast<std::size_t>(arms.at(cell))];
    ++arm.cells;
    arm.squared_depth = std::max(arm.squared_depth, squared.at(cell));
    for (const Cell& side : sideNeighbours(cell)) {
      const bool is_mouth = regions.valueOr(side, kNoRegion) == regions.at(cell) &&
                            arms.valueOr(side, kNoRegion) == kNoRegion;
      arm.mouth += is_mouth ? 1U : 0U;
    }
  });
  return measures;
}

bool isCorridor(const Arm& arm, const SideCorridorRules& rules) {
  const double width = 2.0 * halfWidth(arm.squared_depth);
  return arm.cells >= rules.min_cells && arm.mouth > 0 && width >= rules.narrowest_cells &&
         static_cast<double>(arm.cells) >= kLeastLength * width * width &&
         static_cast<double>(arm.mouth) <= kLongestMouth * width;
}

}  // namespace

Grid<std::int32_t> withSideCorridorsApart(const Clearance& clearance, Grid<std::int32_t> regions,
                                          const SideCorridorRules& rules) {
  if (regions.values().empty()) return regions;
  const std::vector<double> half_widths =
      armHalfWidths(regions, clearance.squared, rules.widest_cells);
  const Grid<std::int32_t> arms = armsOf(regions, clearance.squared, half_widths);
  const std::vector<Arm> measures = measured(arms, regions, clearance.squared);
  const auto first_new = static_cast<std::int32_t>(half_widths.size());
  for (std::size_t i = 0; i < regions.values().size(); ++i) {
    const std::int32_t arm = arms.values()[i];
    if (arm != kNoRegion && isCorridor(measures[static_cast<std::size_t>(arm)], rules))
      regions.values()[i] = first_new + arm;
  }
  return numberedPieces(regions);
}

}  // namespace occusg
