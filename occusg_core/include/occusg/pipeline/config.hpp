// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "occusg/graph/graph_builder.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/parameter.hpp"
#include "occusg/perception/depth_projector.hpp"
#include "occusg/perception/detection_builder.hpp"
#include "occusg/perception/onnx_segmenter.hpp"
#include "occusg/perception/pose_gate.hpp"
#include "occusg/regions/constriction_decomposer.hpp"
#include "occusg/regions/decomposer.hpp"
#include "occusg/regions/dude_decomposer.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg {

/// How free space is cut into regions.
enum class DecomposerKind {
  kDude,          ///< Dual-space decomposition, as in the paper.
  kConstriction,  ///< Basins of the distance to obstacles.
};

/// All parameters of the pipeline, one struct a stage. Defaults are the project's own choice.
struct PipelineConfig {
  DepthProjectorConfig depth;
  PoseGateConfig poses;
  DetectionBuilderConfig detection;
  OnnxSegmenterConfig segmenter;  ///< Of a model, when there is one; its files are no parameters.
  OccupancyMapConfig occupancy;
  FreeSpaceLayerConfig free_space;
  double region_period_s = 0.5;  ///< Regions are updated when so much logical time has passed [s].
  /// On the recordings of docs/results.md constriction finds more rooms than DuDe.
  DecomposerKind decomposer = DecomposerKind::kConstriction;
  ConstrictionDecomposerConfig constriction;
  DudeDecomposerConfig dude;
  RegionTrackerConfig tracker;
  GraphBuilderConfig graph;
};

/// Every parameter of `config` by its key, in the order of the stages; the single source of the
/// YAML files, the command line's help and the parameter page.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(PipelineConfig& config);

/// The decomposer `config` asks for.
[[nodiscard]] std::unique_ptr<Decomposer> makeDecomposer(const PipelineConfig& config);
/// The smallest region the configured decomposer gives [m2].
[[nodiscard]] double smallestRegion_m2(const PipelineConfig& config);

/// The configuration the paper describes; where the paper is silent, its authors' shipped one.
[[nodiscard]] PipelineConfig paperConfig();

/// Every parameter against its range, and the rules between parameters, which no single range can
/// express.
/// @throws Error naming the keys and values.
void check(const PipelineConfig& config);

}  // namespace occusg
