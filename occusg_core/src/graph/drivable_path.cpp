// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/drivable_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <set>
#include <tuple>

#include "mapping/cells_on_line.hpp"
#include "occusg/error.hpp"
#include "occusg/geometry/grid.hpp"
#include "regions/squared_distance.hpp"

namespace occusg {
namespace {

constexpr int kNoArea = 0;
constexpr std::array<Cell, 4> kSides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
constexpr std::array<Cell, 4> kCorners = {{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

std::string inMetres(double value_m) {
  std::array<char, 32> text{};
  (void)std::snprintf(text.data(), text.size(), "%.2f", value_m);
  return text.data();
}

Grid<std::int32_t> squaredClearances(const FreeSpace& layer) {
  const Grid<std::int8_t> cells = layer.cells.dense();
  Grid<std::uint8_t> open(cells.box(), 0);
  std::transform(cells.values().begin(), cells.values().end(), open.values().begin(),
                 [](std::int8_t value) -> std::uint8_t { return value == kFree ? 1 : 0; });
  return squaredDistances(open);
}

/// Where a disc of the robot's radius may have its centre.
class Places {
 public:
  Places(const Grid<std::int32_t>& clearances, const GridFrame& frame, double radius_m)
      : frame_(frame), areas_(clearances.box(), kNoArea), allowed_(clearances.box(), 0) {
    // To the border of the nearest closed cell, half a cell nearer than its middle.
    const double reach = radius_m / frame.resolution_m + 0.5;
    const double smallest = std::max(1.0, reach * reach);
    std::transform(clearances.values().begin(), clearances.values().end(),
                   allowed_.values().begin(), [smallest](std::int32_t squared) -> std::uint8_t {
                     return static_cast<double>(squared) >= smallest ? 1 : 0;
                   });
    label();
  }

  [[nodiscard]] bool allows(const Cell& cell) const {
    return allowed_.valueOr(cell, std::uint8_t{0}) != 0;
  }
  [[nodiscard]] const GridFrame& frame() const { return frame_; }

  /// The cell nearest to the end's point in each connected area of its polygon, by area.
  struct Nearest {
    int area = kNoArea;
    double distance_m = 0.0;
    Cell cell;
  };
  [[nodiscard]] std::vector<Nearest> nearestTo(const PathEnd& end) const {
    std::vector<Nearest> best(static_cast<std::size_t>(area_count_) + 1);
    const CellBox box = boxOf(end.within).intersected(allowed_.box());
    for (int y = box.min.y; y < box.max.y; ++y) {
      for (int x = box.min.x; x < box.max.x; ++x) {
        const int area = areas_.at({x, y});
        if (area == kNoArea) continue;
        const Point2 center = frame_.center({x, y});
        Nearest& known = best[static_cast<std::size_t>(area)];
        const double away_m = distance(center, end.point);
        if (known.area != kNoArea && away_m >= known.distance_m) continue;
        if (contains(end.within, center)) known = {area, away_m, {x, y}};
      }
    }
    best.erase(std::remove_if(best.begin(), best.end(),
                              [](const Nearest& entry) { return entry.area == kNoArea; }),
               best.end());
    return best;
  }

  /// Calls `visit(neighbour, cells)` for each neighbour that can be stepped to.
  template <typename Visit>
  void forEachStep(const Cell& cell, const Visit& visit) const {
    for (const Cell& side : kSides) {
      const Cell next{cell.x + side.x, cell.y + side.y};
      if (allows(next)) visit(next, 1.0);
    }
    for (const Cell& corner : kCorners) {
      const Cell next{cell.x + corner.x, cell.y + corner.y};
      const bool is_clear = allows(next) && allows({next.x, cell.y}) && allows({cell.x, next.y});
      if (is_clear) visit(next, std::sqrt(2.0));
    }
  }

 private:
  [[nodiscard]] CellBox boxOf(const Polygon& polygon) const {
    CellBox box;
    for (const Point2& point : polygon.outer) {
      const Cell cell = frame_.cellAt(point);
      box = box.including({cell, {cell.x + 1, cell.y + 1}});
    }
    return box;
  }

  void label() {
    std::vector<Cell> open;
    const CellBox& box = areas_.box();
    for (int y = box.min.y; y < box.max.y; ++y) {
      for (int x = box.min.x; x < box.max.x; ++x) {
        if (!allows({x, y}) || areas_.at({x, y}) != kNoArea) continue;
        areas_.at({x, y}) = ++area_count_;
        open.push_back({x, y});
        while (!open.empty()) {
          const Cell at = open.back();
          open.pop_back();
          for (const Cell& side : kSides) {
            const Cell next{at.x + side.x, at.y + side.y};
            if (!allows(next) || areas_.at(next) != kNoArea) continue;
            areas_.at(next) = area_count_;
            open.push_back(next);
          }
        }
      }
    }
  }

  GridFrame frame_;
  Grid<int> areas_;  ///< Cells with one number can be driven between.
  Grid<std::uint8_t> allowed_;
  int area_count_ = 0;
};

struct Ends {
  Cell from;
  Cell to;
};

/// The nearest places of the two ends from one of which the other can be reached.
std::optional<Ends> endsIn(const std::vector<Places::Nearest>& from,
                           const std::vector<Places::Nearest>& to) {
  std::optional<Ends> best;
  double best_m = std::numeric_limits<double>::infinity();
  for (const Places::Nearest& a : from) {
    for (const Places::Nearest& b : to) {
      if (a.area != b.area || a.distance_m + b.distance_m >= best_m) continue;
      best_m = a.distance_m + b.distance_m;
      best = Ends{a.cell, b.cell};
    }
  }
  return best;
}

/// The cells of the shortest way between two cells of one area.
std::vector<Cell> shortestCells(const Places& places, const CellBox& box, const Ends& ends) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Grid<double> length(box, kFar);
  Grid<Cell> before(box, Cell{});
  const auto leastTo = [&](const Cell& cell) {
    return std::hypot(cell.x - ends.to.x, cell.y - ends.to.y);
  };
  using Open = std::tuple<double, int, int>;  // least possible length, y, x
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  length.at(ends.from) = 0.0;
  open.emplace(leastTo(ends.from), ends.from.y, ends.from.x);
  while (!open.empty()) {
    const auto [least, y, x] = open.top();
    open.pop();
    const Cell cell{x, y};
    if (cell == ends.to) break;
    if (least > length.at(cell) + leastTo(cell)) continue;
    places.forEachStep(cell, [&](const Cell& next, double step) {
      const double candidate = length.at(cell) + step;
      if (candidate >= length.at(next)) return;
      length.at(next) = candidate;
      before.at(next) = cell;
      open.emplace(candidate + leastTo(next), next.y, next.x);
    });
  }
  std::vector<Cell> cells = {ends.to};
  while (!(cells.back() == ends.from)) cells.push_back(before.at(cells.back()));
  std::reverse(cells.begin(), cells.end());
  return cells;
}

/// The corners that remain when the way is pulled straight.
std::vector<Point2> straightened(const Places& places, const std::vector<Cell>& cells) {
  const GridFrame& frame = places.frame();
  const auto isClear = [&](const Cell& a, const Cell& b) {
    return holdsOnLine(frame, frame.center(a), frame.center(b),
                       [&](const Cell& cell) { return places.allows(cell); });
  };
  std::vector<Point2> corners = {frame.center(cells.front())};
  std::size_t at = 0;
  while (at + 1 < cells.size()) {
    // The farthest cell that can be seen, looked for in steps that double and then halve.
    std::size_t seen = at + 1;
    for (std::size_t step = 1; seen + step < cells.size() && isClear(cells[at], cells[seen + step]);
         step *= 2)
      seen += step;
    for (std::size_t step = cells.size(); step > 0; step /= 2)
      if (seen + step < cells.size() && isClear(cells[at], cells[seen + step])) seen += step;
    corners.push_back(frame.center(cells[seen]));
    at = seen;
  }
  return corners;
}

DrivablePath spaced(const std::vector<Point2>& corners, double max_spacing_m) {
  DrivablePath path{{corners.front()}, 0.0};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Point2& a = corners[i - 1];
    const Point2& b = corners[i];
    const double length_m = distance(a, b);
    path.length_m += length_m;
    const int pieces = std::max(1, static_cast<int>(std::ceil(length_m / max_spacing_m)));
    for (int k = 1; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      path.points.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
    }
  }
  return path;
}

/// Why there is no way for the robot between two ends that both have a place for it.
Error tooNarrow(const Grid<std::int32_t>& clearances, const GridFrame& frame, const PathEnd& from,
                const PathEnd& to, double radius_m) {
  const std::string where = "path from " + from.name + " to " + to.name;
  const auto endsAt = [&](double radius) {
    const Places places(clearances, frame, radius);
    return endsIn(places.nearestTo(from), places.nearestTo(to));
  };
  if (!endsAt(0.0)) {
    return refuse(where, "no free space leads there", "the way has to be seen, by driving it once");
  }
  // The widest disc that gets through, to a quarter of a cell.
  double passes_m = 0.0;
  double sticks_m = radius_m;
  while (sticks_m - passes_m > frame.resolution_m / 4.0) {
    const double middle_m = (passes_m + sticks_m) / 2.0;
    (endsAt(middle_m) ? passes_m : sticks_m) = middle_m;
  }
  return refuse(where,
                "the widest way lets a radius of " + inMetres(passes_m) +
                    " m pass, and the robot's "
                    "is " +
                    inMetres(radius_m) + " m",
                "a wider door or a smaller robot_radius is needed");
}

}  // namespace

DrivablePath drivablePath(const FreeSpace& layer, const PathEnd& from, const PathEnd& to,
                          const DrivablePathConfig& config) {
  if (!(config.robot_radius_m >= 0.0 && config.max_spacing_m > 0.0)) {
    throw refuse("robot_radius", "is negative, or the spacing is not positive",
                 "metres are needed");
  }
  const Grid<std::int32_t> clearances = squaredClearances(layer);
  const Places places(clearances, layer.frame, config.robot_radius_m);
  const auto from_places = places.nearestTo(from);
  const auto to_places = places.nearestTo(to);
  for (const auto& [found, end] : {std::tie(from_places, from), std::tie(to_places, to)}) {
    if (!found.empty()) continue;
    throw refuse(
        end.name,
        "has no free place for a robot of radius " + inMetres(config.robot_radius_m) + " m",
        "a smaller robot_radius, or more of the room seen, is needed");
  }
  const auto ends = endsIn(from_places, to_places);
  if (!ends) throw tooNarrow(clearances, layer.frame, from, to, config.robot_radius_m);
  const std::vector<Cell> cells = shortestCells(places, clearances.box(), *ends);
  return spaced(straightened(places, cells), config.max_spacing_m);
}

}  // namespace occusg
