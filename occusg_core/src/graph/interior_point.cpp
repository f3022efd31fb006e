// SPDX-License-Identifier: BSD-3-Clause
#include "graph/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <vector>

namespace occusg {
namespace {

constexpr double kPrecisionM = 0.05;
// A sliver kilometres long must not hold up an update; what was found so far is inside anyway.
constexpr int kMaxSplits = 2000;
constexpr double kSquareDiagonal = 1.4142135623730951;

/// Distance to the boundary, negative outside.
double clearance(const Polygon& polygon, const Point2& point) {
  const double distance_m = boundaryDistance(polygon, point);
  return contains(polygon, point) ? distance_m : -distance_m;
}

/// A square that may hold a better point.
struct Square {
  Point2 center;
  double half_m = 0.0;
  double clearance_m = 0.0;  ///< Of the centre.

  /// No point of the square is farther from the boundary.
  [[nodiscard]] double bound() const { return clearance_m + half_m * kSquareDiagonal; }
  friend bool operator<(const Square& a, const Square& b) {
    return std::make_tuple(a.bound(), a.center.y, a.center.x) <
           std::make_tuple(b.bound(), b.center.y, b.center.x);
  }
};

Square squareAt(const Polygon& polygon, const Point2& center, double half_m) {
  return {center, half_m, clearance(polygon, center)};
}

}  // namespace

// Best-first search over squares that are split in four while one may still hold a better point.
// A sliver narrower than the precision is represented by a vertex.
Point2 interiorPoint(const Polygon& polygon) {
  Point2 best = centroid(polygon);
  const double centroid_clearance_m = clearance(polygon, best);
  // Counting the centroid twofold keeps it unless it is squeezed.
  double best_clearance_m = std::max(0.0, 2.0 * centroid_clearance_m);

  const Bounds2 box = bounds(polygon);
  const double half_m = 0.5 * std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  std::priority_queue<Square> open;
  open.push(squareAt(polygon, midpoint({box.min, box.max}), half_m));
  for (int splits = 0; !open.empty() && splits < kMaxSplits; ++splits) {
    const Square square = open.top();
    open.pop();
    if (square.clearance_m > best_clearance_m) {
      best = square.center;
      best_clearance_m = square.clearance_m;
    }
    if (square.bound() <= best_clearance_m + kPrecisionM) break;
    const double quarter_m = 0.5 * square.half_m;
    for (const double dy : {-quarter_m, quarter_m}) {
      for (const double dx : {-quarter_m, quarter_m}) {
        open.push(squareAt(polygon, {square.center.x + dx, square.center.y + dy}, quarter_m));
      }
    }
  }
  return best_clearance_m > 0.0 ? best : polygon.outer.front();
}

}  // namespace occusg
