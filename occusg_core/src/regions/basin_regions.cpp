// SPDX-License-Identifier: BSD-3-Clause
#include "regions/basin_regions.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "occusg/regions/label_regions.hpp"
#include "regions/basins.hpp"
#include "regions/clearance.hpp"
#include "regions/passages.hpp"
#include "regions/side_corridors.hpp"
#include "regions/straight_cuts.hpp"

namespace occusg {
namespace {

/// What narrows by less is the unevenness of a wall.
constexpr double kOpenRatio = 0.95;

/// The islands' cells lose their label where one borders on more than one region.
void leaveOutIslands(const Clearance& clearance, IslandFootprint footprint,
                     Grid<std::int32_t>& labels) {
  constexpr std::int32_t kSeveral = -1;
  std::vector<std::int32_t> surrounding(static_cast<std::size_t>(clearance.island_count) + 1,
                                        kNoRegion);
  const CellBox& box = labels.box();
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const std::int32_t island = clearance.islands.at({x, y});
      if (island == 0) continue;
      for (const Cell cell :
           {Cell{x, y}, Cell{x - 1, y}, Cell{x + 1, y}, Cell{x, y - 1}, Cell{x, y + 1}}) {
        std::int32_t& region = surrounding[island];
        const std::int32_t label = labels.at(cell);
        if (region == kNoRegion) region = label;
        if (label != region) region = kSeveral;
      }
    }
  }
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const std::int32_t island = clearance.islands.values()[i];
    if (island == 0) continue;
    const bool is_left_out =
        footprint == IslandFootprint::kLeaveOut || surrounding[island] == kSeveral;
    if (is_left_out) labels.values()[i] = kNoRegion;
  }
}

}  // namespace

std::size_t cellsOf(double area_m2, const GridFrame& frame) {
  return static_cast<std::size_t>(std::ceil(area_m2 / frame.cellArea() - 1e-6));
}

BasinRegions basinRegionsOf(const Grid<std::int8_t>& closed, const GridFrame& frame,
                            const ConstrictionDecomposerConfig& config) {
  Clearance clearance = clearanceOf(closed, cellsOf(config.max_filled_obstacle_m2, frame));
  if (clearance.open.empty()) return {};
  const std::size_t min_cells = cellsOf(config.min_region_area_m2, frame);
  const double widest_passage_cells = config.widest_door_m / frame.resolution_m;
  const NarrowingRules rules{widest_passage_cells, config.shallowest_basin_ratio,
                             config.door_widening, config.door_reach_m / frame.resolution_m};
  Grid<std::int32_t> basins = basinsOf(clearance, {widest_passage_cells, kOpenRatio});
  basins = withoutSmallPieces(joinedAcrossOpenings(clearance, basins, rules), min_cells);
  basins = withoutNiches(clearance, basins,
                         {config.max_opening_ratio, rules.widening, rules.reach_cells});
  basins = withSideCorridorsApart(
      clearance, std::move(basins),
      {config.min_room_width_m / frame.resolution_m, widest_passage_cells, min_cells});
  Grid<std::int32_t> labels = straightened(clearance, basins, passageCuts(clearance, basins));
  leaveOutIslands(clearance, config.island_footprint, labels);
  return {withoutSmallPieces(labels, min_cells), std::move(clearance.squared)};
}

}  // namespace occusg
