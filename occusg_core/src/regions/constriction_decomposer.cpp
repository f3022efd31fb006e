// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/constriction_decomposer.hpp"

#include <utility>

#include "occusg/regions/label_regions.hpp"
#include "regions/basin_regions.hpp"
#include "regions/constriction_division.hpp"
#include "regions/label_window.hpp"
#include "regions/outside.hpp"

namespace occusg {
namespace {

/// [m] A border this near to an obstacle is wall: two cells of common maps, and half a cell.
constexpr double kWallReach_m = 0.15;

/// Labels over the bounds of the free cells; no cells when none is free.
Grid<std::int32_t> labelsOf(const FreeSpace& layer, const ConstrictionDecomposerConfig& config) {
  const GridFrame& frame = layer.frame;
  const Grid<std::int8_t> closed = layer.cells.dense();
  auto [labels, squared] = basinRegionsOf(closed, frame, config);
  if (labels.empty()) return {};
  removeNarrow(squared, config.min_room_width_m / frame.resolution_m, labels);
  if (config.min_enclosed_share > 0.0)
    removeOutside(closed, {config.min_enclosed_share, kWallReach_m / frame.resolution_m}, labels);
  return std::move(labels);
}

bool holds(const CellBox& box, const CellBox& inner) { return box.including(inner) == box; }

}  // namespace

ConstrictionDecomposer::ConstrictionDecomposer(const ConstrictionDecomposerConfig& config)
    : config_(checked(config)) {}

ConstrictionDecomposer::~ConstrictionDecomposer() = default;

const Decomposition& ConstrictionDecomposer::update(const FreeSpace& layer,
                                                    const CellBox& changed) {
  if (layer.evidence.empty()) {
    division_.reset();
    const Grid<std::int32_t> labels = labelsOver(layer.cells.box(), labelsOf(layer, config_));
    decomposition_ = decompositionOf(labels, layer.frame, config_.min_crossing_m);
    return decomposition_;
  }
  const bool continues = division_ && layer.frame.resolution_m == frame_.resolution_m &&
                         holds(layer.cells.box(), box_);
  // A number is left out, so that nobody takes the first update for the one after the last.
  if (!continues) division_ = std::make_unique<ConstrictionDivision>(config_, updates_ + 1);
  frame_ = layer.frame;
  box_ = layer.cells.box();
  const Decomposition& decomposition = division_->update(layer, continues ? changed : box_);
  updates_ = decomposition.update;
  return decomposition;
}

void ConstrictionDecomposer::reset() {
  division_.reset();
  decomposition_ = {};
}

std::size_t ConstrictionDecomposer::memoryBytes() const {
  return decomposition_.labels.values().size() * sizeof(std::int32_t) +
         (division_ ? division_->memoryBytes() : 0);
}

}  // namespace occusg
