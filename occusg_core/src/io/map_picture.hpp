// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace occusg {

/// The picture of a 2D map, the first row on top.
struct MapPicture {
  cv::Mat grey;   ///< CV_8UC1, the mean of the colour channels.
  cv::Mat alpha;  ///< CV_8UC1; empty for a picture that is opaque everywhere.
  std::vector<std::string> assumptions;  ///< Under which it was read, a sentence each.
};

/// @throws Error naming the file and what it is instead, unless its first bytes are a picture's.
void requirePicture(const std::string& path);

/// Reads a picture as `map_server` does: PNG, PGM, PPM and PBM (binary or plain), BMP and JPEG;
/// grey, with a palette or in colour, 1 to 16 bits a channel (the 8 highest count), with alpha or
/// without. Its size is known and checked before anything of its size is allocated.
/// @throws Error naming the file and what it is instead, or its size when it has more than
/// `max_pixels`.
[[nodiscard]] MapPicture readMapPicture(const std::string& path, std::size_t max_pixels);

}  // namespace occusg
