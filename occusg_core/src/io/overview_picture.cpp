// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/overview_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "io/canvas.hpp"
#include "io/json_text.hpp"
#include "io/overview_labels.hpp"
#include "io/overview_view.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr RgbColor kFreeColor{233, 235, 238};
constexpr RgbColor kWallColor{58, 62, 70};
constexpr RgbColor kFaintWallColor{150, 154, 160};
constexpr RgbColor kInkColor{33, 37, 41};
constexpr RgbColor kFaintInkColor{108, 117, 125};
constexpr RgbColor kRuleColor{222, 226, 230};
constexpr RgbColor kPathColor{28, 100, 210};
constexpr RgbColor kCrossingColor{214, 48, 49};
constexpr RgbColor kWhite{255, 255, 255};
constexpr ColorTone kTintTone{88.0, 24.0};
constexpr ColorTone kOutlineTone{55.0, 38.0};

constexpr double kOutlineWidth_px = 1.6;
constexpr double kPathWidth_px = 2.0;
constexpr double kCrossingWidth_px = 4.5;
constexpr double kCasing_px = 1.75;  ///< White rim that sets a line off its ground.
constexpr TextStyle kLegendText{13.0, 0.11, kInkColor};

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

/// What of the content can be drawn.
OverviewContent drawable(const OverviewContent& content) {
  OverviewContent result{content.title, {}, {}, {}};
  const auto keep = [](const auto& from, auto& to) {
    std::copy_if(from.begin(), from.end(), std::back_inserter(to),
                 [](const auto& item) { return isDrawable(item); });
  };
  keep(content.rooms, result.rooms);
  keep(content.crossings, result.crossings);
  keep(content.trajectory, result.trajectory);
  return result;
}

enum class CellKind { kFreeSpace, kObstacles };

RgbColor colorOf(std::int8_t value) {
  if (value == kFree) return kFreeColor;
  const double share = std::clamp(static_cast<double>(value) / kFullObstacle, 0.0, 1.0);
  const auto mixed = [share](std::uint8_t faint, std::uint8_t full) {
    return static_cast<std::uint8_t>(std::lround(faint + share * (full - faint)));
  };
  return {mixed(kFaintWallColor.r, kWallColor.r), mixed(kFaintWallColor.g, kWallColor.g),
          mixed(kFaintWallColor.b, kWallColor.b)};
}

/// Paints the cells of one kind; both together would hide the rooms or the obstacles.
void paintCells(Canvas& canvas, const OverviewView& view, const FreeSpace& layer, CellKind kind) {
  if (layer.cells.empty()) return;
  cv::Mat& pixels = canvas.pixels();
  for (int row = 0; row < pixels.rows; ++row) {
    for (int column = 0; column < pixels.cols; ++column) {
      const Point2 point = view.pointAt(
          {(column + 0.5) / Canvas::kOversampling, (row + 0.5) / Canvas::kOversampling});
      const std::int8_t value = layer.cells.valueOr(layer.frame.cellAt(point), kUnknown);
      if (value == kUnknown || (value == kFree) != (kind == CellKind::kFreeSpace)) continue;
      const RgbColor color = colorOf(value);
      pixels.at<cv::Vec3b>(row, column) = {color.b, color.g, color.r};
    }
  }
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

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

void drawTitle(Canvas& canvas, const OverviewContent& content) {
  constexpr double kTitleBase_px = 54.0;
  constexpr double kFactsBase_px = 84.0;
  const TextStyle title_style{22.0, 0.12, kInkColor};
  const TextStyle facts_style{13.5, 0.10, kFaintInkColor};
  const double width_px = canvas.size().width - 2.0 * kOverviewMargin_px;
  double area_m2 = 0.0;
  for (const RoomRecord& room : content.rooms) area_m2 += area(room.polygon);
  std::string facts = counted(content.rooms.size(), "room") + "   |   " + areaText(area_m2) +
                      "   |   " + counted(content.crossings.size(), "crossing");
  if (!content.trajectory.empty())
    facts += "   |   path " + toText(rounded(lengthOf(content.trajectory), 1)) + " m";
  canvas.drawText(fitted(printable(content.title), title_style, width_px),
                  {kOverviewMargin_px, kTitleBase_px}, title_style);
  canvas.drawText(facts, {kOverviewMargin_px, kFactsBase_px}, facts_style);
}

/// Length of the bar: 1, 2 or 5 times a power of ten, the largest that is short enough.
double scaleBarLength(double longest_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(longest_m)));
  for (const double step : {5.0, 2.0})
    if (step * decade <= longest_m) return step * decade;
  return decade;
}

void drawScaleBar(Canvas& canvas, const OverviewView& view) {
  constexpr double kLongest_px = 210.0;
  constexpr double kTick_px = 5.0;
  constexpr double kWidth_px = 2.5;
  const double length_m = scaleBarLength(kLongest_px / view.px_per_m);
  const double right = canvas.size().width - kOverviewMargin_px;
  const double left = right - length_m * view.px_per_m;
  const double y = canvas.size().height - 32.0;
  for (const double x : {left, right})
    canvas.drawLine({x, y - kTick_px}, {x, y + kTick_px}, kInkColor, kWidth_px);
  canvas.drawLine({left, y}, {right, y}, kInkColor, kWidth_px);
  const std::string text =
      (length_m >= 1.0 ? std::to_string(std::lround(length_m)) : toText(rounded(length_m, 7))) +
      " m";
  canvas.drawText(text, {(left + right - Canvas::textWidth(text, kLegendText)) / 2.0, y - 10.0},
                  kLegendText);
}

/// A legend under construction: each entry is a sign and a word, from left to right.
class Legend {
 public:
  Legend(Canvas& canvas, double y) : canvas_(canvas), y_(y) {}

  void swatch(const RgbColor& fill, const RgbColor& rim, const std::string& word) {
    const cv::Rect2d box(x_, y_ - 9.0, 18.0, 18.0);
    canvas_.fillRectangle(box, rim);
    canvas_.fillRectangle({box.x + 1.5, box.y + 1.5, box.width - 3.0, box.height - 3.0}, fill);
    name(word, box.width);
  }
  void crossing(const std::string& word) {
    drawCrossing(canvas_, {x_ + 2.0, y_}, {x_ + 22.0, y_});
    name(word, 24.0);
  }
  void trajectory(const std::string& word) {
    canvas_.drawLine({x_ + 7.0, y_}, {x_ + 42.0, y_}, kPathColor, kPathWidth_px);
    drawStart(canvas_, {x_ + 7.0, y_});
    drawArrowHead(canvas_, {x_ + 52.0, y_}, {1.0, 0.0});
    name(word, 53.0);
  }

 private:
  void name(const std::string& word, double sign_width) {
    canvas_.drawText(word, {x_ + sign_width + 9.0, y_ + 6.5}, kLegendText);
    x_ += sign_width + 9.0 + Canvas::textWidth(word, kLegendText) + 28.0;
  }

  Canvas& canvas_;
  double x_ = kOverviewMargin_px;
  double y_;
};

void drawLegend(Canvas& canvas, const OverviewContent& content) {
  constexpr double kFromBottom_px = 34.0;
  const double rule = canvas.size().height - kLegendHeight_px + 18.0;
  canvas.drawLine({kOverviewMargin_px, rule}, {canvas.size().width - kOverviewMargin_px, rule},
                  kRuleColor, 1.0);
  Legend legend(canvas, canvas.size().height - kFromBottom_px);
  legend.swatch(kWallColor, kWallColor, "obstacle");
  legend.swatch(kFreeColor, {190, 195, 200}, "free");
  if (!content.rooms.empty()) {
    const int id = content.rooms.front().id;
    legend.swatch(roomColor(id, kTintTone), roomColor(id, kOutlineTone), "room");
  }
  if (!content.crossings.empty()) legend.crossing("crossing");
  if (!content.trajectory.empty()) legend.trajectory("path, start to end");
}

void drawEmptyNotice(Canvas& canvas) {
  const TextStyle style{18.0, 0.1, kFaintInkColor};
  const std::string notice = "nothing mapped";
  canvas.drawText(
      notice,
      {(canvas.size().width - Canvas::textWidth(notice, style)) / 2.0, canvas.size().height / 2.0},
      style);
}

/// Fine enough for any map, and coarse enough that cell indices fit an int.
bool hasUsableFrame(const FreeSpace& layer) {
  return layer.frame.resolution_m >= 1e-3 && layer.frame.resolution_m <= kMaxRoomCoordinate_m;
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
  drawCrossings(canvas, view, content.crossings);
  drawRoomLabels(canvas, view, layer, content);
  drawTrajectoryEnds(canvas, view, content.trajectory);
  drawTitle(canvas, content);
  drawLegend(canvas, content);
  drawScaleBar(canvas, view);
  if (!bounds) drawEmptyNotice(canvas);
  return canvas.picture();
}

std::string encodePng(const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  if (picture.empty() || !cv::imencode(".png", picture, bytes))
    throw refuse("picture", "cannot be encoded", "a picture with at least one pixel is needed");
  return {bytes.begin(), bytes.end()};
}

}  // namespace occusg
