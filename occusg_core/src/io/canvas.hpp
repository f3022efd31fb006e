// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "occusg/io/room_color.hpp"

namespace occusg {

/// A run of text on one line. "^" raises the character that follows it ("m^2").
struct TextStyle {
  double height_px = 16.0;  ///< Of a capital letter.
  double weight = 0.10;     ///< Stroke width over height.
  RgbColor color;
};

/// A white picture to draw on in its own pixels, at twice the resolution inside, so that edges come
/// out smooth. All coordinates must be finite and within a few picture sizes.
class Canvas {
 public:
  explicit Canvas(const cv::Size& size);

  [[nodiscard]] cv::Size size() const { return size_; }
  /// The finished picture, CV_8UC3, BGR.
  [[nodiscard]] cv::Mat picture() const;

  /// How many inner pixels a pixel is wide, and the inner pixels, for drawing cell by cell.
  static constexpr int kOversampling = 2;
  [[nodiscard]] cv::Mat& pixels() { return pixels_; }

  void fillRectangle(const cv::Rect2d& rectangle, const RgbColor& color);
  /// Fills what an odd number of rings encloses.
  void fillRings(const std::vector<std::vector<cv::Point2d>>& rings, const RgbColor& color);
  void drawRing(const std::vector<cv::Point2d>& ring, const RgbColor& color, double width_px);
  void drawPath(const std::vector<cv::Point2d>& path, const RgbColor& color, double width_px);
  void drawLine(const cv::Point2d& a, const cv::Point2d& b, const RgbColor& color, double width_px);
  void drawDisc(const cv::Point2d& center, double radius_px, const RgbColor& color);

  /// Draws text from `origin`, its left end on the base line.
  void drawText(const std::string& text, const cv::Point2d& origin, const TextStyle& style);
  /// Draws a rim around where the text will be; call before `drawText`.
  void drawHalo(const std::string& text, const cv::Point2d& origin, const TextStyle& style,
                const RgbColor& color, double width_px);
  [[nodiscard]] static double textWidth(const std::string& text, const TextStyle& style);

 private:
  cv::Size size_;
  cv::Mat pixels_;
};

/// `text` with a "?" for each character the font cannot draw, and without the "^" of `TextStyle`.
[[nodiscard]] std::string printable(const std::string& text);

/// `text`, or its beginning and "...", so that it is at most `width_px` wide.
[[nodiscard]] std::string fitted(const std::string& text, const TextStyle& style, double width_px);

}  // namespace occusg
