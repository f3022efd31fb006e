// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/constriction_decomposer.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "occusg/regions/label_regions.hpp"
#include "regions/basins.hpp"
#include "regions/clearance.hpp"
#include "regions/lintels.hpp"
#include "regions/outside.hpp"
#include "regions/passages.hpp"
#include "regions/straight_cuts.hpp"

namespace occusg {
namespace {

/// What narrows by less is the unevenness of a wall.
constexpr double kOpenRatio = 0.95;
/// [m] Lower than a low door: something that hangs lower is furniture.
constexpr double kLowestLintel_m = 1.7;

/// [m] A border this near to an obstacle is wall: two cells of common maps, and half a cell.
constexpr double kWallReach_m = 0.15;

/// Smallest number of cells that cover at least `area_m2`.
std::size_t cellsOf(double area_m2, const GridFrame& frame) {
  return static_cast<std::size_t>(std::ceil(area_m2 / frame.cellArea() - 1e-6));
}

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

/// `labels` over `box`, which holds every labelled cell.
Grid<std::int32_t> spreadOver(const CellBox& box, const Grid<std::int32_t>& labels) {
  Grid<std::int32_t> result(box, kNoRegion);
  const CellBox common = labels.box().intersected(box);
  for (int y = common.min.y; y < common.max.y; ++y)
    for (int x = common.min.x; x < common.max.x; ++x) result.at({x, y}) = labels.at({x, y});
  return result;
}

/// Labels over the bounds of the free cells; no cells when none is free.
Grid<std::int32_t> labelsOf(const FreeSpace& layer, const ConstrictionDecomposerConfig& config) {
  const GridFrame& frame = layer.frame;
  const Grid<std::int8_t> closed =
      withLintelsClosed(layer, {kLowestLintel_m, config.highest_lintel_m});
  const Clearance clearance = clearanceOf(closed, cellsOf(config.max_filled_obstacle_m2, frame));
  if (clearance.open.empty()) return {};
  const std::size_t min_cells = cellsOf(config.min_region_area_m2, frame);
  const double widest_passage_cells = config.widest_door_m / frame.resolution_m;
  const NarrowingRules rules{widest_passage_cells, config.shallowest_basin_ratio,
                             config.door_widening, config.door_reach_m / frame.resolution_m};
  Grid<std::int32_t> basins = basinsOf(clearance, {widest_passage_cells, kOpenRatio});
  basins = withoutSmallPieces(joinedAcrossOpenings(clearance, basins, rules), min_cells);
  basins = withoutNiches(clearance, basins,
                         {config.max_opening_ratio, rules.widening, rules.reach_cells});
  Grid<std::int32_t> labels = straightened(clearance, basins, passageCuts(clearance, basins));
  leaveOutIslands(clearance, config.island_footprint, labels);
  labels = withoutSmallPieces(labels, min_cells);
  if (config.highest_lintel_m > 0.0) {
    // What is small between its doors may be a room with its share of them.
    openLintels(layer.cells, closed, labels);
    labels = withoutSmallPieces(labels, min_cells);
  }
  removeNarrow(clearance.squared, config.min_room_width_m / frame.resolution_m, labels);
  // A layer that comes from a 3D map has seen the floor of all it calls free.
  if (layer.evidence.empty() && config.min_enclosed_share > 0.0)
    removeOutside(closed, {config.min_enclosed_share, kWallReach_m / frame.resolution_m}, labels);
  return labels;
}

}  // namespace

ConstrictionDecomposer::ConstrictionDecomposer(const ConstrictionDecomposerConfig& config)
    : config_(checked(config)) {}

const Decomposition& ConstrictionDecomposer::update(const FreeSpace& layer,
                                                    const CellBox& /*changed*/) {
  const Grid<std::int32_t> labels = spreadOver(layer.cells.box(), labelsOf(layer, config_));
  decomposition_ = decompositionOf(labels, layer.frame, config_.min_crossing_m);
  return decomposition_;
}

void ConstrictionDecomposer::reset() { decomposition_ = {}; }

}  // namespace occusg
