// SPDX-License-Identifier: BSD-3-Clause
#include "io/label_placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace occusg {
namespace {

/// Centre of the pixels that are not zero.
cv::Point2d centerOf(const cv::Mat& mask) {
  const cv::Moments moments = cv::moments(mask, true);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

/// The pixel nearest to `target` among those of at least `threshold`; the first of equal ones.
cv::Point nearestAtLeast(const cv::Mat& values, float threshold, const cv::Point2d& target) {
  cv::Point best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int y = 0; y < values.rows; ++y) {
    for (int x = 0; x < values.cols; ++x) {
      const double distance = std::hypot(x - target.x, y - target.y);
      if (values.at<float>(y, x) < threshold || distance >= best_distance) continue;
      best = {x, y};
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace

LabelPlace placeLabel(const cv::Mat& mask, const cv::Size2d& size) {
  if (mask.empty() || cv::countNonZero(mask) == 0) return {};
  // Scaled so that the label's box becomes a square of `kSide`: then the chessboard distance to the
  // nearest obstacle is half the side of the largest square around a pixel.
  constexpr double kSide = 12.0;
  const double scale_x = kSide / size.width;
  const double scale_y = kSide / size.height;
  constexpr int kBorder = 1;
  const cv::Size scaled_size(std::max(1, static_cast<int>(std::lround(mask.cols * scale_x))),
                             std::max(1, static_cast<int>(std::lround(mask.rows * scale_y))));
  cv::Mat scaled;
  cv::resize(mask, scaled, scaled_size, 0, 0, cv::INTER_AREA);
  constexpr double kFullyInside = 200.0;
  scaled = scaled > kFullyInside;
  if (cv::countNonZero(scaled) == 0) cv::resize(mask, scaled, scaled_size, 0, 0, cv::INTER_NEAREST);
  if (cv::countNonZero(scaled) == 0) return {centerOf(mask), 0.0};
  cv::copyMakeBorder(scaled, scaled, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT, 0);
  cv::Mat distances;
  cv::distanceTransform(scaled, distances, cv::DIST_C, cv::DIST_MASK_3);
  double largest = 0.0;
  cv::minMaxLoc(distances, nullptr, &largest);
  // Beyond twice the label's size more room is no better place.
  const double enough = std::min(0.9 * largest, kSide);
  const cv::Point best = nearestAtLeast(distances, static_cast<float>(enough), centerOf(scaled));
  return {{(best.x - kBorder + 0.5) * mask.cols / scaled_size.width,
           (best.y - kBorder + 0.5) * mask.rows / scaled_size.height},
          (2.0 * distances.at<float>(best) - 1.0) / kSide};
}

}  // namespace occusg
