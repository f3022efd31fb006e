// SPDX-License-Identifier: BSD-3-Clause
#include "io/overview_graph.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "io/overview_picture.hpp"

namespace occusg {
namespace {

constexpr double kLinkWidth_px = 1.4;
constexpr double kLinkDot_px = 3.5;
constexpr double kObjectWidth_px = 1.4;
constexpr double kSmallestBox_px = 5.0;

cv::Rect2d boxInPicture(const DrawnObject& object, const OverviewView& view) {
  const cv::Point2d low = view.pixelAt(object.box.min);
  const cv::Point2d high = view.pixelAt(object.box.max);
  cv::Rect2d box(cv::Point2d(low.x, high.y), cv::Point2d(high.x, low.y));
  // A picture on a wall has no depth, and must be seen all the same.
  const double pad_x = std::max(0.0, (kSmallestBox_px - box.width) / 2.0);
  const double pad_y = std::max(0.0, (kSmallestBox_px - box.height) / 2.0);
  return {box.x - pad_x, box.y - pad_y, box.width + 2.0 * pad_x, box.height + 2.0 * pad_y};
}

std::string wordsOf(const DrawnObject& object) {
  std::string words = printable(object.label);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace

void drawLinks(Canvas& canvas, const OverviewView& view, const OverviewContent& content) {
  for (const RoomLink& link : content.links) {
    const std::vector<cv::Point2d> path{view.pixelAt(link.from), view.pixelAt(link.door),
                                        view.pixelAt(link.to)};
    canvas.drawPath(path, kLinkColor, kLinkWidth_px);
    canvas.drawDisc(path.front(), kLinkDot_px, kLinkColor);
    canvas.drawDisc(path.back(), kLinkDot_px, kLinkColor);
  }
}

void drawObjects(Canvas& canvas, const OverviewView& view, const OverviewContent& content) {
  const TextStyle style{9.0, 0.12, kObjectColor};
  for (const DrawnObject& object : content.objects) {
    const cv::Rect2d box = boxInPicture(object, view);
    canvas.drawRing({{box.x, box.y},
                     {box.x + box.width, box.y},
                     {box.x + box.width, box.y + box.height},
                     {box.x, box.y + box.height}},
                    kObjectColor, kObjectWidth_px);
    const std::string words = wordsOf(object);
    const double width_px = Canvas::textWidth(words, style);
    if (width_px + 4.0 > box.width || style.height_px + 4.0 > box.height) continue;
    canvas.drawText(
        words, {box.x + (box.width - width_px) / 2.0, box.y + (box.height + style.height_px) / 2.0},
        style);
  }
}

}  // namespace occusg
