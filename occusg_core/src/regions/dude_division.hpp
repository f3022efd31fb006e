// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/regions/dude_decomposer.hpp"
#include "regions/dude_mask.hpp"
#include "regions/dude_partition.hpp"
#include "regions/dude_regions.hpp"

namespace occusg {

/// The work of `DudeDecomposer`: what is divided and what has to be divided again.
class DudeDivision {
 public:
  /// @throws Error naming the first value out of range.
  explicit DudeDivision(const DudeDecomposerConfig& config);

  const Decomposition& update(const FreeSpace& layer, const CellBox& changed);
  void reset();
  [[nodiscard]] const DudeCounters& counters() const { return counters_; }
  [[nodiscard]] DudeTrace trace() const;

 private:
  /// What an update has to divide again.
  struct Dirty {
    std::vector<Cell> cells;           ///< That changed, or hang on to such; sorted.
    std::vector<std::int32_t> labels;  ///< Sorted, unique.
  };

  [[nodiscard]] DudePartitionRules rulesFor(const GridFrame& frame) const;
  void recompute(const FreeSpace& layer);
  [[nodiscard]] Dirty takeChanges(const FreeSpace& layer, const CellBox& changed);
  void addAcrossChangedCuts(Dirty& dirty) const;
  void addUnlabelledBeside(Dirty& dirty) const;
  /// Divides what is dirty; false when that is everything, or turns out to be.
  [[nodiscard]] bool divideAgain(Dirty& dirty);
  [[nodiscard]] DudeMask dirtyMask(const Dirty& dirty) const;
  /// Regions outside `dirty` that something in `mask` cannot do without.
  [[nodiscard]] std::vector<std::int32_t> missingIn(const DudeMask& mask, const Dirty& dirty) const;
  [[nodiscard]] Grid<std::uint8_t> openRound(const DudeMask& mask, const Dirty& dirty) const;

  DudeDecomposerConfig config_;
  DudeCounters counters_;
  Grid<std::uint8_t> open_;  ///< 1: free after cleaning.
  DudeRegions regions_;
};

}  // namespace occusg
