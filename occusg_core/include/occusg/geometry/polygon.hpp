// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

namespace occusg {

/// Point in the ground plane of the map frame [m].
struct Point2 {
  double x = 0.0;
  double y = 0.0;
  friend bool operator==(const Point2& a, const Point2& b) { return a.x == b.x && a.y == b.y; }
  friend bool operator!=(const Point2& a, const Point2& b) { return !(a == b); }
};

/// A straight line between two points [m].
struct Segment2 {
  Point2 a;
  Point2 b;
};

/// Closed polyline, implicitly closed (the first vertex is not repeated).
using Ring = std::vector<Point2>;

/// Simple polygon in the map frame [m]: outer ring counter-clockwise, holes clockwise.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

/// Axis-aligned bounds [m].
struct Bounds2 {
  Point2 min;
  Point2 max;
};

/// Points nearer than this to an edge lie on it [m]: far above the rounding of metres in doubles,
/// far below any cell or sensor.
inline constexpr double kOnBoundaryTolerance_m = 1e-9;

[[nodiscard]] double distance(const Point2& a, const Point2& b);
[[nodiscard]] double length(const Segment2& segment);
/// Length of a closed ring [m].
[[nodiscard]] double length(const Ring& ring);
/// The edges of a ring in its order, the closing one last.
[[nodiscard]] std::vector<Segment2> edgesOf(const Ring& ring);
[[nodiscard]] Point2 midpoint(const Segment2& segment);

/// Signed area [m2]: positive when the ring is counter-clockwise.
[[nodiscard]] double signedArea(const Ring& ring);
/// Area without holes [m2], never negative.
[[nodiscard]] double area(const Polygon& polygon);
/// Length of all rings [m].
[[nodiscard]] double perimeter(const Polygon& polygon);
/// Area centroid, holes taken out. The mean of the outer vertices when the area is zero, the origin
/// when there is none.
[[nodiscard]] Point2 centroid(const Polygon& polygon);
/// @pre the outer ring has at least one vertex.
[[nodiscard]] Bounds2 bounds(const Polygon& polygon);
/// Convex hull, counter-clockwise, no vertex within `kOnBoundaryTolerance_m` of the line through
/// its neighbours: exact for cell corners. Fewer than three vertices when all points are on one
/// line. Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions"; O(n log n).
[[nodiscard]] Ring convexHull(const Ring& points);

/// True when `point` is inside or, within `kOnBoundaryTolerance_m`, on the boundary; the inside of
/// a hole is outside. Rings may run either way round.
[[nodiscard]] bool contains(const Polygon& polygon, const Point2& point);
/// Distance to the polygon as an area [m]: zero inside, infinite when it has no vertices.
[[nodiscard]] double distance(const Polygon& polygon, const Point2& point);
/// Distance to a segment [m].
[[nodiscard]] double distance(const Segment2& segment, const Point2& point);
/// Distance to the nearest ring [m], inside or outside; infinite when there are no vertices.
[[nodiscard]] double boundaryDistance(const Polygon& polygon, const Point2& point);

/// True when the rings enclose one well-defined area: no ring crosses or touches itself, no two
/// rings cross or share part of an edge (touching in single points is fine), every hole lies inside
/// the outer ring and outside the other holes. Decided exactly; which way round the rings run does
/// not matter. False for a ring of less than three vertices, with repeated vertices, or with a
/// coordinate that is not finite. O(n log n) but for vertices with many edges near them.
[[nodiscard]] bool isSimple(const Polygon& polygon);
/// Outer ring counter-clockwise, holes clockwise, without repeated and collinear vertices and
/// spikes (within `kOnBoundaryTolerance_m`); rings of which nothing is left are gone.
[[nodiscard]] Polygon normalized(const Polygon& polygon);
[[nodiscard]] Polygon translated(const Polygon& polygon, double dx, double dy);

}  // namespace occusg
