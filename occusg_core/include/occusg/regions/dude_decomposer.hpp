// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg/regions/decomposer.hpp"
#include "occusg/regions/dude_mask.hpp"
#include "occusg/regions/dude_partition.hpp"
#include "occusg/regions/dude_regions.hpp"
#include "occusg/regions/dude_trace.hpp"

namespace occusg {

/// Which 4-connected components of free space become regions.
enum class ComponentChoice { kAll, kLargest };

struct DudeDecomposerConfig {
  /// d_thr: a cut is made where an obstacle reaches at least this deep into free space, measured
  /// from the bridge of its pocket on the convex hull, or along a free-standing obstacle [m].
  double depth_threshold_m = 2.5;
  /// A cut is kept where half its length is below this share of the largest free circle on its
  /// smaller side, > 0.
  double max_width_ratio = 0.8;
  double longest_cut_m = 4.0;  ///< Wider openings are never cut [m].
  /// Smaller regions join the neighbour they share the longest cut with; free space as small that
  /// has no neighbour gets no region [m2].
  double min_region_area_m2 = 1.0;
  /// Free-standing obstacles no wider than this are furniture: regions extend under them [m].
  double max_ignored_hole_m = 1.8;
  /// Share by which a cut of the previous update is preferred, so that regions do not flicker.
  double keep_bonus = 0.2;
  GridCleaning cleaning = GridCleaning::kNone;
  ComponentChoice components = ComponentChoice::kAll;
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(DudeDecomposerConfig& config);

/// The configuration nearest to the published system: a depth threshold of 1.5 m, its grid cleaning
/// and its restriction to the largest component.
[[nodiscard]] DudeDecomposerConfig publishedDudeConfig();

/// Dual-space decomposition of free space (Liu, Xi, Lien: "Dual-space decomposition of 2D complex
/// shapes", CVPR 2014), updated where the layer changed (Fermin-Leon, Neira, Castellanos:
/// "Incremental contour-based topological segmentation for robot exploration", ICRA 2017).
///
/// Corners of obstacles that reach deep into free space are joined to the wall opposite by the
/// diagonals of a constrained Delaunay triangulation, and the triangles between the cuts are the
/// regions. All predicates are exact, no corner is ever constructed, every step is bounded, all
/// components and holes are kept. A larger depth threshold never gives more regions.
///
/// Regions are unions of cells: their polygons run along cell edges, are simple and disjoint, and
/// hold exactly the cells of their label. The crossing of every cut is its straight segment.
///
/// The first update, and any that touches every region, recomputes everything; the result then
/// depends on the layer alone, and a layer that is shifted, turned by quarter turns or mirrored
/// gives the same regions, shifted, turned or mirrored. Any other update divides only the regions
/// beside changed cells, together with the cells that were gained; its cost depends on these
/// regions, on the number of all regions and cuts (a pass over plain lists), and on the layer's
/// size only when the layer grows.
class DudeDecomposer final : public Decomposer {
 public:
  /// @throws Error naming the first value out of range.
  explicit DudeDecomposer(const DudeDecomposerConfig& config);

  using Decomposer::update;
  const Decomposition& update(const FreeSpace& layer, const CellBox& changed) override;
  void reset() override;

  [[nodiscard]] const DudeCounters& counters() const { return counters_; }
  /// The steps behind a batch decomposition of the last layer, and the cuts that stand now.
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
