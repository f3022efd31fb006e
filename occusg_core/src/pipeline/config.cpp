// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/config.hpp"

#include <limits>

#include "occusg/error.hpp"
#include "occusg/graph/limits.hpp"

namespace occusg {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLongest_m = 1000.0;

using Parameters = std::vector<Parameter>;

void addPerception(Parameters& list, DepthProjectorConfig& depth, PoseGateConfig& poses) {
  list.push_back(countParameter(depth.stride, {1, 64},
                                {"perception.depth.stride", "pixels",
                                 "Only every n-th pixel is used, in both directions.", "2"}));
  list.push_back(numberParameter(
      depth.min_depth_m, {0.0, kLongest_m},
      {"perception.depth.min_depth_m", "m", "Depth pixels nearer than this are dropped.", "0.01"}));
  list.push_back(numberParameter(depth.max_depth_m, {0.0, kLongest_m},
                                 {"perception.depth.max_depth_m", "m",
                                  "Depth pixels farther than this show no surface.", "10"}));
  list.push_back(choiceParameter<BeyondMaxDepth>(
      depth.beyond_max_depth, {{"drop", BeyondMaxDepth::kDrop}, {"clear", BeyondMaxDepth::kClear}},
      {"perception.depth.beyond_max_depth", "",
       "What a pixel beyond the maximum depth means: nothing, or free space up to there.",
       "drop"}));
  list.push_back(numberParameter(
      depth.max_plausible_depth_m, {0.1, 1e5},
      {"perception.depth.max_plausible_depth_m", "m",
       "Depth values above this (and above max_depth_m) cannot be measurements and are ignored."}));
  list.push_back(numberParameter(poses.max_speed_m_s, {0.1, 1e4},
                                 {"perception.poses.max_speed_m_s", "m/s",
                                  "Highest plausible speed of the camera; a frame whose pose would "
                                  "need more (with 1 m of tolerance) is ignored."}));
}

void addDetection(Parameters& list, DetectionBuilderConfig& detection) {
  list.push_back(numberParameter(
      detection.cluster_eps_m, {0.005, 10.0},
      {"perception.objects.cluster_eps_m", "m",
       "Points of one object are clustered when they are at most this far apart.", "0.05"}));
  list.push_back(numberParameter(detection.cluster_gap_pixels, {0.0, 100.0},
                                 {"perception.objects.cluster_gap_pixels", "pixels",
                                  "Points of one object are also clustered when they are at most "
                                  "this many pixels apart at their depth, up to 0.5 m.",
                                  "0"}));
  list.push_back(countParameter(detection.min_cluster_points, {1, 1000000},
                                {"perception.objects.min_points", "pixels",
                                 "Minimum number of depth pixels in the largest cluster of an "
                                 "object; with fewer, the detection is refused.",
                                 "50"}));
  list.push_back(numberParameter(detection.max_depth_m, {0.01, kLongest_m},
                                 {"perception.objects.max_depth_m", "m",
                                  "Pixels of an object farther than this are not used.", "10"}));
  list.push_back(countParameter(
      detection.max_masks, {1, static_cast<int>(kMaxMasks)},
      {"perception.objects.max_masks", "masks",
       "Maximum number of objects used per image; those with the best scores are kept."}));
}

void addSegmenter(Parameters& list, OnnxSegmenterConfig& segmenter) {
  list.push_back(numberParameter(
      segmenter.min_confidence, {0.001, 1.0},
      {"perception.model.min_confidence", "",
       "Minimum score of the segmentation model; objects with a lower score are left out.",
       "0.7"}));
  list.push_back(numberParameter(
      segmenter.max_iou, {0.0, 1.0},
      {"perception.model.max_iou", "",
       "When two boxes of one class overlap by more than this IoU, only the better one is kept.",
       "0.45"}));
  list.push_back(countParameter(segmenter.input_side, {32, 4096},
                                {"perception.model.input_side", "pixels",
                                 "Side of the input image for models that accept any size."}));
}

void addOccupancy(Parameters& list, OccupancyMapConfig& occupancy) {
  list.push_back(numberParameter(
      occupancy.resolution_m, {0.01, 1.0},
      {"mapping.occupancy.resolution_m", "m", "Edge length of a voxel and of a 2D cell.", "0.05"}));
  list.push_back(numberParameter(
      occupancy.max_range_m, {0.1, kLongest_m},
      {"mapping.occupancy.max_range_m", "m",
       "Maximum length of a ray; a longer ray is cut there and hits nothing.", "8"}));
  list.push_back(
      numberParameter(occupancy.hit_probability, {0.5, 0.999},
                      {"mapping.occupancy.hit_probability", "",
                       "Occupancy probability of a voxel that is hit by a ray.", "0.7"}));
  list.push_back(
      numberParameter(occupancy.miss_probability, {0.001, 0.5},
                      {"mapping.occupancy.miss_probability", "",
                       "Occupancy probability of a voxel that is passed by a ray.", "0.4"}));
  list.push_back(
      numberParameter(occupancy.min_probability, {0.001, 0.5},
                      {"mapping.occupancy.min_probability", "",
                       "Lower clamping value of the occupancy probability of a voxel.", "0.12"}));
  list.push_back(
      numberParameter(occupancy.max_probability, {0.5, 0.999},
                      {"mapping.occupancy.max_probability", "",
                       "Upper clamping value of the occupancy probability of a voxel.", "0.97"}));
  list.push_back(choiceParameter<IntegrationMode>(
      occupancy.mode,
      {{"reference", IntegrationMode::kReference},
       {"exact", IntegrationMode::kExact},
       {"fast", IntegrationMode::kFast}},
      {"mapping.occupancy.mode", "",
       "How free voxels are found: ray by ray (reference), the same result from the whole image "
       "(exact), or without some voxels at the rim of the view (fast).",
       "reference"}));
  list.push_back(
      countParameter(occupancy.threads, {1, kMaxThreads},
                     {"mapping.occupancy.threads", "",
                      "Number of threads that work on a frame; the map does not depend on it."}));
  list.push_back(numberParameter(
      occupancy.max_memory_mb, {1.0, 1e6},
      {"mapping.occupancy.max_memory_mb", "MiB",
       "Maximum memory of the map; once it is reached, no more frames are added."}));
}

void addFreeSpace(Parameters& list, FreeSpaceLayerConfig& layer) {
  list.push_back(numberParameter(
      layer.min_free_gap_m, {0.01, 10.0},
      {"mapping.free_space.min_free_gap_m", "m",
       "A cell is free when at least this much vertical space above it is free.", "0.3"}));
  list.push_back(countParameter(
      layer.min_obstacle_level, {0, 100},
      {"mapping.free_space.min_obstacle_level", "%",
       "A cell is an obstacle when it is filled to at least this degree; below, it is unknown.",
       "5"}));
  list.push_back(numberParameter(
      layer.lowest_z_m, {-kInfinity, kInfinity},
      {"mapping.free_space.lowest_z_m", "m", "Voxels below this height are ignored.", "-.inf"}));
  list.push_back(numberParameter(
      layer.highest_z_m, {-kInfinity, kInfinity},
      {"mapping.free_space.highest_z_m", "m", "Voxels above this height are ignored.", ".inf"}));
  list.push_back(choiceParameter<HeightReference>(
      layer.height_reference,
      {{"map", HeightReference::kMap}, {"local_floor", HeightReference::kLocalFloor}},
      {"mapping.free_space.height_reference", "",
       "What lowest_z_m and highest_z_m are measured from: z = 0 of the map, or the floor near the "
       "column.",
       "map"}));

  ColumnEvidenceConfig& evidence = layer.evidence;
  list.push_back(numberParameter(evidence.ceiling_height_m, {0.1, 100.0},
                                 {"mapping.evidence.ceiling_height_m", "m",
                                  "Evidence about a column (lintels, furniture) is collected up to "
                                  "this height above the floor.",
                                  ""}));
  list.push_back(numberParameter(evidence.body_bottom_m, {0.0, 100.0},
                                 {"mapping.evidence.body_bottom_m", "m",
                                  "Lower end of the height band in which an obstacle counts as one "
                                  "for a robot's body, above the floor.",
                                  ""}));
  list.push_back(numberParameter(evidence.body_top_m, {0.01, 100.0},
                                 {"mapping.evidence.body_top_m", "m",
                                  "Upper end of the height band in which an obstacle counts as one "
                                  "for a robot's body, above the floor.",
                                  ""}));
}

void addDecomposition(Parameters& list, PipelineConfig& config) {
  list.push_back(numberParameter(
      config.region_period_s, {0.0, 3600.0},
      {"regions.period_s", "s",
       "Minimum time between two updates of the regions, in the time of the images.", "0.5"}));
  list.push_back(choiceParameter<DecomposerKind>(
      config.decomposer,
      {{"dude", DecomposerKind::kDude}, {"constriction", DecomposerKind::kConstriction}},
      {"regions.decomposer", "", "Algorithm that divides free space into regions.", "dude"}));
}

void addConstriction(Parameters& list, ConstrictionDecomposerConfig& constriction) {
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
}

void addDude(Parameters& list, DudeDecomposerConfig& dude) {
  list.push_back(numberParameter(
      dude.depth_threshold_m, {0.05, 1000.0},
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
}

void addTracking(Parameters& list, RegionTrackerConfig& tracker) {
  AcceptanceGuardConfig& guard = tracker.guard;
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
}

void addAgents(Parameters& list, GraphBuilderConfig& graph) {
  list.push_back(numberParameter(
      graph.maintenance_period_s, {0.01, 3600.0},
      {"graph.maintenance_period_s", "s", "Period of the maintenance of the rooms.", "2"}));
  list.push_back(numberParameter(
      graph.agents.min_distance_m, {0.0, kLongest_m},
      {"graph.agents.min_distance_m", "m",
       "A pose becomes an agent node when it is this far from the last one.", "0.5"}));
  list.push_back(numberParameter(
      graph.agents.max_interval_s, {0.0, 86400.0},
      {"graph.agents.max_interval_s", "s",
       "A pose becomes an agent node when it is this much later than the last one.", "10"}));
  list.push_back(numberParameter(
      graph.agents.recent_s, {1.0, 1e9},
      {"graph.agents.recent_s", "s",
       "Agent nodes older than this are thinned: only the last one at each place is kept."}));
  list.push_back(numberParameter(
      graph.agents.old_spacing_m, {0.01, kLongest_m},
      {"graph.agents.old_spacing_m", "m",
       "Side of the cubes that count as one place when old agent nodes are thinned."}));
  list.push_back(
      countParameter(graph.agents.max_agents, {2, static_cast<int>(kMaxGraphNodes / 2)},
                     {"graph.agents.max_agents", "agents",
                      "Maximum number of agent nodes; beyond it the oldest are removed."}));
}

void addRooms(Parameters& list, RoomLayerConfig& rooms) {
  list.push_back(numberParameter(rooms.boundary_tolerance_m, {0.0, 10.0},
                                 {"graph.rooms.boundary_tolerance_m", "m",
                                  "Objects, agents and navigation nodes belong to a room when they "
                                  "are inside it or at most this far from it.",
                                  "0.5"}));
  list.push_back(numberParameter(
      rooms.floor_z_m, {-kLongest_m, kLongest_m},
      {"graph.rooms.floor_z_m", "m", "Height of room nodes in the map frame.", ""}));
  list.push_back(numberParameter(rooms.relink_min_overlap, {0.0, 1.0},
                                 {"graph.rooms.relink_min_overlap", "",
                                  "When a region is lost, another takes over its room only if it "
                                  "covers at least this share of the room.",
                                  "0.65"}));
  list.push_back(numberParameter(rooms.relink_min_members, {0.0, 1.0},
                                 {"graph.rooms.relink_min_members", "",
                                  "When a region is lost, another takes over its room only if it "
                                  "holds at least this share of the room's members.",
                                  "0.5"}));
  list.push_back(numberParameter(
      rooms.relink_min_members_off_centre, {0.0, 1.0},
      {"graph.rooms.relink_min_members_off_centre", "",
       "Like relink_min_members, for a region that does not contain the centroid of the room.",
       "0.75"}));
  list.push_back(numberParameter(rooms.relink_min_margin, {0.0, 1.0},
                                 {"graph.rooms.relink_min_margin", "",
                                  "When a region is lost, another takes over its room only if its "
                                  "score leads that of the second best by this much.",
                                  "0.15"}));
  list.push_back(
      choiceParameter<PromotionEvidence>(rooms.promotion,
                                         {{"any_entity", PromotionEvidence::kAnyEntity},
                                          {"observed_area", PromotionEvidence::kObservedArea}},
                                         {"graph.rooms.promotion", "",
                                          "What turns a region that no agent has entered into a "
                                          "room: any entity in it, or its observed area.",
                                          "any_entity"}));
  list.push_back(numberParameter(
      rooms.min_promoted_area_m2, {0.0, 1e6},
      {"graph.rooms.min_promoted_area_m2", "m2",
       "With promotion observed_area: smallest area of a region that becomes a room.", ""}));
  list.push_back(numberParameter(rooms.min_promoted_age_s, {0.0, 86400.0},
                                 {"graph.rooms.min_promoted_age_s", "s",
                                  "With promotion observed_area: a region becomes a room after it "
                                  "has been known for this long.",
                                  ""}));
  list.push_back(numberParameter(rooms.max_frontier_share, {0.0, 1.0},
                                 {"graph.rooms.max_frontier_share", "",
                                  "A room is confirmed once at most this share of its boundary is "
                                  "frontier; until then it is partial.",
                                  "1"}));
  list.push_back(numberParameter(rooms.removal_grace_s, {0.0, 86400.0},
                                 {"graph.rooms.removal_grace_s", "s",
                                  "Time for which a room is kept after its region was last seen "
                                  "(and at least while the tracker remembers the region).",
                                  "0"}));
}

void addNavigation(Parameters& list, NavigationLayerConfig& navigation) {
  list.push_back(countParameter(navigation.block_cells, {2, 64},
                                {"graph.navigation.block_cells", "cells",
                                 "Side of the blocks that the navigation nodes stand for.", "15"}));
  list.push_back(countParameter(
      navigation.min_free_cells, {1, 4096},
      {"graph.navigation.min_free_cells", "cells",
       "A navigation node is created when it stands for at least this many free cells.", "25"}));
  list.push_back(countParameter(
      navigation.min_kept_cells, {0, 4096},
      {"graph.navigation.min_kept_cells", "cells",
       "A navigation node is removed when it stands for fewer free cells than this; 0: never.",
       "0"}));
  list.push_back(
      choiceParameter<NavigationNodes>(navigation.nodes,
                                       {{"one_per_block", NavigationNodes::kOnePerBlock},
                                        {"one_per_part", NavigationNodes::kOnePerPart}},
                                       {"graph.navigation.nodes", "",
                                        "Whether there is one navigation node in the middle of a "
                                        "block, or one on each connected part of its free space.",
                                        "one_per_block"}));
}

void addObjects(Parameters& list, ObjectLayerConfig& objects) {
  list.push_back(choiceParameter<ObjectMemory>(
      objects.memory,
      {{"first_sight", ObjectMemory::kFirstSight}, {"running", ObjectMemory::kRunning}},
      {"graph.objects.memory", "",
       "Whether an object stays as it was first seen, or is updated by all its detections.",
       "first_sight"}));
  list.push_back(numberParameter(
      objects.merge_distance_m, {0.0, 100.0},
      {"graph.objects.merge_distance_m", "m",
       "With memory first_sight: objects of one class nearer than this are one object.", "0.75"}));
  list.push_back(numberParameter(
      objects.flicker_distance_m, {0.0, 100.0},
      {"graph.objects.flicker_distance_m", "m",
       "With memory first_sight: objects of any class nearer than this are one object.", "0.15"}));
  list.push_back(numberParameter(objects.min_common_box, {0.0, 1.0},
                                 {"graph.objects.min_common_box", "",
                                  "With memory running: objects of one class are one object when "
                                  "their boxes share this part of the smaller box.",
                                  ""}));
  list.push_back(choiceParameter<GhostRemoval>(
      objects.ghosts,
      {{"never", GhostRemoval::kNever}, {"seen_through", GhostRemoval::kSeenThrough}},
      {"graph.objects.ghosts", "",
       "When objects that have disappeared are removed: never, or when they are seen through.",
       "never"}));
  list.push_back(countParameter(
      objects.ghost_checks, {1, 1000},
      {"graph.objects.ghost_checks", "looks",
       "Number of looks in a row that must find the space of an object free before it is removed.",
       ""}));
  list.push_back(numberParameter(objects.max_link_distance_m, {0.0, 100.0},
                                 {"graph.objects.max_link_distance_m", "m",
                                  "Maximum distance from an object to its navigation node.", "1"}));
}

}  // namespace

std::vector<Parameter> parametersOf(PipelineConfig& config) {
  Parameters list;
  addPerception(list, config.depth, config.poses);
  addDetection(list, config.detection);
  addSegmenter(list, config.segmenter);
  addOccupancy(list, config.occupancy);
  addFreeSpace(list, config.free_space);
  addDecomposition(list, config);
  addDude(list, config.dude);
  addConstriction(list, config.constriction);
  addTracking(list, config.tracker);
  addAgents(list, config.graph);
  addRooms(list, config.graph.rooms);
  addNavigation(list, config.graph.navigation);
  addObjects(list, config.graph.objects);
  return list;
}

double smallestRegion_m2(const PipelineConfig& config) {
  return config.decomposer == DecomposerKind::kDude ? config.dude.min_region_area_m2
                                                    : config.constriction.min_region_area_m2;
}

std::unique_ptr<Decomposer> makeDecomposer(const PipelineConfig& config) {
  switch (config.decomposer) {
    case DecomposerKind::kDude:
      return std::make_unique<DudeDecomposer>(config.dude);
    case DecomposerKind::kConstriction:
      return std::make_unique<ConstrictionDecomposer>(config.constriction);
  }
  throw refuse("regions.decomposer", "unknown kind", "see 'occusg config --print'");
}

PipelineConfig paperConfig() {
  PipelineConfig config;
  for (const Parameter& parameter : parametersOf(config)) {
    if (parameter.paper.empty()) continue;
    if (!parameter.assign(parameter.paper)) {
      throw refuse(parameter.key, "the paper's value is '" + parameter.paper + "'",
                   "allowed is " + parameter.allowed);
    }
  }
  return config;
}

void check(const PipelineConfig& config) {
  const auto ordered = [](const std::string& low_key, double low, const std::string& high_key,
                          double high) {
    if (low < high) return;
    throw refuse(low_key, "it is " + shortestText(low),
                 "it must be below " + high_key + " = " + shortestText(high));
  };
  ordered("perception.depth.min_depth_m", config.depth.min_depth_m, "perception.depth.max_depth_m",
          config.depth.max_depth_m);
  ordered("mapping.free_space.lowest_z_m", config.free_space.lowest_z_m,
          "mapping.free_space.highest_z_m", config.free_space.highest_z_m);
  ordered("mapping.evidence.body_bottom_m", config.free_space.evidence.body_bottom_m,
          "mapping.evidence.body_top_m", config.free_space.evidence.body_top_m);
}

}  // namespace occusg
