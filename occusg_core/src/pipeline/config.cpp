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
  list.push_back(countParameter(
      depth.stride, {1, 64},
      {"perception.depth.stride", "pixels", "Every n-th pixel in both directions is used.", "2"}));
  list.push_back(
      numberParameter(depth.min_depth_m, {0.0, kLongest_m},
                      {"perception.depth.min_depth_m", "m", "Nearer pixels are dropped.", "0.01"}));
  list.push_back(numberParameter(
      depth.max_depth_m, {0.0, kLongest_m},
      {"perception.depth.max_depth_m", "m", "Farther pixels carry no surface.", "10"}));
  list.push_back(choiceParameter<BeyondMaxDepth>(
      depth.beyond_max_depth, {{"drop", BeyondMaxDepth::kDrop}, {"clear", BeyondMaxDepth::kClear}},
      {"perception.depth.beyond_max_depth", "",
       "What a pixel beyond the maximum depth means: nothing, or free space up to there.",
       "drop"}));
  list.push_back(numberParameter(
      depth.max_plausible_depth_m, {0.1, 1e5},
      {"perception.depth.max_plausible_depth_m", "m",
       "A pixel beyond this and beyond the maximum depth is no measurement and means nothing."}));
  list.push_back(numberParameter(
      poses.max_speed_m_s, {0.1, 1e4},
      {"perception.poses.max_speed_m_s", "m/s",
       "A frame whose pose could only be reached faster, give or take a metre, is left out."}));
}

void addDetection(Parameters& list, DetectionBuilderConfig& detection) {
  list.push_back(
      numberParameter(detection.cluster_eps_m, {0.005, 10.0},
                      {"perception.objects.cluster_eps_m", "m",
                       "Points of an object nearer than this belong together.", "0.05"}));
  list.push_back(numberParameter(
      detection.cluster_gap_pixels, {0.0, 100.0},
      {"perception.objects.cluster_gap_pixels", "pixels",
       "So do those nearer than this many pixels at their depth, up to 0.5 m.", "0"}));
  list.push_back(countParameter(
      detection.min_cluster_points, {1, 1000000},
      {"perception.objects.min_points", "pixels",
       "An object seen with fewer depth pixels near each other is not taken.", "50"}));
  list.push_back(numberParameter(
      detection.max_depth_m, {0.01, kLongest_m},
      {"perception.objects.max_depth_m", "m", "Farther pixels of an object are not used.", "10"}));
  list.push_back(
      countParameter(detection.max_masks, {1, static_cast<int>(kMaxMasks)},
                     {"perception.objects.max_masks", "masks",
                      "Of more objects in one image those of the best score are taken."}));
}

void addSegmenter(Parameters& list, OnnxSegmenterConfig& segmenter) {
  list.push_back(
      numberParameter(segmenter.min_confidence, {0.001, 1.0},
                      {"perception.model.min_confidence", "",
                       "Objects the segmentation model gives a lower score are left out.", "0.7"}));
  list.push_back(numberParameter(
      segmenter.max_iou, {0.0, 1.0},
      {"perception.model.max_iou", "",
       "Of two boxes of a class that overlap by more (IoU) the better stays.", "0.45"}));
  list.push_back(countParameter(segmenter.input_side, {32, 4096},
                                {"perception.model.input_side", "pixels",
                                 "Side of the image given to a model that takes any size."}));
}

void addMapping(Parameters& list, OccupancyMapConfig& occupancy, FreeSpaceLayerConfig& layer) {
  list.push_back(numberParameter(
      occupancy.resolution_m, {0.01, 1.0},
      {"mapping.occupancy.resolution_m", "m", "Edge of a voxel and of a 2D cell.", "0.05"}));
  list.push_back(numberParameter(
      occupancy.max_range_m, {0.1, kLongest_m},
      {"mapping.occupancy.max_range_m", "m", "Rays are cut here; a cut ray hits nothing.", "8"}));
  list.push_back(numberParameter(
      occupancy.hit_probability, {0.5, 0.999},
      {"mapping.occupancy.hit_probability", "", "Occupancy probability a hit stands for.", "0.7"}));
  list.push_back(numberParameter(occupancy.miss_probability, {0.001, 0.5},
                                 {"mapping.occupancy.miss_probability", "",
                                  "Occupancy probability a miss stands for.", "0.4"}));
  list.push_back(numberParameter(
      occupancy.min_probability, {0.001, 0.5},
      {"mapping.occupancy.min_probability", "", "A voxel is never held freer than this.", "0.12"}));
  list.push_back(numberParameter(occupancy.max_probability, {0.5, 0.999},
                                 {"mapping.occupancy.max_probability", "",
                                  "A voxel is never held more occupied than this.", "0.97"}));
  list.push_back(choiceParameter<IntegrationMode>(
      occupancy.mode,
      {{"reference", IntegrationMode::kReference},
       {"exact", IntegrationMode::kExact},
       {"fast", IntegrationMode::kFast}},
      {"mapping.occupancy.mode", "",
       "How free voxels are found: ray by ray, the same from the whole image, or without some at "
       "its rim.",
       "reference"}));
  list.push_back(countParameter(occupancy.threads, {1, kMaxThreads},
                                {"mapping.occupancy.threads", "",
                                 "Threads that share a frame; the map does not depend on it."}));
  list.push_back(numberParameter(
      occupancy.max_memory_mb, {1.0, 1e6},
      {"mapping.occupancy.max_memory_mb", "MiB", "A map this large takes no more frames."}));

  list.push_back(numberParameter(layer.min_free_gap_m, {0.01, 10.0},
                                 {"mapping.free_space.min_free_gap_m", "m",
                                  "Shortest free vertical run that makes a cell free.", "0.3"}));
  list.push_back(
      countParameter(layer.min_obstacle_level, {0, 100},
                     {"mapping.free_space.min_obstacle_level", "%",
                      "Cells filled to a lower degree are unknown, not obstacle.", "5"}));
  list.push_back(numberParameter(
      layer.lowest_z_m, {-kInfinity, kInfinity},
      {"mapping.free_space.lowest_z_m", "m", "What lies lower does not count.", "-.inf"}));
  list.push_back(numberParameter(
      layer.highest_z_m, {-kInfinity, kInfinity},
      {"mapping.free_space.highest_z_m", "m", "What lies higher does not count.", ".inf"}));
  list.push_back(choiceParameter<HeightReference>(
      layer.height_reference,
      {{"map", HeightReference::kMap}, {"local_floor", HeightReference::kLocalFloor}},
      {"mapping.free_space.height_reference", "",
       "What both heights are measured from: zero of the map or the floor near the column.",
       "map"}));

  ColumnEvidenceConfig& evidence = layer.evidence;
  list.push_back(
      numberParameter(evidence.ceiling_height_m, {0.1, 100.0},
                      {"mapping.evidence.ceiling_height_m", "m",
                       "Evidence on a column is taken up to this height above the floor.", ""}));
  list.push_back(numberParameter(
      evidence.body_bottom_m, {0.0, 100.0},
      {"mapping.evidence.body_bottom_m", "m", "Lower end of the body band, above the floor.", ""}));
  list.push_back(numberParameter(
      evidence.body_top_m, {0.01, 100.0},
      {"mapping.evidence.body_top_m", "m", "Upper end of the body band, above the floor.", ""}));
}

void addDecomposition(Parameters& list, PipelineConfig& config) {
  list.push_back(
      numberParameter(config.region_period_s, {0.0, 3600.0},
                      {"regions.period_s", "s",
                       "Regions are updated when so much logical time has passed.", "0.5"}));
  list.push_back(choiceParameter<DecomposerKind>(
      config.decomposer,
      {{"dude", DecomposerKind::kDude}, {"constriction", DecomposerKind::kConstriction}},
      {"regions.decomposer", "", "How free space is cut into regions.", "dude"}));
}

void addConstriction(Parameters& list, ConstrictionDecomposerConfig& constriction) {
  list.push_back(numberParameter(
      constriction.widest_door_m, {0.1, 100.0},
      {"regions.constriction.widest_door_m", "m", "A wider passage never separates two regions."}));
  list.push_back(numberParameter(
      constriction.shallowest_basin_ratio, {0.01, 1.0},
      {"regions.constriction.shallowest_basin_ratio", "",
       "Nor does one wider than this share of the smaller side's largest free circle."}));
  list.push_back(numberParameter(
      constriction.door_widening, {1.0, 100.0},
      {"regions.constriction.door_widening", "",
       "Such a wide passage separates all the same when both sides widen by this factor."}));
  list.push_back(numberParameter(
      constriction.door_reach_m, {0.0, 100.0},
      {"regions.constriction.door_reach_m", "m", "Within this distance of the passage."}));
  list.push_back(numberParameter(constriction.highest_lintel_m, {0.0, 10.0},
                                 {"regions.constriction.highest_lintel_m", "m",
                                  "Something overhead from 1.7 m up to here above the floor "
                                  "separates two regions; 0: never."}));
  list.push_back(numberParameter(constriction.min_region_area_m2, {0.0, 1e6},
                                 {"regions.constriction.min_region_area_m2", "m2",
                                  "Smaller regions join a neighbour or are dropped."}));
  list.push_back(numberParameter(constriction.min_crossing_m, {0.0, 100.0},
                                 {"regions.constriction.min_crossing_m", "m",
                                  "Regions that touch along less are not adjacent."}));
  list.push_back(numberParameter(constriction.max_filled_obstacle_m2, {0.0, 1e6},
                                 {"regions.constriction.max_filled_obstacle_m2", "m2",
                                  "Obstacle islands up to this area do not shape regions."}));
  list.push_back(choiceParameter<IslandFootprint>(
      constriction.island_footprint,
      {{"fill", IslandFootprint::kFillInsideOneRegion}, {"leave_out", IslandFootprint::kLeaveOut}},
      {"regions.constriction.island_footprint", "",
       "Whether the floor under such an island belongs to the region around it."}));
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
  list.push_back(
      numberParameter(dude.longest_cut_m, {0.05, 1000.0},
                      {"regions.dude.longest_cut_m", "m", "Wider openings are never cut."}));
  list.push_back(numberParameter(dude.min_region_area_m2, {0.0, 1e6},
                                 {"regions.dude.min_region_area_m2", "m2",
                                  "Smaller regions join a neighbour or are dropped."}));
  list.push_back(
      numberParameter(dude.max_ignored_hole_m, {0.0, 1000.0},
                      {"regions.dude.max_ignored_hole_m", "m",
                       "Free-standing obstacles no wider than this are furniture.", "1.5"}));
  list.push_back(numberParameter(dude.keep_bonus, {0.0, 10.0},
                                 {"regions.dude.keep_bonus", "",
                                  "Share by which a cut that stands already is preferred.", "0"}));
  list.push_back(choiceParameter<GridCleaning>(
      dude.cleaning, {{"none", GridCleaning::kNone}, {"published", GridCleaning::kPublished}},
      {"regions.dude.cleaning", "",
       "Whether the grid is filtered first as the published driver does, which moves walls.",
       "published"}));
  list.push_back(choiceParameter<ComponentChoice>(
      dude.components, {{"all", ComponentChoice::kAll}, {"largest", ComponentChoice::kLargest}},
      {"regions.dude.components", "", "Which connected parts of free space become regions.",
       "largest"}));
}

void addTracking(Parameters& list, RegionTrackerConfig& tracker) {
  AcceptanceGuardConfig& guard = tracker.guard;
  list.push_back(numberParameter(
      guard.max_area_drop, {0.0, 1.0},
      {"regions.guard.max_area_drop", "", "Largest accepted drop of the total area.", "0.15"}));
  list.push_back(numberParameter(guard.max_count_drop, {0.0, 1.0},
                                 {"regions.guard.max_count_drop", "",
                                  "Largest accepted drop of the number of regions.", "0.15"}));
  list.push_back(
      choiceParameter<bool>(guard.reject_on_count_alone, {{"true", true}, {"false", false}},
                            {"regions.guard.reject_on_count_alone", "",
                             "Whether the number of regions alone can reject an update.", "true"}));
  list.push_back(
      countParameter(guard.max_rejections_in_a_row, {0, 1000000},
                     {"regions.guard.max_rejections_in_a_row", "updates",
                      "After so many rejections the new state is accepted; 0: never.", "0"}));

  list.push_back(numberParameter(tracker.min_overlap, {0.0, 1.0},
                                 {"regions.tracker.min_overlap", "",
                                  "A track's region must exceed this polygon IoU.", "0.2"}));
  list.push_back(numberParameter(
      tracker.max_centroid_distance_m, {0.0, kInfinity},
      {"regions.tracker.max_centroid_distance_m", "m",
       "Its centroid must be nearer than this; those of the parts of a corridor are not.", "1.5"}));
  list.push_back(numberParameter(
      tracker.min_area_ratio, {0.0, 1.0},
      {"regions.tracker.min_area_ratio", "", "New area over old, at least.", "0.25"}));
  list.push_back(
      numberParameter(tracker.max_area_ratio, {1.0, 1000.0},
                      {"regions.tracker.max_area_ratio", "", "New area over old, at most.", "4"}));
  list.push_back(countParameter(tracker.max_missed_updates, {0, 1000000},
                                {"regions.tracker.max_missed_updates", "updates",
                                 "A track survives so many updates without a region.", "3"}));
}

void addGraph(Parameters& list, GraphBuilderConfig& graph) {
  list.push_back(numberParameter(
      graph.maintenance_period_s, {0.01, 3600.0},
      {"graph.maintenance_period_s", "s", "Time between two maintenances of the rooms.", "2"}));
  list.push_back(numberParameter(graph.agents.min_distance_m, {0.0, kLongest_m},
                                 {"graph.agents.min_distance_m", "m",
                                  "A pose so far from the last agent becomes one.", "0.5"}));
  list.push_back(numberParameter(
      graph.agents.max_interval_s, {0.0, 86400.0},
      {"graph.agents.max_interval_s", "s", "So does a pose so long after it.", "10"}));
  list.push_back(numberParameter(
      graph.agents.recent_s, {1.0, 1e9},
      {"graph.agents.recent_s", "s", "Of agents older than this only the last at a place stays."}));
  list.push_back(numberParameter(
      graph.agents.old_spacing_m, {0.01, kLongest_m},
      {"graph.agents.old_spacing_m", "m", "Side of the cubes that are one place for them."}));
  list.push_back(
      countParameter(graph.agents.max_agents, {2, static_cast<int>(kMaxGraphNodes / 2)},
                     {"graph.agents.max_agents", "agents", "Of more agents the oldest go."}));

  RoomLayerConfig& rooms = graph.rooms;
  list.push_back(numberParameter(rooms.boundary_tolerance_m, {0.0, 10.0},
                                 {"graph.rooms.boundary_tolerance_m", "m",
                                  "A room also holds what is this near to it.", "0.5"}));
  list.push_back(numberParameter(rooms.floor_z_m, {-kLongest_m, kLongest_m},
                                 {"graph.rooms.floor_z_m", "m", "Height of room nodes.", ""}));
  list.push_back(numberParameter(
      rooms.relink_min_overlap, {0.0, 1.0},
      {"graph.rooms.relink_min_overlap", "", "Share of a room its successor must cover.", "0.65"}));
  list.push_back(numberParameter(
      rooms.relink_min_members, {0.0, 1.0},
      {"graph.rooms.relink_min_members", "", "Share of the room's members it must hold.", "0.5"}));
  list.push_back(numberParameter(rooms.relink_min_members_off_centre, {0.0, 1.0},
                                 {"graph.rooms.relink_min_members_off_centre", "",
                                  "The same when it does not hold the room's centroid.", "0.75"}));
  list.push_back(numberParameter(
      rooms.relink_min_margin, {0.0, 1.0},
      {"graph.rooms.relink_min_margin", "", "Lead it must have over the second best.", "0.15"}));
  list.push_back(choiceParameter<PromotionEvidence>(
      rooms.promotion,
      {{"any_entity", PromotionEvidence::kAnyEntity},
       {"observed_area", PromotionEvidence::kObservedArea}},
      {"graph.rooms.promotion", "", "What makes a room of a region nobody has entered.",
       "any_entity"}));
  list.push_back(numberParameter(rooms.min_promoted_area_m2, {0.0, 1e6},
                                 {"graph.rooms.min_promoted_area_m2", "m2",
                                  "observed_area: smallest region that becomes a room.", ""}));
  list.push_back(numberParameter(rooms.min_promoted_age_s, {0.0, 86400.0},
                                 {"graph.rooms.min_promoted_age_s", "s",
                                  "observed_area: once it was known for so long.", ""}));
  list.push_back(numberParameter(
      rooms.max_frontier_share, {0.0, 1.0},
      {"graph.rooms.max_frontier_share", "",
       "A room is confirmed once no more of its boundary is frontier; until then it is partial.",
       "1"}));
  list.push_back(numberParameter(
      rooms.removal_grace_s, {0.0, 86400.0},
      {"graph.rooms.removal_grace_s", "s",
       "A room stays so long after its region was last seen, and while the tracker remembers it.",
       "0"}));
}

void addNavigation(Parameters& list, NavigationLayerConfig& navigation) {
  list.push_back(countParameter(
      navigation.block_cells, {2, 64},
      {"graph.navigation.block_cells", "cells", "Side of a block of the lattice.", "15"}));
  list.push_back(countParameter(navigation.min_free_cells, {1, 4096},
                                {"graph.navigation.min_free_cells", "cells",
                                 "A node is made when it stands for so many free cells.", "25"}));
  list.push_back(countParameter(navigation.min_kept_cells, {0, 4096},
                                {"graph.navigation.min_kept_cells", "cells",
                                 "It is removed when they are fewer; 0: never.", "0"}));
  list.push_back(choiceParameter<NavigationNodes>(
      navigation.nodes,
      {{"one_per_block", NavigationNodes::kOnePerBlock},
       {"one_per_part", NavigationNodes::kOnePerPart}},
      {"graph.navigation.nodes", "",
       "Whether a node stands in the middle of a block or on each connected part of it.",
       "one_per_block"}));
}

void addObjects(Parameters& list, ObjectLayerConfig& objects) {
  list.push_back(choiceParameter<ObjectMemory>(
      objects.memory,
      {{"first_sight", ObjectMemory::kFirstSight}, {"running", ObjectMemory::kRunning}},
      {"graph.objects.memory", "",
       "Whether an object stays as first seen or is made of all its detections.", "first_sight"}));
  list.push_back(numberParameter(objects.merge_distance_m, {0.0, 100.0},
                                 {"graph.objects.merge_distance_m", "m",
                                  "first_sight: objects of a class so near are one.", "0.75"}));
  list.push_back(numberParameter(objects.flicker_distance_m, {0.0, 100.0},
                                 {"graph.objects.flicker_distance_m", "m",
                                  "first_sight: objects of any class so near are one.", "0.15"}));
  list.push_back(numberParameter(
      objects.min_common_box, {0.0, 1.0},
      {"graph.objects.min_common_box", "",
       "running: objects of a class with this share of the smaller box in common are one.", ""}));
  list.push_back(choiceParameter<GhostRemoval>(
      objects.ghosts,
      {{"never", GhostRemoval::kNever}, {"seen_through", GhostRemoval::kSeenThrough}},
      {"graph.objects.ghosts", "", "When objects that are not there any more are removed.",
       "never"}));
  list.push_back(countParameter(objects.ghost_checks, {1, 1000},
                                {"graph.objects.ghost_checks", "looks",
                                 "So many in a row must find an object's space free.", ""}));
  list.push_back(numberParameter(
      objects.max_link_distance_m, {0.0, 100.0},
      {"graph.objects.max_link_distance_m", "m", "From an object to its navigation node.", "1"}));
}

}  // namespace

std::vector<Parameter> parametersOf(PipelineConfig& config) {
  Parameters list;
  addPerception(list, config.depth, config.poses);
  addDetection(list, config.detection);
  addSegmenter(list, config.segmenter);
  addMapping(list, config.occupancy, config.free_space);
  addDecomposition(list, config);
  addDude(list, config.dude);
  addConstriction(list, config.constriction);
  addTracking(list, config.tracker);
  addGraph(list, config.graph);
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
