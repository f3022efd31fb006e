// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "occusg/geometry/cell.hpp"
#include "occusg/geometry/tiled_grid.hpp"
#include "occusg/mapping/column_evidence.hpp"
#include "occusg/mapping/free_space_cells.hpp"

namespace occusg {

/// Heights of the map frame [m]; all of them by default.
struct HeightSpan {
  double bottom_m = -std::numeric_limits<double>::infinity();
  double top_m = std::numeric_limits<double>::infinity();

  /// The lower end belongs to the span, the upper one does not, and a NaN is in none.
  [[nodiscard]] bool holds(double z_m) const { return z_m >= bottom_m && z_m < top_m; }
  friend bool operator==(const HeightSpan& a, const HeightSpan& b) {
    return a.bottom_m == b.bottom_m && a.top_m == b.top_m;
  }
  friend bool operator!=(const HeightSpan& a, const HeightSpan& b) { return !(a == b); }
};

/// The span of a storey begins so far beneath its floor, within the slab.
inline constexpr double kStoreyBelowFloor_m = 0.15;
/// A floor that lies deeper below a storey's is no step down but another storey's.
inline constexpr double kLeastFall_m = 0.8;

/// One level of a building.
struct Storey {
  int id = 0;              ///< Storeys are numbered from 0 as they are found; never used again.
  double floor_z_m = 0.0;  ///< Height of its floor in the map frame.
  HeightSpan span;         ///< From within its slab, kStoreyBelowFloor_m, to within the slab above.
};

/// By what a camera got from one storey to another.
enum class StairsKind {
  kStairs,  ///< Over treads.
  kRamp,    ///< Over a slope too gentle for treads.
  kLift,    ///< Straight up.
};

/// A way between two storeys that a camera went.
struct StoreyPassage {
  StairsKind kind = StairsKind::kStairs;
  int lower_storey = 0;
  int upper_storey = 0;
  std::vector<Eigen::Vector3d> path;  ///< From the lower floor to the upper, at the feet [m].
  int risers = 0;                     ///< Steps seen along the path; 0 without any.
};

/// The storeys of a building that a robot reached, and how it got from one to another.
struct Building {
  std::vector<Storey> storeys;  ///< In the order of their ids, which count from 0.
  std::vector<StoreyPassage> passages;
  std::size_t current = 0;  ///< Index of the storey the robot is on, or was on last.
  /// Mean height of the sensor above the floor [m]; 0 where no sensor is looked at.
  double sensor_height_m = 0.0;
};

/// Gives each storey the heights from within the slab under it to within the slab under the next
/// higher one; the lowest and the highest storey have no bound outwards.
void divideHeights(std::vector<Storey>& storeys);

/// The 2D free-space layer.
struct FreeSpace {
  GridFrame frame;
  FreeSpaceCells cells;
  CellBox changed;  ///< Bounds of the cells that differ from the previous update's.
  TiledGrid<ColumnEvidence> evidence{};  ///< What the cells follow from; empty for a 2D map.
  CellBox gaps_changed{};  ///< Bounds of the cells whose gap or overhead differs likewise.
};

}  // namespace occusg
