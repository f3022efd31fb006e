// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/config.hpp"

#include "occusg/error.hpp"

namespace occusg {
namespace {

using Parameters = std::vector<Parameter>;

void append(const Parameters& more, Parameters& list) {
  list.insert(list.end(), more.begin(), more.end());
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

}  // namespace

std::vector<Parameter> parametersOf(PipelineConfig& config) {
  Parameters list;
  append(parametersOf(config.depth), list);
  append(parametersOf(config.poses), list);
  append(parametersOf(config.detection), list);
  append(parametersOf(config.segmenter), list);
  append(parametersOf(config.occupancy), list);
  append(parametersOf(config.free_space), list);
  addDecomposition(list, config);
  append(parametersOf(config.dude), list);
  append(parametersOf(config.constriction), list);
  append(parametersOf(config.tracker), list);
  append(parametersOf(config.graph), list);
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
  (void)checked(config);
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
