// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/geometry/grid.hpp"

namespace occusg {
namespace {

using Coverage = Grid<std::int32_t>;

constexpr int kCellsPerStep = 5;
static_assert(kCellsPerStep * kAlignmentCell_m == kAlignmentStep_m);
constexpr int kSteps = 20;
static_assert(kSteps * kAlignmentStep_m == kAlignmentRadius_m);
constexpr int kReach_cells = kSteps * kCellsPerStep;

Point2 meanCentroid(const std::vector<EvaluatedRoom>& rooms) {
  Point2 sum;
  for (const EvaluatedRoom& room : rooms) {
    const Point2 center = centroid(room);
    sum = {sum.x + center.x, sum.y + center.y};
  }
  const auto count = static_cast<double>(rooms.size());
  return {sum.x / count, sum.y / count};
}

Bounds2 boundsOf(const std::vector<EvaluatedRoom>& rooms) {
  Bounds2 all = bounds(rooms.front().parts.front());
  for (const EvaluatedRoom& room : rooms) {
    for (const Polygon& part : room.parts) {
      const Bounds2 box = bounds(part);
      all.min = {std::min(all.min.x, box.min.x), std::min(all.min.y, box.min.y)};
      all.max = {std::max(all.max.x, box.max.x), std::max(all.max.y, box.max.y)};
    }
  }
  return all;
}

/// Bits of sub-cell precision in which vertices are handed to the painter.
constexpr int kShift = 4;
/// Cells beyond which a vertex is pulled in: far outside every box, and no overflow.
constexpr double kFarthest_cells = 1e6;

/// A ring in sub-cells from the lower left cell of `box`, cell centres at whole numbers. The
/// lattice begins at `origin`.
std::vector<cv::Point> paintable(const Ring& ring, const Point2& origin, const CellBox& box) {
  constexpr double kPerCell = 1 << kShift;
  const auto toSubcells = [&](double value, double start, int first) {
    const double cells =
        std::clamp((value - start) / kAlignmentCell_m - 0.5, -kFarthest_cells, kFarthest_cells);
    return static_cast<int>(std::nearbyint(cells * kPerCell)) - first * (1 << kShift);
  };
  std::vector<cv::Point> points;
  points.reserve(ring.size());
  for (const Point2& point : ring) {
    points.emplace_back(toSubcells(point.x, origin.x, box.min.x),
                        toSubcells(point.y, origin.y, box.min.y));
  }
  return points;
}

/// How many rooms cover each cell of `box`, counted from `origin`; cells an outline passes through
/// are covered.
Coverage coverageOf(const std::vector<EvaluatedRoom>& rooms, const Point2& origin,
                    const CellBox& box) {
  Coverage coverage(box, 0);
  cv::Mat painted(box.height(), box.width(), CV_8UC1);
  for (const EvaluatedRoom& room : rooms) {
    for (const Polygon& part : room.parts) {
      std::vector<std::vector<cv::Point>> rings{paintable(part.outer, origin, box)};
      for (const Ring& hole : part.holes) rings.push_back(paintable(hole, origin, box));
      painted.setTo(0);
      cv::fillPoly(painted, rings, 1, cv::LINE_8, kShift);
      std::transform(painted.begin<std::uint8_t>(), painted.end<std::uint8_t>(),
                     coverage.values().begin(), coverage.values().begin(), std::plus<>());
    }
  }
  return coverage;
}

/// Sum over all cells of predicted times annotated coverage, the latter moved by `shift` cells.
std::int64_t overlap(const Coverage& predicted, const Coverage& truth, const Cell& shift) {
  const CellBox& box = truth.box();
  const CellBox common = predicted.box().intersected(
      {{box.min.x + shift.x, box.min.y + shift.y}, {box.max.x + shift.x, box.max.y + shift.y}});
  std::int64_t sum = 0;
  for (int y = common.min.y; y < common.max.y; ++y) {
    const std::int32_t* p = &predicted.at({common.min.x, y});
    const std::int32_t* t = &truth.at({common.min.x - shift.x, y - shift.y});
    for (int i = 0; i < common.width(); ++i) sum += static_cast<std::int64_t>(p[i]) * t[i];
  }
  return sum;
}

/// Both sides rastered with the annotated rooms at one start.
struct Rastered {
  Point2 start;
  Coverage predicted;
  Coverage truth;

  [[nodiscard]] std::int64_t scoreAtStart() const { return overlap(predicted, truth, {0, 0}); }
};

void requireSearchable(const Bounds2& box) {
  const double width = std::floor((box.max.x - box.min.x) / kAlignmentCell_m) + 2.0;
  const double height = std::floor((box.max.y - box.min.y) / kAlignmentCell_m) + 2.0;
  if ((width + 2 * kReach_cells) * (height + 2 * kReach_cells) <= kMaxAlignmentCells) return;
  throw refuse("predicted rooms",
               "bounds of " + std::to_string(box.max.x - box.min.x) + " m by " +
                   std::to_string(box.max.y - box.min.y) + " m",
               "must, with 10 m all round, be at most " +
                   std::to_string(kMaxAlignmentCells * kAlignmentCell_m * kAlignmentCell_m) +
                   " m2 to search an alignment");
}

/// The lattice begins at the lower left of all rooms, one step more than the radius away.
Rastered rasteredAt(const Point2& start, const std::vector<EvaluatedRoom>& predicted,
                    const std::vector<EvaluatedRoom>& truth) {
  std::vector<EvaluatedRoom> moved;
  moved.reserve(truth.size());
  for (const EvaluatedRoom& room : truth) moved.push_back(translated(room, start));
  const Bounds2 of_predicted = boundsOf(predicted);
  const Bounds2 of_truth = boundsOf(moved);
  constexpr double kPadding_m = kAlignmentRadius_m + kAlignmentStep_m;
  // Rooms out of reach may lie anywhere; the lattice then need not begin with them.
  const auto low = [](double p, double t) {
    return (t < p && t > p - kFarthest_cells * kAlignmentCell_m / 2.0 ? t : p) - kPadding_m;
  };
  const Point2 origin{low(of_predicted.min.x, of_truth.min.x),
                      low(of_predicted.min.y, of_truth.min.y)};
  const auto cell = [](double value, double from) {
    return static_cast<int>(std::floor((value - from) / kAlignmentCell_m));
  };
  // A cell more all round: outlines are painted, too.
  const CellBox box = CellBox{
      {cell(of_predicted.min.x, origin.x), cell(of_predicted.min.y, origin.y)},
      {cell(of_predicted.max.x, origin.x) + 1,
       cell(of_predicted.max.y, origin.y) +
           1}}.grown(1);
  return {start, coverageOf(predicted, origin, box),
          coverageOf(moved, origin, box.grown(kReach_cells))};
}

/// Of the lattice of steps from the start.
Point2 bestStep(const Rastered& rastered) {
  Cell best{0, 0};
  std::int64_t best_score = rastered.scoreAtStart();
  const auto squared = [](const Cell& step) { return step.x * step.x + step.y * step.y; };
  for (int y = -kSteps; y <= kSteps; ++y) {
    for (int x = -kSteps; x <= kSteps; ++x) {
      const std::int64_t score =
          overlap(rastered.predicted, rastered.truth, {x * kCellsPerStep, y * kCellsPerStep});
      const Cell step{x, y};
      const bool ties_shorter = score == best_score && squared(step) < squared(best);
      if (score < best_score || (score == best_score && !ties_shorter)) continue;
      best = step;
      best_score = score;
    }
  }
  return {best.x * kAlignmentStep_m, best.y * kAlignmentStep_m};
}

}  // namespace

Point2 alignmentShift(const std::vector<EvaluatedRoom>& predicted,
                      const std::vector<EvaluatedRoom>& truth, Alignment alignment,
                      const std::optional<Point2>& first_robot_position) {
  if (alignment == Alignment::kNone || predicted.empty() || truth.empty()) return {};
  const Point2 to = meanCentroid(predicted);
  const Point2 from = meanCentroid(truth);
  Point2 start{to.x - from.x, to.y - from.y};
  if (alignment == Alignment::kCentroid) return start;
  requireSearchable(boundsOf(predicted));
  Rastered rastered = rasteredAt(start, predicted, truth);
  if (first_robot_position) {
    const Point2 other{-first_robot_position->x, -first_robot_position->y};
    if (!std::isfinite(other.x) || !std::isfinite(other.y))
      throw refuse("first robot position", "not finite", "must be in metres of the map frame");
    Rastered other_rastered = rasteredAt(other, predicted, truth);
    if (other_rastered.scoreAtStart() >= rastered.scoreAtStart())
      rastered = std::move(other_rastered);
  }
  const Point2 step = bestStep(rastered);
  return {rastered.start.x + step.x, rastered.start.y + step.y};
}

}  // namespace occusg
