// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_pockets.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace occusg {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// The corners first .. last of a ring, which may run past its end.
CornerRing chainOf(const CornerRing& ring, std::size_t first, std::size_t last) {
  CornerRing chain;
  chain.reserve(last - first + 1);
  for (std::size_t i = first; i <= last; ++i) chain.push_back(ring[i % ring.size()]);
  return chain;
}

double greatestDepth(const CornerRing& chain) {
  double depth = 0.0;
  for (const Cell& corner : chain)
    depth = std::max(depth, segmentDistance(chain.front(), chain.back(), corner));
  return depth;
}

/// The hull edges of a whole ring.
std::vector<DudeBridge> hullBridges(const CornerRing& ring) {
  std::vector<DudeBridge> bridges;
  const std::vector<std::size_t> hull = hullPositions(ring);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const bool is_last = i + 1 == hull.size();
    const std::size_t next = is_last ? hull.front() + ring.size() : hull[i + 1];
    if (next > hull[i] + 1) bridges.push_back({hull[i], next, -1, 0});
  }
  return bridges;
}

/// The hull edges of one pocket, its own bridge left out.
std::vector<DudeBridge> bridgesWithin(const CornerRing& chain, const DudeBridge& pocket,
                                      int pocket_index) {
  std::vector<DudeBridge> bridges;
  const std::vector<std::size_t> hull = hullPositions(chain);
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    if (hull[i + 1] == hull[i] + 1) continue;
    if (hull[i] == 0 && hull[i + 1] + 1 == chain.size()) continue;
    bridges.push_back(
        {pocket.first + hull[i], pocket.first + hull[i + 1], pocket_index, pocket.level + 1});
  }
  return bridges;
}

}  // namespace

double segmentDistance(const Cell& a, const Cell& b, const Cell& point) {
  const double along_x = b.x - a.x;
  const double along_y = b.y - a.y;
  const double to_x = point.x - a.x;
  const double to_y = point.y - a.y;
  const double length2 = along_x * along_x + along_y * along_y;
  const double projected = to_x * along_x + to_y * along_y;
  if (projected <= 0.0) return std::hypot(to_x, to_y);
  if (projected >= length2) return std::hypot(to_x - along_x, to_y - along_y);
  return std::abs(along_x * to_y - along_y * to_x) / std::sqrt(length2);
}

std::vector<std::size_t> hullPositions(const CornerRing& ring) {
  std::vector<Kernel::Point_2> points;
  points.reserve(ring.size());
  for (const Cell& corner : ring) points.emplace_back(corner.x, corner.y);
  std::vector<Kernel::Point_2> hull;
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  std::sort(hull.begin(), hull.end());
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::binary_search(hull.begin(), hull.end(), points[i])) positions.push_back(i);
  return positions;
}

std::vector<DudeBridge> pocketTree(const CornerRing& ring, double min_depth_cells, int max_levels) {
  std::vector<DudeBridge> tree;
  std::vector<DudeBridge> found = hullBridges(ring);
  std::size_t next = 0;
  while (true) {
    for (const DudeBridge& bridge : found) {
      if (greatestDepth(chainOf(ring, bridge.first, bridge.last)) >= min_depth_cells)
        tree.push_back(bridge);
    }
    while (next < tree.size() && tree[next].level + 1 >= max_levels) ++next;
    if (next == tree.size()) return tree;
    const CornerRing chain = chainOf(ring, tree[next].first, tree[next].last);
    found = bridgesWithin(chain, tree[next], static_cast<int>(next));
    ++next;
  }
}

std::vector<double> pocketDepths(const CornerRing& ring) {
  std::vector<double> depths(ring.size(), 0.0);
  for (const DudeBridge& bridge : hullBridges(ring)) {
    const Cell& a = ring[bridge.first % ring.size()];
    const Cell& b = ring[bridge.last % ring.size()];
    for (std::size_t i = bridge.first + 1; i < bridge.last; ++i)
      depths[i % ring.size()] = segmentDistance(a, b, ring[i % ring.size()]);
  }
  return depths;
}

}  // namespace occusg
