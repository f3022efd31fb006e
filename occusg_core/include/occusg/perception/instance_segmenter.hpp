// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "occusg/perception/instance_mask.hpp"

namespace occusg {

/// Finds objects in colour images.
class InstanceSegmenter {
 public:
  InstanceSegmenter() = default;
  InstanceSegmenter(const InstanceSegmenter&) = delete;
  InstanceSegmenter(InstanceSegmenter&&) = delete;
  InstanceSegmenter& operator=(const InstanceSegmenter&) = delete;
  InstanceSegmenter& operator=(InstanceSegmenter&&) = delete;
  virtual ~InstanceSegmenter() = default;

  /// @param image CV_8UC3, BGR.
  /// @return at most `kMaxMasks` masks, best score first. Equal images give equal masks.
  /// @throws Error when the image cannot be used or inference fails.
  [[nodiscard]] virtual InstanceMasks segment(const cv::Mat& image) = 0;
};

}  // namespace occusg
