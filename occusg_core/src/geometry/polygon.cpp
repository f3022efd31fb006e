// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace occusg {
namespace {

double cross(const Point2& origin, const Point2& a, const Point2& b) {
  return (a.x - origin.x) * (b.y - origin.y) - (a.y - origin.y) * (b.x - origin.x);
}

double squaredDistance(const Segment2& segment, const Point2& point) {
  const double dx = segment.b.x - segment.a.x;
  const double dy = segment.b.y - segment.a.y;
  const double squared_length = dx * dx + dy * dy;
  const double along = (point.x - segment.a.x) * dx + (point.y - segment.a.y) * dy;
  const double t = squared_length > 0.0 ? std::clamp(along / squared_length, 0.0, 1.0) : 0.0;
  const double ex = point.x - (segment.a.x + t * dx);
  const double ey = point.y - (segment.a.y + t * dy);
  return ex * ex + ey * ey;
}

/// Calls `visit(Segment2)` for every edge, the closing one included, until it returns false.
template <typename Visit>
bool visitEdges(const Ring& ring, Visit visit) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!visit(Segment2{ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]})) return false;
  return true;
}

template <typename Visit>
bool visitEdges(const Polygon& polygon, Visit visit) {
  if (!visitEdges(polygon.outer, visit)) return false;
  return std::all_of(polygon.holes.begin(), polygon.holes.end(),
                     [&visit](const Ring& hole) { return visitEdges(hole, visit); });
}

Point2 meanOf(const Ring& ring) {
  Point2 sum;
  for (const Point2& point : ring) sum = {sum.x + point.x, sum.y + point.y};
  const double count = ring.empty() ? 1.0 : static_cast<double>(ring.size());
  return {sum.x / count, sum.y / count};
}

/// First moments of a ring about `origin`, together with its signed area.
struct Moments {
  double area = 0.0;
  double x = 0.0;
  double y = 0.0;
};

Moments momentsOf(const Ring& ring, const Point2& origin) {
  Moments moments;
  visitEdges(ring, [&](const Segment2& edge) {
    const double twice = cross(origin, edge.a, edge.b);
    moments.area += twice / 2.0;
    moments.x += twice * (edge.a.x + edge.b.x - 2.0 * origin.x) / 6.0;
    moments.y += twice * (edge.a.y + edge.b.y - 2.0 * origin.y) / 6.0;
    return true;
  });
  return moments;
}

/// True when `b` is no corner between `a` and `c`: a repetition, a spike or on a straight line.
bool isSuperfluous(const Point2& a, const Point2& b, const Point2& c) {
  const double nearest = std::min(distance(a, b), distance(b, c));
  if (nearest <= kOnBoundaryTolerance_m) return true;
  const double height_area = std::abs(cross(a, b, c));
  return height_area <= kOnBoundaryTolerance_m * std::max(distance(a, b), distance(b, c));
}

Ring withoutSuperfluousVertices(const Ring& ring) {
  Ring kept;
  for (const Point2& point : ring) {
    while (kept.size() >= 2 && isSuperfluous(kept[kept.size() - 2], kept.back(), point))
      kept.pop_back();
    if (kept.empty() || distance(kept.back(), point) > kOnBoundaryTolerance_m)
      kept.push_back(point);
  }
  std::size_t first = 0;
  bool changed = true;
  while (changed && kept.size() - first >= 3) {
    changed = false;
    if (isSuperfluous(kept[kept.size() - 2], kept.back(), kept[first])) {
      kept.pop_back();
      changed = true;
    } else if (isSuperfluous(kept.back(), kept[first], kept[first + 1])) {
      ++first;
      changed = true;
    }
  }
  kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(first));
  return kept.size() >= 3 ? kept : Ring{};
}

enum class Turn { kCounterClockwise, kClockwise };

/// Reversed, when needed, about its first vertex, which stays first.
Ring oriented(Ring ring, Turn turn) {
  if (!ring.empty() && (signedArea(ring) < 0.0) != (turn == Turn::kClockwise))
    std::reverse(ring.begin() + 1, ring.end());
  return ring;
}

Ring translated(Ring ring, double dx, double dy) {
  for (Point2& point : ring) point = {point.x + dx, point.y + dy};
  return ring;
}

}  // namespace

double distance(const Point2& a, const Point2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

double length(const Segment2& segment) { return distance(segment.a, segment.b); }

double length(const Ring& ring) {
  double sum = 0.0;
  visitEdges(ring, [&sum](const Segment2& edge) {
    sum += length(edge);
    return true;
  });
  return sum;
}

std::vector<Segment2> edgesOf(const Ring& ring) {
  std::vector<Segment2> edges;
  edges.reserve(ring.size());
  visitEdges(ring, [&edges](const Segment2& edge) {
    edges.push_back(edge);
    return true;
  });
  return edges;
}

Point2 midpoint(const Segment2& segment) {
  return {(segment.a.x + segment.b.x) / 2.0, (segment.a.y + segment.b.y) / 2.0};
}

double signedArea(const Ring& ring) {
  return ring.empty() ? 0.0 : momentsOf(ring, ring.front()).area;
}

double area(const Polygon& polygon) {
  double sum = std::abs(signedArea(polygon.outer));
  for (const Ring& hole : polygon.holes) sum -= std::abs(signedArea(hole));
  return std::max(0.0, sum);
}

double perimeter(const Polygon& polygon) {
  double sum = length(polygon.outer);
  for (const Ring& hole : polygon.holes) sum += length(hole);
  return sum;
}

Point2 centroid(const Polygon& polygon) {
  if (polygon.outer.empty()) return {};
  const Point2 origin = polygon.outer.front();
  Moments sum;
  const auto add = [&](const Ring& ring, double sign) {
    const Moments moments = momentsOf(ring, origin);
    if (moments.area < 0.0) sign = -sign;
    sum = {sum.area + sign * moments.area, sum.x + sign * moments.x, sum.y + sign * moments.y};
  };
  add(polygon.outer, 1.0);
  for (const Ring& hole : polygon.holes) add(hole, -1.0);
  const double negligible = kOnBoundaryTolerance_m * length(polygon.outer);
  if (!(sum.area > negligible)) return meanOf(polygon.outer);
  return {origin.x + sum.x / sum.area, origin.y + sum.y / sum.area};
}

Bounds2 bounds(const Polygon& polygon) {
  Bounds2 box{polygon.outer.front(), polygon.outer.front()};
  for (const Point2& point : polygon.outer) {
    box.min = {std::min(box.min.x, point.x), std::min(box.min.y, point.y)};
    box.max = {std::max(box.max.x, point.x), std::max(box.max.y, point.y)};
  }
  return box;
}

Ring convexHull(const Ring& points) {
  Ring sorted = points;
  const auto less = [](const Point2& a, const Point2& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  std::sort(sorted.begin(), sorted.end(), less);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  const auto halfHull = [](auto first, auto last) {
    Ring hull;
    for (auto point = first; point != last; ++point) {
      while (hull.size() >= 2) {
        const Point2& before = hull[hull.size() - 2];
        const double straight = kOnBoundaryTolerance_m * distance(before, *point);
        if (cross(before, hull.back(), *point) > straight) break;
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    hull.pop_back();  // the first of the other half
    return hull;
  };
  Ring hull = halfHull(sorted.cbegin(), sorted.cend());
  const Ring upper = halfHull(sorted.crbegin(), sorted.crend());
  hull.insert(hull.end(), upper.begin(), upper.end());
  return hull;
}

bool contains(const Polygon& polygon, const Point2& point) {
  constexpr double kSquaredTolerance = kOnBoundaryTolerance_m * kOnBoundaryTolerance_m;
  bool inside = false;
  const bool off_boundary = visitEdges(polygon, [&](const Segment2& edge) {
    if (squaredDistance(edge, point) <= kSquaredTolerance) return false;
    if ((edge.a.y > point.y) != (edge.b.y > point.y)) {
      const bool upwards = edge.b.y > edge.a.y;
      if ((cross(edge.a, edge.b, point) > 0.0) == upwards) inside = !inside;
    }
    return true;
  });
  return !off_boundary || inside;
}

double distance(const Polygon& polygon, const Point2& point) {
  return contains(polygon, point) ? 0.0 : boundaryDistance(polygon, point);
}

double distance(const Segment2& segment, const Point2& point) {
  return std::sqrt(squaredDistance(segment, point));
}

double boundaryDistance(const Polygon& polygon, const Point2& point) {
  double nearest = std::numeric_limits<double>::infinity();
  visitEdges(polygon, [&](const Segment2& edge) {
    nearest = std::min(nearest, squaredDistance(edge, point));
    return true;
  });
  return std::sqrt(nearest);
}

Polygon normalized(const Polygon& polygon) {
  Polygon result;
  result.outer = oriented(withoutSuperfluousVertices(polygon.outer), Turn::kCounterClockwise);
  if (result.outer.empty()) return {};
  for (const Ring& hole : polygon.holes) {
    Ring kept = oriented(withoutSuperfluousVertices(hole), Turn::kClockwise);
    if (!kept.empty()) result.holes.push_back(std::move(kept));
  }
  return result;
}

Polygon translated(const Polygon& polygon, double dx, double dy) {
  Polygon moved{translated(polygon.outer, dx, dy), {}};
  moved.holes.reserve(polygon.holes.size());
  for (const Ring& hole : polygon.holes) moved.holes.push_back(translated(hole, dx, dy));
  return moved;
}

}  // namespace occusg
