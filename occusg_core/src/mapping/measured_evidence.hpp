// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/column_bits.hpp"
#include "occusg/mapping/column_evidence.hpp"

namespace occusg {

/// `ColumnEvidenceConfig` in voxels.
struct EvidenceHeights {
  int ceiling = 0;
  VoxelRun body;  ///< Above the floor.
};

/// @throws Error naming the field, its value and the allowed range.
[[nodiscard]] EvidenceHeights evidenceHeights(const ColumnEvidenceConfig& config,
                                              double resolution_m);

/// Height at which a column shows a floor: the bottom of the lowest run of at least `needed` free
/// voxels that stands on an occupied one; kNoFloor when there is none.
[[nodiscard]] std::int16_t shownFloor(const ColumnBits& column, int needed);

[[nodiscard]] ColumnEvidence measuredEvidence(const ColumnBits& column, std::int16_t floor,
                                              const EvidenceHeights& heights);

}  // namespace occusg
