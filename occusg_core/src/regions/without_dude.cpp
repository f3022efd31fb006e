// SPDX-License-Identifier: BSD-3-Clause
// Stands for the decomposer dude in a build with OCCUSG_WITH_DUDE=OFF.
#include "occusg/error.hpp"
#include "occusg/regions/dude_decomposer.hpp"
#include "regions/dude_pockets.hpp"

namespace occusg {

class DudeDivision {};

namespace {

Error absent() {
  return refuse("regions.decomposer", "is dude, which this build leaves out (OCCUSG_WITH_DUDE=OFF)",
                "constriction is needed, or a build with dude");
}

}  // namespace

DudeDecomposer::DudeDecomposer(const DudeDecomposerConfig& /*config*/) { throw absent(); }

const Decomposition& DudeDecomposer::update(const FreeSpace& /*layer*/,
                                            const CellBox& /*changed*/) {
  throw absent();
}

DudeDecomposer::~DudeDecomposer() = default;

void DudeDecomposer::reset() {}

const DudeCounters& DudeDecomposer::counters() const { throw absent(); }

std::vector<DudeBridge> pocketTree(const CornerRing& /*ring*/, double /*min_depth_cells*/,
                                   int /*max_levels*/) {
  throw absent();
}

DudeTrace DudeDecomposer::trace() const { throw absent(); }

}  // namespace occusg
