// SPDX-License-Identifier: BSD-3-Clause
#include "io/overview_labels.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "io/json_text.hpp"
#include "io/label_placement.hpp"

namespace occusg {
namespace {

constexpr ColorTone kTextTone{28.0, 30.0};
constexpr ColorTone kHaloTone{95.0, 8.0};
constexpr double kIdHeight_px = 19.0;
constexpr double kDetailHeight_px = 13.5;
constexpr double kLineGap = 0.65;  ///< Between lines, of the height of the lower one.
constexpr double kHalo_px = 2.5;
constexpr double kSmallest = 0.8;  ///< Scale below which details are left out instead.
constexpr double kSmallestId = 0.7;

struct LabelLine {
  std::string text;
  TextStyle style;
};

/// Lines of a label, from all that is known down to the id alone.
std::vector<std::vector<LabelLine>> variantsOf(const RoomRecord& room) {
  const RgbColor color = roomColor(room.id, kTextTone);
  const TextStyle detail{kDetailHeight_px, 0.12, color};
  const LabelLine id{"R" + std::to_string(room.id), {kIdHeight_px, 0.14, color}};
  const LabelLine size{areaText(area(room.polygon)), detail};
  std::vector<std::vector<LabelLine>> variants;
  if (!room.label.empty() && room.label != "unknown") {
    constexpr double kWidest_px = 260.0;
    std::string words = printable(room.label);
    std::replace(words.begin(), words.end(), '_', ' ');
    const LabelLine kind{fitted(words, detail, kWidest_px), detail};
    variants.push_back({id, kind, size});
  }
  variants.push_back({id, size});
  variants.push_back({id});
  return variants;
}

cv::Size2d sizeOf(const std::vector<LabelLine>& lines) {
  cv::Size2d size(0.0, 0.0);
  for (const LabelLine& line : lines) {
    size.width = std::max(size.width, Canvas::textWidth(line.text, line.style));
    size.height += line.style.height_px * (size.height > 0.0 ? 1.0 + kLineGap : 1.0);
  }
  return {size.width + 4.0 * kHalo_px, size.height + 4.0 * kHalo_px};
}

void drawLines(Canvas& canvas, const std::vector<LabelLine>& lines, const cv::Point2d& center,
               double scale, const RgbColor& halo) {
  const cv::Size2d size = sizeOf(lines);
  for (const bool is_halo : {true, false}) {
    double y = center.y - scale * (size.height / 2.0 - 2.0 * kHalo_px);
    for (const LabelLine& line : lines) {
      TextStyle style = line.style;
      style.height_px *= scale;
      y += style.height_px * (&line == &lines.front() ? 1.0 : 1.0 + kLineGap);
      const cv::Point2d origin(center.x - Canvas::textWidth(line.text, style) / 2.0, y);
      if (is_halo) {
        canvas.drawHalo(line.text, origin, style, halo, kHalo_px);
      } else {
        canvas.drawText(line.text, origin, style);
      }
    }
  }
}

/// Where the room is and no obstacle, as far as the picture reaches.
struct RoomMask {
  cv::Rect box;  ///< Of `inside` in the picture.
  cv::Mat inside;
};

RoomMask maskOf(const RoomRecord& room, const OverviewView& view, const FreeSpace& layer) {
  std::vector<std::vector<cv::Point>> contours(1);
  for (const Point2& point : room.polygon.outer) contours[0].push_back(view.pixelAt(point));
  for (const Ring& hole : room.polygon.holes) {
    contours.emplace_back();
    for (const Point2& point : hole) contours.back().push_back(view.pixelAt(point));
  }
  RoomMask mask;
  mask.box = cv::boundingRect(contours[0]) & cv::Rect({0, 0}, view.size);
  mask.inside = cv::Mat::zeros(mask.box.size(), CV_8UC1);
  if (mask.box.empty()) return mask;
  cv::fillPoly(mask.inside, contours, cv::Scalar(255), cv::LINE_8, 0, -mask.box.tl());
  for (int row = 0; row < mask.box.height; ++row) {
    for (int column = 0; column < mask.box.width; ++column) {
      const Point2 point = view.pointAt({mask.box.x + column + 0.5, mask.box.y + row + 0.5});
      if (layer.cells.valueOr(layer.frame.cellAt(point), kFree) > kFree)
        mask.inside.at<std::uint8_t>(row, column) = 0;
    }
  }
  return mask;
}

/// The best place that leaves the path visible, or else one that may hide part of it.
LabelPlace placeIn(const RoomMask& mask, const cv::Mat& path, const std::vector<LabelLine>& lines) {
  const cv::Mat beside_path = mask.inside & ~path(mask.box);
  const LabelPlace place = placeLabel(beside_path, sizeOf(lines));
  return place.fit >= kSmallest ? place : placeLabel(mask.inside, sizeOf(lines));
}

void drawLabel(Canvas& canvas, const RoomMask& mask, const cv::Mat& path, const RoomRecord& room) {
  if (mask.box.empty() || cv::countNonZero(mask.inside) == 0) return;
  const cv::Point2d corner(mask.box.x, mask.box.y);
  const RgbColor halo = roomColor(room.id, kHaloTone);
  const auto variants = variantsOf(room);
  for (const auto& lines : variants) {
    const LabelPlace place = placeIn(mask, path, lines);
    const bool is_last = &lines == &variants.back();
    if (place.fit < kSmallest && !is_last) continue;
    drawLines(canvas, lines, corner + place.center, std::clamp(place.fit, kSmallestId, 1.0), halo);
    return;
  }
}

double pixelsOf(const RoomRecord& room, const OverviewView& view) {
  const Bounds2 box = bounds(room.polygon);
  const double shown = static_cast<double>(view.size.area());
  return std::min(
      shown, (box.max.x - box.min.x) * (box.max.y - box.min.y) * view.px_per_m * view.px_per_m);
}

/// The rooms that get a label: the largest, as many as can be read and placed in about a second.
std::vector<bool> labelledRooms(const OverviewView& view, const std::vector<RoomRecord>& rooms) {
  constexpr std::size_t kMaxLabels = 600;
  constexpr double kMaxPixels = 2e7;  // searched for places, several times each
  std::vector<std::pair<double, std::size_t>> by_area;
  for (std::size_t i = 0; i < rooms.size(); ++i) by_area.emplace_back(-area(rooms[i].polygon), i);
  std::sort(by_area.begin(), by_area.end());
  std::vector<bool> is_labelled(rooms.size(), false);
  double pixels = 0.0;
  for (std::size_t rank = 0; rank < std::min(kMaxLabels, by_area.size()); ++rank) {
    const std::size_t room = by_area[rank].second;
    const double needed = pixelsOf(rooms[room], view);
    if (rank > 0 && pixels + needed > kMaxPixels) continue;
    pixels += needed;
    is_labelled[room] = true;
  }
  return is_labelled;
}

/// Where the path and its ends are drawn, and a little around them.
cv::Mat pathMask(const OverviewView& view, const std::vector<Point2>& trajectory) {
  constexpr int kLineWidth_px = 9;
  constexpr int kEndRadius_px = 16;
  cv::Mat mask = cv::Mat::zeros(view.size, CV_8UC1);
  if (trajectory.empty()) return mask;
  std::vector<cv::Point> path;
  path.reserve(trajectory.size());
  for (const Point2& point : trajectory) path.push_back(view.pixelAt(point));
  cv::polylines(mask, path, false, cv::Scalar(255), kLineWidth_px);
  for (const cv::Point& end : {path.front(), path.back()})
    cv::circle(mask, end, kEndRadius_px, cv::Scalar(255), cv::FILLED);
  return mask;
}

}  // namespace

void drawRoomLabels(Canvas& canvas, const OverviewView& view, const FreeSpace& layer,
                    const OverviewContent& content) {
  const cv::Mat path = pathMask(view, content.trajectory);
  const std::vector<bool> is_labelled = labelledRooms(view, content.rooms);
  for (std::size_t i = 0; i < content.rooms.size(); ++i) {
    const RoomRecord& room = content.rooms[i];
    if (is_labelled[i]) drawLabel(canvas, maskOf(room, view, layer), path, room);
  }
}

std::string areaText(double area_m2) {
  // One decimal, without a locale's comma.
  const std::string text = toText(rounded(area_m2, 1));
  return text + " m^2";
}

}  // namespace occusg
