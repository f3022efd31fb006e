// SPDX-License-Identifier: BSD-3-Clause
#include "io/storeys_picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace occusg {
namespace {

constexpr int kMostWidth_px = 6400;
const cv::Scalar kWhite(255, 255, 255);

cv::Size largestOf(const std::vector<cv::Mat>& panels) {
  cv::Size largest(1, 1);
  for (const cv::Mat& panel : panels)
    largest = {std::max(largest.width, panel.cols), std::max(largest.height, panel.rows)};
  return largest;
}

}  // namespace

cv::Mat besideEachOther(const std::vector<cv::Mat>& panels) {
  const auto count = static_cast<int>(panels.size());
  const cv::Size panel = largestOf(panels);
  const double shape = static_cast<double>(panel.height) / panel.width;
  const int columns =
      std::clamp(static_cast<int>(std::lround(std::sqrt(count * shape))), 1, std::max(1, count));
  const int rows = (count + columns - 1) / columns;
  const double scale = std::min(1.0, static_cast<double>(kMostWidth_px) / (columns * panel.width));
  const cv::Size place(std::max(1, static_cast<int>(scale * panel.width)),
                       std::max(1, static_cast<int>(scale * panel.height)));
  cv::Mat picture(rows * place.height, columns * place.width, CV_8UC3, kWhite);
  for (int i = 0; i < count; ++i) {
    cv::Mat shown = panels[static_cast<std::size_t>(i)];
    if (scale < 1.0) cv::resize(shown, shown, {}, scale, scale, cv::INTER_AREA);
    const cv::Size size(std::min(shown.cols, place.width), std::min(shown.rows, place.height));
    const cv::Point corner((i % columns) * place.width, (i / columns) * place.height);
    shown(cv::Rect({0, 0}, size)).copyTo(picture(cv::Rect(corner, size)));
  }
  return picture;
}

}  // namespace occusg
