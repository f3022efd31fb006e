// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>

namespace occusg {

/// A decoded picture.
struct PortableMap {
  cv::Mat pixels;  ///< CV_8UC1, or CV_8UC3 for a pixel map.
  /// Values above `largest`, which the header gives; they were read as that.
  std::size_t clipped_values = 0;
  int largest = 255;
  std::size_t left_over_bytes = 0;  ///< Behind the last pixel of a binary map; blanks are none.
};

/// Reads a portable bit, grey or pixel map (netpbm: P1 to P6), binary or plain, any largest value.
/// Values are scaled to 0..255; a set bit is black.
/// @param beginning the first bytes of the file, its header among them.
/// @throws Error naming the file.
[[nodiscard]] PortableMap readPortableMap(const std::string& path, const std::string& beginning,
                                          std::size_t max_pixels);

}  // namespace occusg
