// SPDX-License-Identifier: BSD-3-Clause
#include "perception/letterbox.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/dnn/dnn.hpp>
#include <opencv2/imgproc.hpp>

namespace occusg {
namespace {

/// The grey of the padding in training.
constexpr double kPadding = 114.0;

int scaledSide(int side, double scale, int limit) {
  return std::clamp(static_cast<int>(std::lround(side * scale)), 1, limit);
}

/// The first pixel whose centre is not before `edge`, kept in [0, side].
int firstPixel(double edge, int side) {
  return static_cast<int>(std::clamp(std::ceil(edge - 0.5), 0.0, static_cast<double>(side)));
}

}  // namespace

cv::Rect Letterbox::toImage(const cv::Rect2d& box) const {
  const int left = firstPixel((box.x - content.x) / scaleX(), image.width);
  const int right = firstPixel((box.x + box.width - content.x) / scaleX(), image.width);
  const int top = firstPixel((box.y - content.y) / scaleY(), image.height);
  const int bottom = firstPixel((box.y + box.height - content.y) / scaleY(), image.height);
  return {left, top, right - left, bottom - top};
}

Letterbox fitLetterbox(const cv::Size& image, const cv::Size& input) {
  const double scale = std::min(static_cast<double>(input.width) / image.width,
                                static_cast<double>(input.height) / image.height);
  const int width = scaledSide(image.width, scale, input.width);
  const int height = scaledSide(image.height, scale, input.height);
  return {image, input,
          cv::Rect((input.width - width) / 2, (input.height - height) / 2, width, height)};
}

cv::Mat networkInput(const cv::Mat& image, const Letterbox& letterbox) {
  cv::Mat padded(letterbox.input, CV_8UC3, cv::Scalar::all(kPadding));
  cv::Mat content = padded(letterbox.content);
  cv::resize(image, content, letterbox.content.size(), 0.0, 0.0, cv::INTER_LINEAR);
  constexpr bool kSwapToRgb = true;
  return cv::dnn::blobFromImage(padded, 1.0 / 255.0, cv::Size(), cv::Scalar(), kSwapToRgb);
}

}  // namespace occusg
