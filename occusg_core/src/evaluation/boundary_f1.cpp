// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/boundary_f1.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "occusg/error.hpp"

namespace occusg {
namespace {

/// [m] So that rounding decides nothing: a length of a whole number of steps gets that many points,
/// a point at the end of a ring belongs to the next, and one at the tolerance counts.
constexpr double kRounding = 1e-9;

void appendEdges(const Ring& ring, std::vector<Segment2>& edges) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    edges.push_back({ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]});
}

std::vector<Segment2> edgesOf(const EvaluatedRoom& room) {
  std::vector<Segment2> edges;
  for (const Polygon& part : room.parts) {
    appendEdges(part.outer, edges);
    for (const Ring& hole : part.holes) appendEdges(hole, edges);
  }
  return edges;
}

/// Share of `points` within `tolerance_m` of an edge.
double shareNear(const std::vector<Point2>& points, const std::vector<Segment2>& edges,
                 double tolerance_m) {
  if (points.empty()) return 0.0;
  const auto isNear = [&](const Segment2& edge, const Point2& point) {
    return distance(edge, point) <= tolerance_m + kRounding;
  };
  std::size_t near = 0;
  std::size_t last = 0;  // neighbouring points are mostly near the same edge
  for (const Point2& point : points) {
    if (last < edges.size() && isNear(edges[last], point)) {
      ++near;
      continue;
    }
    const auto hit = std::find_if(edges.begin(), edges.end(),
                                  [&](const Segment2& edge) { return isNear(edge, point); });
    if (hit == edges.end()) continue;
    last = static_cast<std::size_t>(hit - edges.begin());
    ++near;
  }
  return static_cast<double>(near) / static_cast<double>(points.size());
}

}  // namespace

std::vector<Point2> boundarySamples(const EvaluatedRoom& room, double step_m) {
  if (!(step_m > 0.0))
    throw refuse("boundary step", std::to_string(step_m) + " m", "must be greater than 0");
  const std::vector<Segment2> edges = edgesOf(room);
  double total = 0.0;
  for (const Segment2& edge : edges) total += length(edge);
  if (!(total > 0.0)) return {};
  const double wanted = std::max(1.0, std::ceil(total / step_m - kRounding));
  if (!(wanted <= kMaxBoundarySamples)) {
    throw refuse(
        "room " + std::to_string(room.id),
        "boundary of " + std::to_string(total) + " m in steps of " + std::to_string(step_m) + " m",
        "must not need more than " + std::to_string(kMaxBoundarySamples) + " points");
  }
  const auto count = static_cast<std::size_t>(wanted);
  const double spacing = total / wanted;
  std::vector<Point2> samples;
  samples.reserve(count);
  double start = 0.0;
  for (const Segment2& edge : edges) {
    const double edge_length = length(edge);
    while (samples.size() < count) {
      const double along = static_cast<double>(samples.size()) * spacing - start;
      if (along >= edge_length - kRounding) break;
      const double t = along / edge_length;
      samples.push_back(
          {edge.a.x + t * (edge.b.x - edge.a.x), edge.a.y + t * (edge.b.y - edge.a.y)});
    }
    start += edge_length;
  }
  return samples;
}

double boundaryF1(const EvaluatedRoom& predicted, const EvaluatedRoom& truth, double tolerance_m,
                  double step_m) {
  const double precision =
      shareNear(boundarySamples(predicted, step_m), edgesOf(truth), tolerance_m);
  const double recall = shareNear(boundarySamples(truth, step_m), edgesOf(predicted), tolerance_m);
  const double sum = precision + recall;
  return sum > 0.0 ? 2.0 * precision * recall / sum : 0.0;
}

}  // namespace occusg
