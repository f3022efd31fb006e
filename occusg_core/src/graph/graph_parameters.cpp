// SPDX-License-Identifier: BSD-3-Clause
// The parameters of this module: names, units, ranges, what they mean, and the paper's values.
#include "occusg/graph/graph_config.hpp"
#include "occusg/graph/limits.hpp"

namespace occusg {
namespace {

constexpr double kLongest_m = 1000.0;

}  // namespace

std::vector<Parameter> parametersOf(AgentLayerConfig& agents) {
  std::vector<Parameter> list;
  list.push_back(numberParameter(
      agents.min_distance_m, {0.0, kLongest_m},
      {"graph.agents.min_distance_m", "m",
       "A pose becomes an agent node when it is this far from the last one.", "0.5"}));
  list.push_back(numberParameter(
      agents.max_interval_s, {0.0, 86400.0},
      {"graph.agents.max_interval_s", "s",
       "A pose becomes an agent node when it is this much later than the last one.", "10"}));
  list.push_back(numberParameter(
      agents.recent_s, {1.0, 1e9},
      {"graph.agents.recent_s", "s",
       "Agent nodes older than this are thinned: only the last one at each place is kept."}));
  list.push_back(numberParameter(
      agents.old_spacing_m, {0.01, kLongest_m},
      {"graph.agents.old_spacing_m", "m",
       "Side of the cubes that count as one place when old agent nodes are thinned."}));
  list.push_back(
      countParameter(agents.max_agents, {2, static_cast<int>(kMaxGraphNodes / 2)},
                     {"graph.agents.max_agents", "agents",
                      "Maximum number of agent nodes; beyond it the oldest are removed."}));
  return list;
}

std::vector<Parameter> parametersOf(RoomLayerConfig& rooms) {
  std::vector<Parameter> list;
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
  return list;
}

std::vector<Parameter> parametersOf(NavigationLayerConfig& navigation) {
  std::vector<Parameter> list;
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
  return list;
}

std::vector<Parameter> parametersOf(ObjectLayerConfig& objects) {
  std::vector<Parameter> list;
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
  return list;
}

std::vector<Parameter> parametersOf(GraphBuilderConfig& graph) {
  std::vector<Parameter> list;
  list.push_back(numberParameter(
      graph.maintenance_period_s, {0.01, 3600.0},
      {"graph.maintenance_period_s", "s", "Period of the maintenance of the rooms.", "2"}));
  for (const std::vector<Parameter>& layer :
       {parametersOf(graph.agents), parametersOf(graph.rooms), parametersOf(graph.navigation),
        parametersOf(graph.objects)})
    list.insert(list.end(), layer.begin(), layer.end());
  return list;
}

}  // namespace occusg
