// SPDX-License-Identifier: BSD-3-Clause
#include "io/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace occusg {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontCapHeight = 21.0;  ///< Of kFont at scale 1 [pixels].
constexpr int kFractionBits = 4;         ///< Of OpenCV's fixed-point coordinates.
constexpr double kRaisedScale = 0.62;
constexpr double kRaisedBy = 0.45;  ///< Of the height.

cv::Scalar bgr(const RgbColor& color) { return cv::Scalar(color.b, color.g, color.r); }

int inner(double pixels) {
  return std::max(1, static_cast<int>(std::lround(pixels * Canvas::kOversampling)));
}

/// Inner fixed-point position. Whole coordinates are pixel corners here, pixel centres in OpenCV.
cv::Point fixed(const cv::Point2d& point) {
  constexpr double kOne = 1 << kFractionBits;
  return {static_cast<int>(std::lround((point.x * Canvas::kOversampling - 0.5) * kOne)),
          static_cast<int>(std::lround((point.y * Canvas::kOversampling - 0.5) * kOne))};
}

std::vector<cv::Point> fixed(const std::vector<cv::Point2d>& points) {
  std::vector<cv::Point> result;
  result.reserve(points.size());
  for (const cv::Point2d& point : points) result.push_back(fixed(point));
  return result;
}

double fontScale(double height_px) { return height_px * Canvas::kOversampling / kFontCapHeight; }

/// A piece of a line of text in one size.
struct TextRun {
  std::string text;
  double height_px = 0.0;
  double raised_px = 0.0;
};

std::vector<TextRun> runsOf(const std::string& text, double height_px) {
  std::vector<TextRun> runs;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool raised = text[i] == '^' && i + 1 < text.size();
    const TextRun style = raised ? TextRun{"", height_px * kRaisedScale, height_px * kRaisedBy}
                                 : TextRun{"", height_px, 0.0};
    if (runs.empty() || runs.back().raised_px != style.raised_px) runs.push_back(style);
    if (raised) ++i;
    runs.back().text += text[i];
  }
  return runs;
}

double widthOf(const TextRun& run, double weight) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(run.text, kFont, fontScale(run.height_px),
                                        inner(run.height_px * weight), &baseline);
  return static_cast<double>(size.width) / Canvas::kOversampling;
}

void putRuns(cv::Mat& pixels, const std::string& text, const cv::Point2d& origin,
             const TextStyle& style, double extra_width_px) {
  double x = origin.x;
  for (const TextRun& run : runsOf(text, style.height_px)) {
    const cv::Point at(
        static_cast<int>(std::lround(x * Canvas::kOversampling)),
        static_cast<int>(std::lround((origin.y - run.raised_px) * Canvas::kOversampling)));
    cv::putText(pixels, run.text, at, kFont, fontScale(run.height_px), bgr(style.color),
                inner(run.height_px * style.weight + 2.0 * extra_width_px), cv::LINE_AA);
    x += widthOf(run, style.weight);
  }
}

}  // namespace

Canvas::Canvas(const cv::Size& size)
    : size_(size), pixels_(size * kOversampling, CV_8UC3, cv::Scalar::all(255)) {}

cv::Mat Canvas::picture() const {
  cv::Mat result;
  cv::resize(pixels_, result, size_, 0, 0, cv::INTER_AREA);
  return result;
}

void Canvas::fillRectangle(const cv::Rect2d& r, const RgbColor& color) {
  fillRings(
      {{{r.x, r.y}, {r.x + r.width, r.y}, {r.x + r.width, r.y + r.height}, {r.x, r.y + r.height}}},
      color);
}

void Canvas::fillRings(const std::vector<std::vector<cv::Point2d>>& rings, const RgbColor& color) {
  std::vector<std::vector<cv::Point>> contours;
  contours.reserve(rings.size());
  for (const auto& ring : rings)
    if (ring.size() >= 3) contours.push_back(fixed(ring));
  if (!contours.empty()) cv::fillPoly(pixels_, contours, bgr(color), cv::LINE_AA, kFractionBits);
}

void Canvas::drawRing(const std::vector<cv::Point2d>& ring, const RgbColor& color,
                      double width_px) {
  if (ring.size() < 2) return;
  cv::polylines(pixels_, std::vector<std::vector<cv::Point>>{fixed(ring)}, true, bgr(color),
                inner(width_px), cv::LINE_AA, kFractionBits);
}

void Canvas::drawPath(const std::vector<cv::Point2d>& path, const RgbColor& color,
                      double width_px) {
  if (path.size() < 2) return;
  cv::polylines(pixels_, std::vector<std::vector<cv::Point>>{fixed(path)}, false, bgr(color),
                inner(width_px), cv::LINE_AA, kFractionBits);
}

void Canvas::drawLine(const cv::Point2d& a, const cv::Point2d& b, const RgbColor& color,
                      double width_px) {
  drawPath({a, b}, color, width_px);
}

void Canvas::drawDisc(const cv::Point2d& center, double radius_px, const RgbColor& color) {
  constexpr double kOne = 1 << kFractionBits;
  cv::circle(pixels_, fixed(center),
             static_cast<int>(std::lround(radius_px * kOversampling * kOne)), bgr(color),
             cv::FILLED, cv::LINE_AA, kFractionBits);
}

void Canvas::drawText(const std::string& text, const cv::Point2d& origin, const TextStyle& style) {
  putRuns(pixels_, text, origin, style, 0.0);
}

void Canvas::drawHalo(const std::string& text, const cv::Point2d& origin, const TextStyle& style,
                      const RgbColor& color, double width_px) {
  putRuns(pixels_, text, origin, {style.height_px, style.weight, color}, width_px);
}

double Canvas::textWidth(const std::string& text, const TextStyle& style) {
  double width = 0.0;
  for (const TextRun& run : runsOf(text, style.height_px)) width += widthOf(run, style.weight);
  return width;
}

std::string printable(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80U) continue;  // the rest of a UTF-8 character
    const bool drawable = byte >= 0x20U && byte < 0x7FU;
    result += c == '^' ? ' ' : drawable ? c : '?';
  }
  return result;
}

std::string fitted(const std::string& text, const TextStyle& style, double width_px) {
  constexpr std::size_t kLongest = 200;
  std::string beginning = text.substr(0, kLongest);
  if (beginning == text && Canvas::textWidth(text, style) <= width_px) return text;
  while (!beginning.empty() && Canvas::textWidth(beginning + "...", style) > width_px)
    beginning.pop_back();
  return beginning + "...";
}

}  // namespace occusg
