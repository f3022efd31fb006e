// SPDX-License-Identifier: BSD-3-Clause
#include "io/overview_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace occusg {
namespace {

constexpr double kLongSide_px = 1600.0;
constexpr double kMinWidth_px = 1120.0;  ///< The legend needs it.
constexpr double kMinMapHeight_px = 200.0;

/// Bounds that grow with the points put in.
class Extent {
 public:
  void add(const Point2& point) {
    box_.min = {std::min(box_.min.x, point.x), std::min(box_.min.y, point.y)};
    box_.max = {std::max(box_.max.x, point.x), std::max(box_.max.y, point.y)};
  }
  [[nodiscard]] std::optional<Bounds2> bounds() const {
    if (box_.min.x > box_.max.x) return std::nullopt;
    return box_;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds2 box_{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
};

CellBox knownCells(const Grid<std::int8_t>& cells) {
  CellBox known;
  const CellBox& box = cells.box();
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x)
      if (cells.at({x, y}) != kUnknown) known = known.including(Cell{x, y});
  }
  return known;
}

/// A little air around what is shown, and never a picture of nothing.
Bounds2 padded(const Bounds2& box) {
  constexpr double kAir = 0.02;
  constexpr double kLeast_m = 1.0;
  const double longest = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  const double pad = kAir * longest + (longest < kLeast_m ? 0.5 * kLeast_m : 0.0);
  return {{box.min.x - pad, box.min.y - pad}, {box.max.x + pad, box.max.y + pad}};
}

}  // namespace

bool isDrawable(const Point2& point) {
  return std::abs(point.x) <= kMaxRoomCoordinate_m && std::abs(point.y) <= kMaxRoomCoordinate_m;
}

std::optional<Bounds2> shownBounds(const FreeSpace& layer, const OverviewContent& content) {
  Extent extent;
  if (const CellBox known = knownCells(layer.cells.dense()); !known.empty()) {
    extent.add(layer.frame.corner(known.min));
    extent.add(layer.frame.corner(known.max));
  }
  for (const RoomRecord& room : content.rooms) {
    for (const Point2& point : room.polygon.outer) extent.add(point);
    for (const Ring& hole : room.polygon.holes)
      for (const Point2& point : hole) extent.add(point);
  }
  for (const DoorRecord& crossing : content.crossings) {
    extent.add(crossing.segment.a);
    extent.add(crossing.segment.b);
  }
  for (const Point2& point : content.trajectory) extent.add(point);
  return extent.bounds();
}

OverviewView viewOf(const Bounds2& shown) {
  const Bounds2 box = padded(shown);
  const double width_m = box.max.x - box.min.x;
  const double height_m = box.max.y - box.min.y;
  const double frame_px = kTitleHeight_px + kLegendHeight_px;
  OverviewView view;
  view.px_per_m = std::min((kLongSide_px - 2.0 * kOverviewMargin_px) / width_m,
                           (kLongSide_px - frame_px) / height_m);
  const double map_width_px = width_m * view.px_per_m;
  const double map_height_px = height_m * view.px_per_m;
  const bool is_high = map_height_px + frame_px >= kLongSide_px - 1.0;
  const double width_px =
      is_high ? std::max(map_width_px + 2.0 * kOverviewMargin_px, kMinWidth_px) : kLongSide_px;
  const double map_area_px = std::max(map_height_px, kMinMapHeight_px);
  view.size = {static_cast<int>(std::lround(width_px)),
               static_cast<int>(std::lround(map_area_px + frame_px))};
  view.map = {(view.size.width - map_width_px) / 2.0,
              kTitleHeight_px + (map_area_px - map_height_px) / 2.0, map_width_px, map_height_px};
  view.upper_left = {box.min.x, box.max.y};
  return view;
}

}  // namespace occusg
