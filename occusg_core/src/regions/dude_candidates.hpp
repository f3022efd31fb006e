// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/cell_outline.hpp"
#include "occusg/geometry/grid.hpp"
#include "regions/dude_mesh.hpp"
#include "regions/dude_symmetry.hpp"

namespace occusg {

/// The cells round an outline, seen in the outline's own (canonical) place.
class DudeSurroundings {
 public:
  /// @param open 1 where the map is free.
  /// @param squared_clearance squared distance to the nearest cell that is not open [cells2].
  /// @param to_map from the canonical place to the map. All three must outlive this object.
  DudeSurroundings(const Grid<std::uint8_t>& open, const Grid<std::int32_t>& squared_clearance,
                   const GridSymmetry& to_map)
      : open_(open), squared_clearance_(squared_clearance), to_map_(to_map) {}

  [[nodiscard]] bool isOpen(const Cell& cell) const {
    return open_.valueOr(to_map_.cell(cell), 0) != 0;
  }
  /// Squared distance from the middle of `cell` to that of the nearest cell that is not open.
  [[nodiscard]] std::int32_t squaredClearance(const Cell& cell) const {
    return squared_clearance_.valueOr(to_map_.cell(cell), 0);
  }
  /// Distance to the obstacle's edge [cells] that belongs to a squared clearance.
  [[nodiscard]] static double radius(std::int32_t squared_clearance);

 private:
  const Grid<std::uint8_t>& open_;
  const Grid<std::int32_t>& squared_clearance_;
  const GridSymmetry& to_map_;
};

/// Squared distance of every open cell to the nearest cell that is not [cells2]; cells beyond the
/// grid are not open.
[[nodiscard]] Grid<std::int32_t> squaredClearance(const Grid<std::uint8_t>& open);

/// A corner where a cut may end.
struct DudeCorner {
  bool is_minimum = false;  ///< Reflex, and made by an obstacle.
  bool is_foot = false;     ///< Straight across from a minimum, in the middle of a wall.
  double depth_cells = 0.0;
};

/// An outline whose corners know their depth.
struct DudeShape {
  std::vector<CornerRing> rings;    ///< Outer ring first.
  std::vector<DudeCorner> corners;  ///< Of all rings, in their order.
};

/// Measures the corners of `outline` and adds the feet: where a minimum's straight extension of a
/// wall meets the opposite wall after at most `longest_cut_cells` and nothing else is nearer, the
/// wall gets a corner to end the cut in.
[[nodiscard]] DudeShape shapeOf(const CellOutline& outline, const DudeSurroundings& surroundings,
                                double longest_cut_cells);

/// An edge of the triangulation that may become a cut.
struct DudeCandidate {
  int face = 0;  ///< The face left of it when going from a to b.
  int side = 0;  ///< Its number in that face.
  int corner_a = 0;
  int corner_b = 0;
  double length_cells = 0.0;
  double depth_cells = 0.0;  ///< The largest depth threshold at which the cut is made.
};

/// The inner edges between two minima, or a minimum and a foot, across which free space is locally
/// narrowest: nothing, neither a corner nor a wall, lies within the circle that has the edge as its
/// diameter. Such an edge belongs to every Delaunay triangulation, so the list does not depend on
/// how ties are broken; it leaves its ends at 90 degrees or more to either wall, so it always
/// resolves the minimum; and no two of them cross.
[[nodiscard]] std::vector<DudeCandidate> cutCandidates(const DudeMesh& mesh, const DudeShape& shape,
                                                       const DudeSurroundings& surroundings,
                                                       double longest_cut_cells);

}  // namespace occusg
