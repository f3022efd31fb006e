// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "regions/dude_candidates.hpp"

namespace occusg {

Grid<std::int32_t> squaredClearance(const Grid<std::uint8_t>& open) {
  Grid<std::int32_t> squared(open.box(), 0);
  if (open.empty()) return squared;
  const int width = open.box().width();
  const int height = open.box().height();
  // A closed margin, for the transform knows no outside.
  cv::Mat padded(height + 2, width + 2, CV_8U, cv::Scalar(0));
  for (int row = 0; row < height; ++row) {
    const std::uint8_t* source = &open.at({open.box().min.x, open.box().min.y + row});
    std::copy(source, source + width, padded.ptr<std::uint8_t>(row + 1) + 1);
  }
  cv::Mat distances;
  cv::distanceTransform(padded, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  for (int row = 0; row < height; ++row) {
    const auto* source = distances.ptr<float>(row + 1) + 1;
    std::int32_t* target = &squared.at({open.box().min.x, open.box().min.y + row});
    // Back to the integer the root was taken of, so that equal places compare equal.
    for (int i = 0; i < width; ++i) {
      target[i] =
          static_cast<std::int32_t>(std::lround(static_cast<double>(source[i]) * source[i]));
    }
  }
  return squared;
}

}  // namespace occusg
