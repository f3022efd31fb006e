// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/dude_decomposer.hpp"

#include "regions/dude_division.hpp"

namespace occusg {

DudeDecomposerConfig publishedDudeConfig() {
  DudeDecomposerConfig config;
  config.depth_threshold_m = 1.5;
  config.max_ignored_hole_m = 1.5;
  config.cleaning = GridCleaning::kPublished;
  config.components = ComponentChoice::kLargest;
  return config;
}

DudeDecomposer::DudeDecomposer(const DudeDecomposerConfig& config)
    : division_(std::make_unique<DudeDivision>(config)) {}

DudeDecomposer::~DudeDecomposer() = default;

const Decomposition& DudeDecomposer::update(const FreeSpace& layer, const CellBox& changed) {
  return division_->update(layer, changed);
}

void DudeDecomposer::reset() { division_->reset(); }

const DudeCounters& DudeDecomposer::counters() const { return division_->counters(); }

DudeTrace DudeDecomposer::trace() const { return division_->trace(); }

}  // namespace occusg
