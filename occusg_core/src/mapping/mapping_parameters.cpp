// SPDX-License-Identifier: BSD-3-Clause
// The parameters of this module: names, units, ranges, what they mean, and the paper's values.
#include <limits>

#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/mapping/occupancy_map.hpp"

namespace occusg {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<Parameter> parametersOf(OccupancyMapConfig& occupancy) {
  std::vector<Parameter> list;
  list.push_back(numberParameter(
      occupancy.resolution_m, {0.001, 10.0},
      {"mapping.occupancy.resolution_m", "m", "Edge length of a voxel and of a 2D cell.", "0.05"}));
  list.push_back(numberParameter(
      occupancy.max_range_m, {0.001, 1e5},
      {"mapping.occupancy.max_range_m", "m",
       "Maximum length of a ray; a longer ray is cut there and hits nothing.", "8"}));
  list.push_back(
      numberParameter(occupancy.hit_probability, {0.501, 0.999},
                      {"mapping.occupancy.hit_probability", "",
                       "Occupancy probability of a voxel that is hit by a ray.", "0.7"}));
  list.push_back(
      numberParameter(occupancy.miss_probability, {0.001, 0.499},
                      {"mapping.occupancy.miss_probability", "",
                       "Occupancy probability of a voxel that is passed by a ray.", "0.4"}));
  list.push_back(
      numberParameter(occupancy.min_probability, {0.001, 0.499},
                      {"mapping.occupancy.min_probability", "",
                       "Lower clamping value of the occupancy probability of a voxel.", "0.12"}));
  list.push_back(
      numberParameter(occupancy.max_probability, {0.501, 0.999},
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
      occupancy.max_memory_mb, {0.001, 1e6},
      {"mapping.occupancy.max_memory_mb", "MiB",
       "Maximum memory of the map; once it is reached, no more frames are added."}));
  return list;
}

std::vector<Parameter> parametersOf(FreeSpaceLayerConfig& layer) {
  std::vector<Parameter> list;
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
  return list;
}

}  // namespace occusg
