// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

namespace occusg {

/// How an image is fitted into the fixed input of a network: scaled to fit, centred, the rest grey.
/// Coordinates are continuous: pixel (u, v) covers [u, u + 1) x [v, v + 1).
struct Letterbox {
  cv::Size image;
  cv::Size input;
  cv::Rect content;  ///< Where the scaled image lies in the input.

  [[nodiscard]] double scaleX() const { return static_cast<double>(content.width) / image.width; }
  [[nodiscard]] double scaleY() const { return static_cast<double>(content.height) / image.height; }

  /// The pixels of the image whose centres lie in `box`, given in the input.
  [[nodiscard]] cv::Rect toImage(const cv::Rect2d& box) const;
};

/// @pre no side is below 1.
[[nodiscard]] Letterbox fitLetterbox(const cv::Size& image, const cv::Size& input);

/// The network's input for a BGR image of 8 bits: 1 x 3 x height x width floats, RGB, 0..1; padded
/// with the grey (114) the models were trained with.
[[nodiscard]] cv::Mat networkInput(const cv::Mat& image, const Letterbox& letterbox);

}  // namespace occusg
