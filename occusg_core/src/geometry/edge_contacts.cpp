// SPDX-License-Identifier: BSD-3-Clause
#include "edge_contacts.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace occusg {
namespace {

using ClipperLib::cInt;
using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

/// Pairs of edges that may be compared, about a second's work.
constexpr std::size_t kMaxComparisons = 200'000'000;

struct LatticeEdge {
  IntPoint from;
  IntPoint to;
  cInt low_y;
  cInt high_y;
  cInt low_x;
  cInt high_x;
  std::size_t path;
  std::size_t number;  ///< In its path.
};

std::vector<LatticeEdge> edgesFromLeftToRight(const Paths& paths) {
  std::vector<LatticeEdge> edges;
  for (std::size_t path = 0; path < paths.size(); ++path) {
    const Path& points = paths[path];
    for (std::size_t i = 0; i < points.size(); ++i) {
      const IntPoint& a = points[i];
      const IntPoint& b = points[(i + 1) % points.size()];
      edges.push_back({a, b, std::min(a.Y, b.Y), std::max(a.Y, b.Y), std::min(a.X, b.X),
                       std::max(a.X, b.X), path, i});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const LatticeEdge& a, const LatticeEdge& b) { return a.low_x < b.low_x; });
  return edges;
}

bool areNeighbours(const LatticeEdge& a, const LatticeEdge& b, const Paths& paths) {
  if (a.path != b.path) return false;
  const std::size_t size = paths[a.path].size();
  return (a.number + 1) % size == b.number || (b.number + 1) % size == a.number;
}

/// Side of the line through `edge` on which `point` lies: -1, 0 or 1. Rounded, which a limit on a
/// number of crossings forgives.
int sideOf(const LatticeEdge& edge, const IntPoint& point) {
  const auto dx = static_cast<double>(edge.to.X - edge.from.X);
  const auto dy = static_cast<double>(edge.to.Y - edge.from.Y);
  const double cross = dx * static_cast<double>(point.Y - edge.from.Y) -
                       dy * static_cast<double>(point.X - edge.from.X);
  return (cross > 0.0 ? 1 : 0) - (cross < 0.0 ? 1 : 0);
}

bool meet(const LatticeEdge& a, const LatticeEdge& b) {
  return a.low_y <= b.high_y && b.low_y <= a.high_y && sideOf(a, b.from) * sideOf(a, b.to) <= 0 &&
         sideOf(b, a.from) * sideOf(b, a.to) <= 0;
}

}  // namespace

bool hasMoreContactsThan(std::size_t limit, const Paths& paths) {
  std::size_t count = 0;
  for (const Path& path : paths) count += path.size();
  if (count * count / 2 <= limit) return false;  // not so many pairs
  const std::vector<LatticeEdge> edges = edgesFromLeftToRight(paths);
  std::size_t contacts = 0;
  std::size_t comparisons = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size() && edges[j].low_x <= edges[i].high_x; ++j) {
      if (++comparisons > kMaxComparisons) return true;
      if (!meet(edges[i], edges[j]) || areNeighbours(edges[i], edges[j], paths)) continue;
      if (++contacts > limit) return true;
    }
  }
  return false;
}

}  // namespace occusg
