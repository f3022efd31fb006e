// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

/// Index of the first cell centre at or above `value` cells, kept within [low, high].
int firstCenterFrom(double value, int low, int high) {
  const double index = std::ceil(value - 0.5);
  return static_cast<int>(std::clamp(index, static_cast<double>(low), static_cast<double>(high)));
}

/// Where the rings of a polygon cross the middle of each row of a box, in cells.
class RowCrossings {
 public:
  explicit RowCrossings(const CellBox& box)
      : box_(box), rows_(static_cast<std::size_t>(box.height())) {}

  void add(const Ring& ring, const Point2& origin) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 a = inCells(ring[i], origin);
      const Point2 b = inCells(ring[i + 1 < ring.size() ? i + 1 : 0], origin);
      const int first = firstCenterFrom(std::min(a.y, b.y), box_.min.y, box_.max.y);
      const int last = firstCenterFrom(std::max(a.y, b.y), box_.min.y, box_.max.y);
      for (int y = first; y < last; ++y)
        row(y).push_back(a.x + (y + 0.5 - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }

  /// Adds one to every cell whose centre is inside.
  void countInto(Coverage& coverage) {
    for (int y = box_.min.y; y < box_.max.y; ++y) {
      std::vector<double>& crossings = row(y);
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const int end = firstCenterFrom(crossings[i + 1], box_.min.x, box_.max.x);
        for (int x = firstCenterFrom(crossings[i], box_.min.x, box_.max.x); x < end; ++x)
          ++coverage.at({x, y});
      }
      crossings.clear();
    }
  }

 private:
  [[nodiscard]] static Point2 inCells(const Point2& point, const Point2& origin) {
    return {(point.x - origin.x) / kAlignmentCell_m, (point.y - origin.y) / kAlignmentCell_m};
  }
  [[nodiscard]] std::vector<double>& row(int y) {
    return rows_[static_cast<std::size_t>(y - box_.min.y)];
  }

  CellBox box_;
  std::vector<std::vector<double>> rows_;
};

/// How many rooms cover each cell of `box`, counted from `origin`; cell centres decide.
Coverage coverageOf(const std::vector<EvaluatedRoom>& rooms, const Point2& origin,
                    const CellBox& box) {
  Coverage coverage(box, 0);
  RowCrossings crossings(box);
  for (const EvaluatedRoom& room : rooms) {
    for (const Polygon& part : room.parts) {
      crossings.add(part.outer, origin);
      for (const Ring& hole : part.holes) crossings.add(hole, origin);
      crossings.countInto(coverage);
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

/// The predicted rooms rastered once, against which starts are scored.
class ShiftSearch {
 public:
  explicit ShiftSearch(const std::vector<EvaluatedRoom>& predicted) {
    const Bounds2 box = boundsOf(predicted);
    const double width = std::floor((box.max.x - box.min.x) / kAlignmentCell_m) + 1.0;
    const double height = std::floor((box.max.y - box.min.y) / kAlignmentCell_m) + 1.0;
    if (!((width + 2 * kReach_cells) * (height + 2 * kReach_cells) <= kMaxAlignmentCells)) {
      throw refuse("predicted rooms",
                   "bounds of " + std::to_string(box.max.x - box.min.x) + " m by " +
                       std::to_string(box.max.y - box.min.y) + " m",
                   "must, with 10 m all round, be at most " +
                       std::to_string(kMaxAlignmentCells * kAlignmentCell_m * kAlignmentCell_m) +
                       " m2 to search an alignment");
    }
    origin_ = box.min;
    predicted_ = coverageOf(predicted, origin_,
                            {{0, 0}, {static_cast<int>(width), static_cast<int>(height)}});
  }

  /// The annotated rooms, moved by `start`, where the search can bring them under the predicted.
  [[nodiscard]] Coverage truthNear(const std::vector<EvaluatedRoom>& truth,
                                   const Point2& start) const {
    const Point2 moved_back{origin_.x - start.x, origin_.y - start.y};
    return coverageOf(truth, moved_back, predicted_.box().grown(kReach_cells));
  }

  [[nodiscard]] std::int64_t scoreAtStart(const Coverage& truth) const {
    return overlap(predicted_, truth, {0, 0});
  }

  [[nodiscard]] Point2 bestShift(const Coverage& truth) const {
    Cell best{0, 0};
    std::int64_t best_score = scoreAtStart(truth);
    const auto squared = [](const Cell& step) { return step.x * step.x + step.y * step.y; };
    for (int y = -kSteps; y <= kSteps; ++y) {
      for (int x = -kSteps; x <= kSteps; ++x) {
        const std::int64_t score =
            overlap(predicted_, truth, {x * kCellsPerStep, y * kCellsPerStep});
        const Cell step{x, y};
        const bool ties_shorter = score == best_score && squared(step) < squared(best);
        if (score < best_score || (score == best_score && !ties_shorter)) continue;
        best = step;
        best_score = score;
      }
    }
    return {best.x * kAlignmentStep_m, best.y * kAlignmentStep_m};
  }

 private:
  Point2 origin_;
  Coverage predicted_;
};

}  // namespace

Point2 alignmentShift(const std::vector<EvaluatedRoom>& predicted,
                      const std::vector<EvaluatedRoom>& truth, Alignment alignment,
                      const std::optional<Point2>& first_robot_position) {
  if (alignment == Alignment::kNone || predicted.empty() || truth.empty()) return {};
  const Point2 to = meanCentroid(predicted);
  const Point2 from = meanCentroid(truth);
  Point2 start{to.x - from.x, to.y - from.y};
  if (alignment == Alignment::kCentroid) return start;
  const ShiftSearch search(predicted);
  Coverage moved = search.truthNear(truth, start);
  if (first_robot_position) {
    const Point2 other{-first_robot_position->x, -first_robot_position->y};
    if (!std::isfinite(other.x) || !std::isfinite(other.y))
      throw refuse("first robot position", "not finite", "must be in metres of the map frame");
    Coverage moved_other = search.truthNear(truth, other);
    if (search.scoreAtStart(moved_other) >= search.scoreAtStart(moved)) {
      start = other;
      moved = std::move(moved_other);
    }
  }
  const Point2 shift = search.bestShift(moved);
  return {start.x + shift.x, start.y + shift.y};
}

}  // namespace occusg
