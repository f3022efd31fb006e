// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_holes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "regions/dude_pockets.hpp"

namespace occusg {
namespace {

double distanceBetween(const Cell& a, const Cell& b) {
  return std::hypot(static_cast<double>(a.x - b.x), static_cast<double>(a.y - b.y));
}

CornerRing hullOf(const CornerRing& ring) {
  CornerRing hull;
  for (const std::size_t position : hullPositions(ring)) hull.push_back(ring[position]);
  return hull;
}

}  // namespace

std::int64_t signedCells(const CornerRing& ring) {
  std::int64_t twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Cell& a = ring[i];
    const Cell& b = ring[(i + 1) % ring.size()];
    twice += static_cast<std::int64_t>(a.x) * b.y - static_cast<std::int64_t>(b.x) * a.y;
  }
  return twice / 2;
}

DudeHole holeShape(const CornerRing& ring) {
  DudeHole shape;
  shape.area_cells = std::abs(signedCells(ring));
  const CornerRing hull = hullOf(ring);
  Cell end_a;
  Cell end_b;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      const double distance = distanceBetween(hull[i], hull[j]);
      if (distance <= shape.diameter_cells) continue;
      shape.diameter_cells = distance;
      end_a = hull[i];
      end_b = hull[j];
    }
  }
  for (const Cell& corner : hull)
    shape.width_cells = std::max(shape.width_cells, 2.0 * segmentDistance(end_a, end_b, corner));
  return shape;
}

std::vector<double> holeDepths(const CornerRing& ring) {
  const CornerRing hull = hullOf(ring);
  std::vector<double> depths;
  depths.reserve(ring.size());
  for (const Cell& corner : ring) {
    double depth = 0.0;
    for (const Cell& other : hull) depth = std::max(depth, distanceBetween(corner, other));
    depths.push_back(depth);
  }
  return depths;
}

void visitRing(const CornerRing& ring, const std::function<void(const Cell&)>& visit) {
  std::vector<Cell> walls;  // The cell right of every vertical edge, one a row.
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Cell& a = ring[i];
    const Cell& b = ring[(i + 1) % ring.size()];
    for (int y = std::min(a.y, b.y); y < std::max(a.y, b.y); ++y) walls.push_back({a.x, y});
  }
  std::sort(walls.begin(), walls.end());
  for (std::size_t i = 0; i + 1 < walls.size(); i += 2)
    for (int x = walls[i].x; x < walls[i + 1].x; ++x) visit({x, walls[i].y});
}

}  // namespace occusg
