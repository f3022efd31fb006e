// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "occusg/geometry/polygon.hpp"
#include "occusg/parameter.hpp"
#include "occusg/regions/decomposer.hpp"

namespace occusg {

class DudeDivision;

/// What is done to the layer before its outlines are taken.
enum class GridCleaning {
  kNone,  ///< Free cells are free space, nothing else is.
  /// As the published driver does in effect at 0.05 m: free cells and obstacles below level 10 grow
  /// by 5 to 6 cells, obstacles above level 90 by 4 to 5, and the latter win. Rooms with hard walls
  /// shrink by 0.25 m a side, gaps up to 0.55 m close over, walls of level 90 and below dissolve.
  kPublished,
};

/// Which 4-connected components of free space become regions.
enum class ComponentChoice { kAll, kLargest };

/// Which cuts the dual-space decomposition makes.
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

/// What the decomposition met, summed over its calls.
struct DudeCounters {
  std::size_t updates = 0;
  std::size_t batch_updates = 0;  ///< Updates that recomputed everything.
  std::size_t components = 0;
  std::size_t corners = 0;
  std::size_t candidates = 0;
  std::size_t cuts = 0;
  std::size_t ignored_holes = 0;
};

/// The configuration nearest to the published system: a depth threshold of 1.5 m, its grid cleaning
/// and its restriction to the largest component.
[[nodiscard]] DudeDecomposerConfig publishedDudeConfig();

/// How the dual-space decomposition came to its cuts, to be drawn. All in the map frame [m].
struct DudeTrace {
  /// An edge of the convex hull that closes a pocket.
  struct Bridge {
    Segment2 segment;
    int level = 0;  ///< Even: closes obstacle that reaches into free space; odd: free space.
  };
  /// An obstacle corner and how deep it reaches.
  struct Feature {
    Point2 at;
    double depth_m = 0.0;
  };
  /// A cut through free space.
  struct Cut {
    Segment2 segment;
    double depth_m = 0.0;  ///< The largest depth threshold at which the cut is made.
  };
  std::vector<Bridge> bridges;
  std::vector<Feature> minima;         ///< Obstacle corners where cuts may end.
  std::vector<Point2> feet;            ///< Points straight across from minima.
  std::vector<Polygon> ignored_holes;  ///< Free-standing obstacles that count as furniture.
  std::vector<Cut> candidates;
  std::vector<Cut> cuts;  ///< Those that were chosen.
};

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
  DudeDecomposer(const DudeDecomposer&) = delete;
  DudeDecomposer& operator=(const DudeDecomposer&) = delete;
  DudeDecomposer(DudeDecomposer&&) = delete;
  DudeDecomposer& operator=(DudeDecomposer&&) = delete;
  ~DudeDecomposer() override;

  using Decomposer::update;
  const Decomposition& update(const FreeSpace& layer, const CellBox& changed) override;
  void reset() override;

  [[nodiscard]] const DudeCounters& counters() const;
  /// The steps behind a batch decomposition of the last layer, and the cuts that stand now.
  [[nodiscard]] DudeTrace trace() const;

 private:
  std::unique_ptr<DudeDivision> division_;
};

}  // namespace occusg
