// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace occusg {

/// Most storeys an overview shows, from the lowest up: a picture of each takes a tenth of a second.
inline constexpr std::size_t kMostPanels = 16;

/// Puts pictures beside each other on white, row by row from the top left, so that all together are
/// about as wide as they are high. Panels keep their size where a row of them is at most 6400
/// pixels wide, and shrink otherwise.
/// @param panels CV_8UC3, at least one.
/// @return CV_8UC3.
[[nodiscard]] cv::Mat besideEachOther(const std::vector<cv::Mat>& panels);

}  // namespace occusg
