// SPDX-License-Identifier: BSD-3-Clause
#include "io/map_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/json_text.hpp"
#include "occusg/geometry/grid.hpp"

namespace occusg {
namespace {

constexpr RgbColor kFaintWallColor{150, 154, 160};
constexpr RgbColor kRuleColor{222, 226, 230};
constexpr TextStyle kLegendText{13.0, 0.11, kInkColor};

RgbColor colorOf(std::int8_t value) {
  if (value == kFree) return kFreeColor;
  const double share = std::clamp(static_cast<double>(value) / kFullObstacle, 0.0, 1.0);
  const auto mixed = [share](std::uint8_t faint, std::uint8_t full) {
    return static_cast<std::uint8_t>(std::lround(faint + share * (full - faint)));
  };
  return {mixed(kFaintWallColor.r, kWallColor.r), mixed(kFaintWallColor.g, kWallColor.g),
          mixed(kFaintWallColor.b, kWallColor.b)};
}

/// Length of the bar: 1, 2 or 5 times a power of ten, the largest that is short enough.
double scaleBarLength(double longest_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(longest_m)));
  for (const double step : {5.0, 2.0})
    if (step * decade <= longest_m) return step * decade;
  return decade;
}

}  // namespace

void paintCells(Canvas& canvas, const OverviewView& view, const FreeSpace& layer, CellKind kind) {
  if (layer.cells.empty()) return;
  cv::Mat& pixels = canvas.pixels();
  const auto cellOf = [&](int column, int row) {
    return layer.frame.cellAt(view.pointAt(
        {(column + 0.5) / Canvas::kOversampling, (row + 0.5) / Canvas::kOversampling}));
  };
  // The view is parallel to the map's axes: a picture column is in one column of cells.
  std::vector<int> cell_x(static_cast<std::size_t>(pixels.cols));
  for (int column = 0; column < pixels.cols; ++column)
    cell_x[static_cast<std::size_t>(column)] = cellOf(column, 0).x;
  const CellBox box = layer.cells.box();
  Grid<std::int8_t> line;
  for (int row = 0; row < pixels.rows; ++row) {
    const int cell_y = cellOf(0, row).y;
    // Several pictured rows lie in a row of cells.
    if (line.box().min.y != cell_y || line.empty())
      line = layer.cells.dense({{box.min.x, cell_y}, {box.max.x, cell_y + 1}});
    for (int column = 0; column < pixels.cols; ++column) {
      const Cell cell{cell_x[static_cast<std::size_t>(column)], cell_y};
      const std::int8_t value = line.valueOr(cell, kUnknown);
      if (value == kUnknown || (value == kFree) != (kind == CellKind::kFreeSpace)) continue;
      const RgbColor color = colorOf(value);
      pixels.at<cv::Vec3b>(row, column) = {color.b, color.g, color.r};
    }
  }
}

void drawTitle(Canvas& canvas, const std::string& title, const std::string& facts) {
  constexpr double kTitleBase_px = 54.0;
  constexpr double kFactsBase_px = 84.0;
  const TextStyle title_style{22.0, 0.12, kInkColor};
  const TextStyle facts_style{13.5, 0.10, kFaintInkColor};
  const double width_px = canvas.size().width - 2.0 * kOverviewMargin_px;
  canvas.drawText(fitted(title, title_style, width_px), {kOverviewMargin_px, kTitleBase_px},
                  title_style);
  canvas.drawText(facts, {kOverviewMargin_px, kFactsBase_px}, facts_style);
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

Legend::Legend(Canvas& canvas)
    : canvas_(canvas), at_(kOverviewMargin_px, canvas.size().height - 34.0) {
  const double rule = canvas.size().height - kLegendHeight_px + 18.0;
  canvas.drawLine({kOverviewMargin_px, rule}, {canvas.size().width - kOverviewMargin_px, rule},
                  kRuleColor, 1.0);
}

void Legend::swatch(const RgbColor& fill, const RgbColor& rim, const std::string& word) {
  sign(18.0, word, [&](const cv::Point2d& at) {
    const cv::Rect2d box(at.x, at.y - 9.0, 18.0, 18.0);
    canvas_.fillRectangle(box, rim);
    canvas_.fillRectangle({box.x + 1.5, box.y + 1.5, box.width - 3.0, box.height - 3.0}, fill);
  });
}

void Legend::sign(double width_px, const std::string& word,
                  const std::function<void(const cv::Point2d&)>& draw) {
  draw(at_);
  canvas_.drawText(word, {at_.x + width_px + 9.0, at_.y + 6.5}, kLegendText);
  at_.x += width_px + 9.0 + Canvas::textWidth(word, kLegendText) + 28.0;
}

bool hasUsableFrame(const FreeSpace& layer) {
  return layer.frame.resolution_m >= 1e-3 && layer.frame.resolution_m <= kMaxRoomCoordinate_m;
}

}  // namespace occusg
