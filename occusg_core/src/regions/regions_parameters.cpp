// SPDX-License-Identifier: BSD-3-Clause
// The parameters of this module: names, units, ranges, what they mean, and the paper's values.
#include <limits>

#include "occusg/regions/constriction_decomposer.hpp"
#include "occusg/regions/dude_decomposer.hpp"
#include "occusg/regions/region_tracker.hpp"
#include "regions/acceptance_guard.hpp"

namespace occusg {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<Parameter> parametersOf(DudeDecomposerConfig& dude) {
  std::vector<Parameter> list;
  list.push_back(numberParameter(
      dude.depth_threshold_m, {0.0, 1000.0},
      {"regions.dude.depth_threshold_m", "m",
       "d_thr: a cut is made where an obstacle reaches at least this deep into free space.",
       "1.5"}));
  list.push_back(numberParameter(
      dude.max_width_ratio, {0.01, 100.0},
      {"regions.dude.max_width_ratio", "",
       "Half a cut's length must be below this share of its smaller side's largest free circle."}));
  list.push_back(numberParameter(
      dude.longest_cut_m, {0.05, 1000.0},
      {"regions.dude.longest_cut_m", "m", "Openings wider than this are never cut."}));
  list.push_back(numberParameter(
      dude.min_region_area_m2, {0.0, 1e6},
      {"regions.dude.min_region_area_m2", "m2",
       "Regions smaller than this are merged with a neighbour, or dropped when they have none."}));
  list.push_back(
      numberParameter(dude.max_ignored_hole_m, {0.0, 1000.0},
                      {"regions.dude.max_ignored_hole_m", "m",
                       "Free-standing obstacles up to this width count as furniture.", "1.5"}));
  list.push_back(
      numberParameter(dude.keep_bonus, {0.0, 10.0},
                      {"regions.dude.keep_bonus", "",
                       "Share by which an existing cut is preferred to a new one.", "0"}));
  list.push_back(choiceParameter<GridCleaning>(
      dude.cleaning, {{"none", GridCleaning::kNone}, {"published", GridCleaning::kPublished}},
      {"regions.dude.cleaning", "",
       "Whether the grid is filtered first, as the published driver does; this moves walls.",
       "published"}));
  list.push_back(choiceParameter<ComponentChoice>(
      dude.components, {{"all", ComponentChoice::kAll}, {"largest", ComponentChoice::kLargest}},
      {"regions.dude.components", "",
       "Whether all connected parts of free space become regions, or only the largest.",
       "largest"}));
  return list;
}

std::vector<Parameter> parametersOf(ConstrictionDecomposerConfig& constriction) {
  std::vector<Parameter> list;
  list.push_back(numberParameter(constriction.widest_door_m, {0.1, 100.0},
                                 {"regions.constriction.widest_door_m", "m",
                                  "Passages wider than this never separate two regions."}));
  list.push_back(numberParameter(constriction.shallowest_basin_ratio, {0.01, 1.0},
                                 {"regions.constriction.shallowest_basin_ratio", "",
                                  "A passage separates two regions only when it is narrower than "
                                  "this share of the largest free circle on its smaller side."}));
  list.push_back(
      numberParameter(constriction.door_widening, {1.0, 100.0},
                      {"regions.constriction.door_widening", "",
                       "A passage too wide for shallowest_basin_ratio still separates two regions "
                       "when free space widens by this factor on both sides."}));
  list.push_back(numberParameter(
      constriction.max_opening_ratio, {0.1, 100.0},
      {"regions.constriction.max_opening_ratio", "",
       "A region is part of its neighbour when the passage between them is wider than this times "
       "the side of a square of the region's area (unless both sides widen by door_widening)."}));
  list.push_back(
      numberParameter(constriction.min_room_width_m, {0.0, 100.0},
                      {"regions.constriction.min_room_width_m", "m",
                       "A region in which no free circle of this diameter fits is dropped."}));
  list.push_back(numberParameter(
      constriction.min_enclosed_share, {0.0, 1.0},
      {"regions.constriction.min_enclosed_share", "",
       "In 2D maps, a region is outside the building and dropped when the share of wall in its "
       "border is below this times the usual share in the map; 0: never."}));
  list.push_back(numberParameter(
      constriction.door_reach_m, {0.0, 100.0},
      {"regions.constriction.door_reach_m", "m",
       "Distance from a passage within which free space must widen by door_widening."}));
  list.push_back(
      numberParameter(constriction.highest_lintel_m, {0.0, 10.0},
                      {"regions.constriction.highest_lintel_m", "m",
                       "Highest lintel: something overhead, from 1.7 m up to this height above the "
                       "floor, separates two regions; 0: lintels are ignored."}));
  list.push_back(numberParameter(
      constriction.min_region_area_m2, {0.0, 1e6},
      {"regions.constriction.min_region_area_m2", "m2",
       "Regions smaller than this are merged with a neighbour, or dropped when they have none."}));
  list.push_back(numberParameter(
      constriction.min_crossing_m, {0.0, 100.0},
      {"regions.constriction.min_crossing_m", "m",
       "Two regions are adjacent when their common boundary is at least this long."}));
  list.push_back(
      numberParameter(constriction.max_filled_obstacle_m2, {0.0, 1e6},
                      {"regions.constriction.max_filled_obstacle_m2", "m2",
                       "Free-standing obstacles up to this area do not divide regions."}));
  list.push_back(choiceParameter<IslandFootprint>(
      constriction.island_footprint,
      {{"fill", IslandFootprint::kFillInsideOneRegion}, {"leave_out", IslandFootprint::kLeaveOut}},
      {"regions.constriction.island_footprint", "",
       "Whether the floor under free-standing obstacles that do not divide regions belongs to the "
       "region around them."}));
  return list;
}

std::vector<Parameter> parametersOf(AcceptanceGuardConfig& guard) {
  std::vector<Parameter> list;
  list.push_back(numberParameter(
      guard.max_area_drop, {0.0, 1.0},
      {"regions.guard.max_area_drop", "",
       "An update of the regions is rejected when the total area drops by more than this share.",
       "0.15"}));
  list.push_back(numberParameter(
      guard.max_count_drop, {0.0, 1.0},
      {"regions.guard.max_count_drop", "",
       "An update of the regions is rejected when their number drops by more than this share.",
       "0.15"}));
  list.push_back(choiceParameter<bool>(
      guard.reject_on_count_alone, {{"true", true}, {"false", false}},
      {"regions.guard.reject_on_count_alone", "",
       "Whether a drop in the number of regions alone can reject an update.", "true"}));
  list.push_back(countParameter(
      guard.max_rejections_in_a_row, {0, 1000000},
      {"regions.guard.max_rejections_in_a_row", "updates",
       "Number of rejected updates in a row after which the new state is accepted; 0: never.",
       "0"}));
  return list;
}

std::vector<Parameter> parametersOf(RegionTrackerConfig& tracker) {
  std::vector<Parameter> list = parametersOf(tracker.guard);
  list.push_back(numberParameter(
      tracker.min_overlap, {0.0, 1.0},
      {"regions.tracker.min_overlap", "",
       "A region continues a track only when their polygon IoU exceeds this.", "0.2"}));
  list.push_back(numberParameter(tracker.max_centroid_distance_m, {0.0, kInfinity},
                                 {"regions.tracker.max_centroid_distance_m", "m",
                                  "A region continues a track only when their centroids are nearer "
                                  "than this (parts of a cut corridor are farther apart).",
                                  "1.5"}));
  list.push_back(numberParameter(
      tracker.min_area_ratio, {0.0, 1.0},
      {"regions.tracker.min_area_ratio", "",
       "A region continues a track only when its area is at least this multiple of the old one.",
       "0.25"}));
  list.push_back(numberParameter(
      tracker.max_area_ratio, {1.0, 1000.0},
      {"regions.tracker.max_area_ratio", "",
       "A region continues a track only when its area is at most this multiple of the old one.",
       "4"}));
  list.push_back(countParameter(
      tracker.max_missed_updates, {0, 1000000},
      {"regions.tracker.max_missed_updates", "updates",
       "Number of updates without a matching region after which a track ends.", "3"}));
  return list;
}

}  // namespace occusg
