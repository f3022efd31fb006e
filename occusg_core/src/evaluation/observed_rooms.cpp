// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/observed_rooms.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace occusg {
namespace {

bool wasSeen(const SeenFloor& floor, const Point2& point) {
  const double x = std::floor((point.x - floor.offset.x) / floor.frame.resolution_m);
  const double y = std::floor((point.y - floor.offset.y) / floor.frame.resolution_m);
  const CellBox& box = floor.seen.box();
  if (x < box.min.x || x >= box.max.x || y < box.min.y || y >= box.max.y) return false;
  return floor.seen.at({static_cast<int>(x), static_cast<int>(y)}) != 0;
}

/// How many of the lattice points within a polygon were seen.
struct SeenCount {
  double inside = 0.0;
  double seen = 0.0;
};

void countInto(SeenCount& count, const Polygon& part, const SeenFloor& floor, double step_m) {
  const Bounds2 box = bounds(part);
  const auto first = [step_m](double low, double offset) {
    return offset + (std::floor((low - offset) / step_m) + 0.5) * step_m;
  };
  for (double y = first(box.min.y, floor.offset.y); y < box.max.y; y += step_m) {
    for (double x = first(box.min.x, floor.offset.x); x < box.max.x; x += step_m) {
      if (!contains(part, {x, y})) continue;
      count.inside += 1.0;
      if (wasSeen(floor, {x, y})) count.seen += 1.0;
    }
  }
}

double boxArea(const Polygon& part) {
  const Bounds2 box = bounds(part);
  return (box.max.x - box.min.x) * (box.max.y - box.min.y);
}

}  // namespace

double observedShare(const EvaluatedRoom& room, const SeenFloor& floor) {
  if (floor.seen.empty() || room.parts.empty()) return 0.0;
  SeenCount count;
  for (const Polygon& part : room.parts) {
    const double coarsest_m = std::sqrt(boxArea(part) / kMaxObservedCells);
    countInto(count, part, floor, std::max(floor.frame.resolution_m, coarsest_m));
  }
  if (count.inside > 0.0) return count.seen / count.inside;
  return wasSeen(floor, centroid(room)) ? 1.0 : 0.0;
}

std::vector<EvaluatedRoom> observedRooms(const std::vector<EvaluatedRoom>& truth,
                                         const SeenFloor& floor) {
  std::vector<EvaluatedRoom> observed;
  std::copy_if(
      truth.begin(), truth.end(), std::back_inserter(observed),
      [&floor](const EvaluatedRoom& room) { return observedShare(room, floor) >= kObservedShare; });
  return observed;
}

}  // namespace occusg
