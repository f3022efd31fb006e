// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometry.hpp>  // The index alone does not compile with Boost 1.83 (Debian 13).
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "occusg/geometry/polygon.hpp"

namespace occusg {
namespace {

namespace bg = boost::geometry;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using ExactPoint = Kernel::Point_2;
using ExactRing = CGAL::Polygon_2<Kernel>;

/// Edge `index` of ring `ring`, from vertex `index` to the next.
struct Edge {
  std::size_t ring;
  std::size_t index;
};
using Corner = bg::model::point<double, 2, bg::cs::cartesian>;
using EdgeBox = std::pair<bg::model::box<Corner>, std::size_t>;  ///< And the number of the edge.

bool isUsable(const Ring& ring) {
  return ring.size() >= 3 && std::all_of(ring.begin(), ring.end(), [](const Point2& point) {
           return std::isfinite(point.x) && std::isfinite(point.y);
         });
}

ExactRing exactRing(const Ring& ring) {
  ExactRing exact;
  for (const Point2& point : ring) exact.push_back(ExactPoint(point.x, point.y));
  return exact;
}

const ExactPoint& vertexAt(const ExactRing& ring, std::size_t index) {
  return ring[index % ring.size()];
}

/// The way a ring takes through one of its points.
struct Passage {
  ExactPoint before;
  ExactPoint through;
  ExactPoint after;
};

/// True when `point` is left of the path. @pre it is not on it.
bool isLeft(const Passage& path, const ExactPoint& point) {
  const bool left_of_first = CGAL::left_turn(path.before, path.through, point);
  const bool left_of_second = CGAL::left_turn(path.through, path.after, point);
  return CGAL::left_turn(path.before, path.through, path.after) ? left_of_first && left_of_second
                                                                : left_of_first || left_of_second;
}

/// The passage of `ring` through `point`, which lies on its edge `index`.
Passage passageThrough(const ExactRing& ring, std::size_t index, const ExactPoint& point) {
  const std::size_t size = ring.size();
  if (point == vertexAt(ring, index))
    return {vertexAt(ring, index + size - 1), point, vertexAt(ring, index + 1)};
  if (point == vertexAt(ring, index + 1))
    return {vertexAt(ring, index), point, vertexAt(ring, index + 2)};
  return {vertexAt(ring, index), point, vertexAt(ring, index + 1)};
}

/// True when ring `b` changes sides of ring `a` where the start of edge `i` of `a` lies on edge
/// `j`.
bool crossAtStart(const ExactRing& a, std::size_t i, const ExactRing& b, std::size_t j) {
  const ExactPoint& point = vertexAt(a, i);
  if (!Kernel::Segment_2(vertexAt(b, j), vertexAt(b, j + 1)).has_on(point)) return false;
  const Passage other = passageThrough(b, j, point);
  const Passage own = passageThrough(a, i, point);
  return isLeft(own, other.before) != isLeft(own, other.after);
}

/// True when two edges cross, overlap along a line, or touch where their rings cross.
bool edgesConflict(const ExactRing& a, std::size_t i, const ExactRing& b, std::size_t j) {
  const ExactPoint& p = vertexAt(a, i);
  const ExactPoint& q = vertexAt(a, i + 1);
  const ExactPoint& r = vertexAt(b, j);
  const ExactPoint& s = vertexAt(b, j + 1);
  const int side_r = CGAL::orientation(p, q, r);
  const int side_s = CGAL::orientation(p, q, s);
  if (side_r == 0 && side_s == 0)
    return std::max(std::min(p, q), std::min(r, s)) < std::min(std::max(p, q), std::max(r, s));
  const int side_p = CGAL::orientation(r, s, p);
  const int side_q = CGAL::orientation(r, s, q);
  if (side_r * side_s > 0 || side_p * side_q > 0) return false;
  if (side_r * side_s < 0 && side_p * side_q < 0) return true;
  return crossAtStart(a, i, b, j) || crossAtStart(b, j, a, i);
}

bool ringsConflict(const std::vector<ExactRing>& rings) {
  std::vector<Edge> edges;
  for (std::size_t ring = 0; ring < rings.size(); ++ring)
    for (std::size_t i = 0; i < rings[ring].size(); ++i) edges.push_back({ring, i});
  std::vector<EdgeBox> boxes;
  boxes.reserve(edges.size());
  for (const Edge& edge : edges) {
    const ExactPoint& a = vertexAt(rings[edge.ring], edge.index);
    const ExactPoint& b = vertexAt(rings[edge.ring], edge.index + 1);
    const auto [low_x, high_x] = std::minmax({a.x(), b.x()});
    const auto [low_y, high_y] = std::minmax({a.y(), b.y()});
    boxes.emplace_back(bg::model::box<Corner>({low_x, low_y}, {high_x, high_y}), boxes.size());
  }
  constexpr std::size_t kNodeSize = 16;
  const bg::index::rtree<EdgeBox, bg::index::rstar<kNodeSize>> index(boxes);
  for (const EdgeBox& box : boxes) {
    const Edge& a = edges[box.second];
    for (auto other = index.qbegin(bg::index::intersects(box.first)); other != index.qend();
         ++other) {
      const Edge& b = edges[other->second];
      if (a.ring >= b.ring) continue;  // each pair once, and rings are simple by themselves
      if (edgesConflict(rings[a.ring], a.index, rings[b.ring], b.index)) return true;
    }
  }
  return false;
}

/// Side of `container` the ring lies on. @pre the two do not cross.
bool isInside(const ExactRing& ring, const ExactRing& container) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!container.has_on_boundary(ring[i])) return container.has_on_bounded_side(ring[i]);
  // Every vertex touches: no edge does beyond its ends, so its middle tells.
  return container.has_on_bounded_side(CGAL::midpoint(ring[0], ring[1]));
}

}  // namespace

bool isSimple(const Polygon& polygon) {
  if (!isUsable(polygon.outer)) return false;
  if (!std::all_of(polygon.holes.begin(), polygon.holes.end(), isUsable)) return false;
  std::vector<ExactRing> rings{exactRing(polygon.outer)};
  for (const Ring& hole : polygon.holes) rings.push_back(exactRing(hole));
  for (const ExactRing& ring : rings)
    if (!ring.is_simple()) return false;
  if (rings.size() == 1) return true;
  if (ringsConflict(rings)) return false;
  for (std::size_t i = 1; i < rings.size(); ++i) {
    if (!isInside(rings[i], rings.front())) return false;
    for (std::size_t j = 1; j < rings.size(); ++j)
      if (i != j && isInside(rings[i], rings[j])) return false;
  }
  return true;
}

}  // namespace occusg
