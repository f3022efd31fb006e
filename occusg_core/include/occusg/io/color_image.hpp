// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace occusg {

/// A colour image of a recording: PNG, JPEG, BMP or a portable map, as CV_8UC3 in the order blue,
/// green, red.
/// @throws Error naming the file when it is missing, no regular file, no complete picture, or
/// larger than 100 megapixels.
[[nodiscard]] cv::Mat readColorImage(const std::string& path);

/// The same of the bytes of such a file.
/// @param where opens every sentence.
[[nodiscard]] cv::Mat decodeColorImage(const std::string& bytes, const std::string& where);

}  // namespace occusg
