// SPDX-License-Identifier: BSD-3-Clause
#include "io/overview_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "io/canvas.hpp"
#include "io/json_text.hpp"
#include "io/map_drawing.hpp"
#include "io/overview_graph.hpp"
#include "io/overview_labels.hpp"
#include "io/overview_view.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr RgbColor kPathColor{28, 100, 210};
constexpr RgbColor kCrossingColor{214, 48, 49};
constexpr ColorTone kTintTone{88.0, 24.0};
constexpr ColorTone kOutlineTone{55.0, 38.0};

constexpr double kOutlineWidth_px = 1.6;
constexpr double kPathWidth_px = 2.0;
constexpr double kCrossingWidth_px = 4.5;
constexpr double kCasing_px = 1.75;  ///< White rim that sets a line off its ground.

using Path = std::vector<cv::Point2d>;

Path pathOf(const std::vector<Point2>& points, const OverviewView& view) {
  Path path;
  path.reserve(points.size());
  for (const Point2& point : points) path.push_back(view.pixelAt(point));
  return path;
}

bool isDrawable(const Ring& ring) {
  return ring.size() >= 3 && std::all_of(ring.begin(), ring.end(),
                                         [](const Point2& point) { return isDrawable(point); });
}

bool isDrawable(const RoomRecord& room) {
  return isDrawable(room.polygon.outer) &&
         std::all_of(room.polygon.holes.begin(), room.polygon.holes.end(),
                     [](const Ring& hole) { return isDrawable(hole); });
}

bool isDrawable(const DoorRecord& crossing) {
  return isDrawable(crossing.segment.a) && isDrawable(crossing.segment.b);
}

bool isDrawable(const DrawnObject& object) {
  return isDrawable(object.box.min) && isDrawable(object.box.max);
}

bool isDrawable(const RoomLink& link) {
  return isDrawable(link.from) && isDrawable(link.door) && isDrawable(link.to);
}

/// What of the content can be drawn.
OverviewContent drawable(const OverviewContent& content) {
  OverviewContent result;
  result.title = content.title;
  const auto keep = [](const auto& from, auto& to) {
    std::copy_if(from.begin(), from.end(), std::back_inserter(to),
                 [](const auto& item) { return isDrawable(item); });
  };
  keep(content.rooms, result.rooms);
  keep(content.crossings, result.crossings);
  keep(content.trajectory, result.trajectory);
  keep(content.objects, result.objects);
  keep(content.links, result.links);
  return result;
}

void fillRooms(Canvas& canvas, const OverviewView& view, const std::vector<RoomRecord>& rooms) {
  for (const RoomRecord& room : rooms) {
    std::vector<Path> rings{pathOf(room.polygon.outer, view)};
    for (const Ring& hole : room.polygon.holes) rings.push_back(pathOf(hole, view));
    canvas.fillRings(rings, roomColor(room.id, kTintTone));
  }
}

void outlineRooms(Canvas& canvas, const OverviewView& view, const std::vector<RoomRecord>& rooms) {
  for (const RoomRecord& room : rooms) {
    const RgbColor color = roomColor(room.id, kOutlineTone);
    canvas.drawRing(pathOf(room.polygon.outer, view), color, kOutlineWidth_px);
    for (const Ring& hole : room.polygon.holes)
      canvas.drawRing(pathOf(hole, view), color, kOutlineWidth_px);
  }
}

void drawCrossing(Canvas& canvas, const cv::Point2d& a, const cv::Point2d& b) {
  canvas.drawLine(a, b, kWhite, kCrossingWidth_px + 2.0 * kCasing_px);
  canvas.drawLine(a, b, kCrossingColor, kCrossingWidth_px);
}

void drawCrossings(Canvas& canvas, const OverviewView& view,
                   const std::vector<DoorRecord>& crossings) {
  for (const DoorRecord& crossing : crossings)
    drawCrossing(canvas, view.pixelAt(crossing.segment.a), view.pixelAt(crossing.segment.b));
}

void drawStart(Canvas& canvas, const cv::Point2d& at) {
  constexpr double kRadius_px = 6.5;
  canvas.drawDisc(at, kRadius_px + kCasing_px, kWhite);
  canvas.drawDisc(at, kRadius_px, kPathColor);
}

/// Arrow head with its tip at `tip`, pointing along `direction` (of length one).
void drawArrowHead(Canvas& canvas, const cv::Point2d& tip, const cv::Point2d& direction) {
  constexpr double kLength_px = 17.0;
  constexpr double kHalfWidth_px = 7.5;
  const cv::Point2d side(-direction.y, direction.x);
  const cv::Point2d back = tip - kLength_px * direction;
  const Path head{tip, back + kHalfWidth_px * side, tip - 0.75 * kLength_px * direction,
                  back - kHalfWidth_px * side};
  canvas.drawRing(head, kWhite, 2.0 * kCasing_px);
  canvas.fillRings({head}, kPathColor);
}

/// Direction of travel at the end, over enough of the path that jitter does not turn it.
cv::Point2d finalDirection(const Path& path) {
  constexpr double kEnough_px = 12.0;
  for (std::size_t i = path.size(); i-- > 0;) {
    const cv::Point2d step = path.back() - path[i];
    const double length = std::hypot(step.x, step.y);
    if (length >= kEnough_px) return step / length;
  }
  return {1.0, 0.0};
}

void drawTrajectoryEnds(Canvas& canvas, const OverviewView& view,
                        const std::vector<Point2>& trajectory) {
  const Path path = pathOf(trajectory, view);
  if (path.empty()) return;
  drawStart(canvas, path.front());
  if (path.size() > 1) drawArrowHead(canvas, path.back(), finalDirection(path));
}

double lengthOf(const std::vector<Point2>& trajectory) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    length_m += distance(trajectory[i - 1], trajectory[i]);
  return length_m;
}

std::string factsOf(const OverviewContent& content) {
  double area_m2 = 0.0;
  for (const RoomRecord& room : content.rooms) area_m2 += area(room.polygon);
  std::string facts = counted(content.rooms.size(), "room") + "   |   " + areaText(area_m2) +
                      "   |   " + counted(content.crossings.size(), "crossing");
  if (!content.objects.empty()) facts += "   |   " + counted(content.objects.size(), "object");
  if (!content.trajectory.empty())
    facts += "   |   path " + toText(rounded(lengthOf(content.trajectory), 1)) + " m";
  return facts;
}

void drawLegend(Canvas& canvas, const OverviewContent& content) {
  Legend legend(canvas);
  legend.swatch(kWallColor, kWallColor, "obstacle");
  legend.swatch(kFreeColor, kSwatchRimColor, "free");
  if (!content.rooms.empty()) {
    const int id = content.rooms.front().id;
    legend.swatch(roomColor(id, kTintTone), roomColor(id, kOutlineTone), "room");
  }
  if (!content.crossings.empty()) {
    legend.sign(24.0, "crossing", [&](const cv::Point2d& at) {
      drawCrossing(canvas, {at.x + 2.0, at.y}, {at.x + 22.0, at.y});
    });
  }
  if (!content.links.empty()) {
    legend.sign(24.0, "adjacent", [&](const cv::Point2d& at) {
      canvas.drawLine({at.x + 2.0, at.y}, {at.x + 22.0, at.y}, kLinkColor, 1.4);
    });
  }
  if (!content.objects.empty()) legend.swatch(kWhite, kObjectColor, "object");
  if (!content.trajectory.empty()) {
    legend.sign(53.0, "path", [&](const cv::Point2d& at) {
      canvas.drawLine({at.x + 7.0, at.y}, {at.x + 42.0, at.y}, kPathColor, kPathWidth_px);
      drawStart(canvas, {at.x + 7.0, at.y});
      drawArrowHead(canvas, {at.x + 52.0, at.y}, {1.0, 0.0});
    });
  }
}

void drawEmptyNotice(Canvas& canvas) {
  const TextStyle style{18.0, 0.1, kFaintInkColor};
  const std::string notice = "nothing mapped";
  canvas.drawText(
      notice,
      {(canvas.size().width - Canvas::textWidth(notice, style)) / 2.0, canvas.size().height / 2.0},
      style);
}

}  // namespace

cv::Mat drawOverview(const FreeSpace& given_layer, const OverviewContent& given_content) {
  const FreeSpace layer = hasUsableFrame(given_layer) ? given_layer : FreeSpace{};
  const OverviewContent content = drawable(given_content);
  const auto bounds = shownBounds(layer, content);
  const OverviewView view = viewOf(bounds.value_or(Bounds2{{0.0, 0.0}, {8.0, 4.0}}));
  Canvas canvas(view.size);
  paintCells(canvas, view, layer, CellKind::kFreeSpace);
  fillRooms(canvas, view, content.rooms);
  paintCells(canvas, view, layer, CellKind::kObstacles);
  outlineRooms(canvas, view, content.rooms);
  canvas.drawPath(pathOf(content.trajectory, view), kPathColor, kPathWidth_px);
  drawObjects(canvas, view, content);
  drawLinks(canvas, view, content);
  drawCrossings(canvas, view, content.crossings);
  drawRoomLabels(canvas, view, layer, content);
  drawTrajectoryEnds(canvas, view, content.trajectory);
  drawTitle(canvas, printable(content.title), factsOf(content));
  drawLegend(canvas, content);
  drawScaleBar(canvas, view);
  if (!bounds) drawEmptyNotice(canvas);
  return canvas.picture();
}

std::string encodePng(const cv::Mat& picture, PngEffort effort) {
  constexpr int kSmallest = 9;
  constexpr int kFast = 3;
  const std::vector<int> options{cv::IMWRITE_PNG_COMPRESSION,
                                 effort == PngEffort::kSmallest ? kSmallest : kFast,
                                 cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_DEFAULT};
  std::vector<unsigned char> bytes;
  if (picture.empty() || !cv::imencode(".png", picture, bytes, options))
    throw refuse("picture", "cannot be encoded", "a picture with at least one pixel is needed");
  return {bytes.begin(), bytes.end()};
}

}  // namespace occusg
