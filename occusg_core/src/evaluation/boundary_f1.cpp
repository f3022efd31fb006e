// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/boundary_f1.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

#include "occusg/error.hpp"

namespace occusg {
namespace {

/// [m] A length of a whole number of steps gets that many points, and one at the tolerance counts.
constexpr double kRounding = 1e-9;

/// Of all parts: the outer ring, then the holes.
std::vector<const Ring*> ringsOf(const EvaluatedRoom& room) {
  std::vector<const Ring*> rings;
  for (const Polygon& part : room.parts) {
    rings.push_back(&part.outer);
    for (const Ring& hole : part.holes) rings.push_back(&hole);
  }
  return rings;
}

std::vector<Segment2> edgesOf(const EvaluatedRoom& room) {
  std::vector<Segment2> edges;
  for (const Ring* ring : ringsOf(room)) {
    const std::vector<Segment2> more = edgesOf(*ring);
    edges.insert(edges.end(), more.begin(), more.end());
  }
  return edges;
}

/// Pairwise summation in blocks of eight, whose rounding error does not grow with the number of
/// edges (Higham, Accuracy and Stability of Numerical Algorithms, Sec. 4.2). NumPy sums in this
/// very order: where a boundary is a whole number of steps long, the last bit of its length decides
/// on which ring a point at the end of one falls, and both are to find the same.
double pairwiseSum(const double* values, std::size_t count) {
  constexpr std::size_t kLanes = 8;
  constexpr std::size_t kLongestBlock = 128;
  if (count < kLanes) return std::accumulate(values, values + count, 0.0);
  if (count > kLongestBlock) {
    const std::size_t half = count / 2 / kLanes * kLanes;
    return pairwiseSum(values, half) + pairwiseSum(values + half, count - half);
  }
  std::array<double, kLanes> sums{};
  const std::size_t whole = count / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; ++i) sums[i % kLanes] += values[i];
  const double sum =
      ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
  return std::accumulate(values + whole, values + count, sum);
}

double exactLength(const Ring& ring) {
  const std::vector<Segment2> edges = edgesOf(ring);
  std::vector<double> lengths;
  lengths.reserve(edges.size());
  for (const Segment2& edge : edges) lengths.push_back(length(edge));
  return pairwiseSum(lengths.data(), lengths.size());
}

/// Appends the samples of one ring, of which those before `samples.size()` are on earlier rings.
/// @param start length of all rings before; moved to the ring's end.
void sampleRing(const Ring& ring, double spacing, std::size_t count, double& start,
                std::vector<Point2>& samples) {
  const std::vector<Segment2> edges = edgesOf(ring);
  const double end = start + length(ring);
  auto edge = edges.begin();
  double before_edge = 0.0;
  while (samples.size() < count) {
    const double target = static_cast<double>(samples.size()) * spacing;
    if (target >= end) break;
    const double along = target - start;
    while (edge + 1 != edges.end() && along >= before_edge + length(*edge)) {
      before_edge += length(*edge);
      ++edge;
    }
    const double edge_length = length(*edge);
    const double t = edge_length > 0.0 ? std::min(1.0, (along - before_edge) / edge_length) : 0.0;
    samples.push_back(
        {edge->a.x + t * (edge->b.x - edge->a.x), edge->a.y + t * (edge->b.y - edge->a.y)});
  }
  start = end;
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
  const std::vector<const Ring*> rings = ringsOf(room);
  double total = 0.0;
  for (const Ring* ring : rings) total += exactLength(*ring);
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
  for (const Ring* ring : rings) sampleRing(*ring, spacing, count, start, samples);
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
