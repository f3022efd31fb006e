// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "occusg/mapping/free_space.hpp"
#include "occusg/regions/region.hpp"

namespace occusg {

/// Cuts free space into regions (paper, Sec. 3.3). An implementation may keep state from update to
/// update to spare work or to keep old cuts, but must accept any layer at any time: grown, shrunk,
/// or a different map altogether.
class Decomposer {
 public:
  Decomposer() = default;
  Decomposer(const Decomposer&) = delete;
  Decomposer& operator=(const Decomposer&) = delete;
  Decomposer(Decomposer&&) = delete;
  Decomposer& operator=(Decomposer&&) = delete;
  virtual ~Decomposer() = default;

  /// Total: every layer has a decomposition, if only an empty one. Equal sequences of calls give
  /// equal results. The reference stays valid until the next call.
  /// @param layer the whole layer.
  /// @param changed bounds of the cells whose value, or whose gap in the evidence, differs from the
  ///        previous call's layer.
  virtual const Decomposition& update(const FreeSpace& layer, const CellBox& changed) = 0;

  /// For a caller that passes on every update of the layer.
  const Decomposition& update(const FreeSpace& layer) {
    return update(layer, layer.changed.including(layer.gaps_changed));
  }

  /// Forgets everything kept from earlier updates.
  virtual void reset() = 0;
};

}  // namespace occusg
