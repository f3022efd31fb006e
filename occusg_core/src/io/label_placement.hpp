// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

namespace occusg {

/// Where a label goes and how large it may be.
struct LabelPlace {
  cv::Point2d center;  ///< Pixels of the mask.
  double fit = 0.0;    ///< Largest factor by which the label still fits; below 1 it does not fit.
};

/// The place for a label of `size` pixels inside `mask` (not zero: room for it): where the largest
/// box of the label's shape fits, and of the places that are nearly as good the one nearest to the
/// centre of the mask. Fit zero when the mask is empty.
[[nodiscard]] LabelPlace placeLabel(const cv::Mat& mask, const cv::Size2d& size);

}  // namespace occusg
