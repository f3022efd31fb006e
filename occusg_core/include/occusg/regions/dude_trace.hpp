// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// How the dual-space decomposition came to its cuts, to be drawn. All in the map frame [m].
struct DudeTrace {
  struct Bridge {
    Segment2 segment;
    int level = 0;  ///< Even: closes obstacle that reaches into free space; odd: free space.
  };
  struct Feature {
    Point2 at;
    double depth_m = 0.0;
  };
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

}  // namespace occusg
