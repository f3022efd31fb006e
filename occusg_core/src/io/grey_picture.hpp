// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>

namespace occusg {

/// Reads an 8-bit grey picture, PGM (binary or plain) or PNG. Its size is known and checked before
/// anything of its size is allocated.
/// @return CV_8UC1, the first row on top.
/// @throws Error naming the file and what it is instead, or its size when it has more than
/// `max_pixels`.
[[nodiscard]] cv::Mat readGreyPicture(const std::string& path, std::size_t max_pixels);

}  // namespace occusg
