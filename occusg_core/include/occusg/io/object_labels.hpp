// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <string>

namespace occusg {

/// Most objects a recording may name: one a value of a 16-bit label image.
inline constexpr std::size_t kMaxLabelledObjects = 65'535;

/// What the objects of a recording are: "objects": [{"id", "label"}] of its `rooms.json`; empty
/// when it has none. Other keys are ignored.
/// @throws Error naming the object and the value that cannot be used: an id outside 1..65535 or
/// given twice, an empty or too long label; or when the file cannot be read.
[[nodiscard]] std::map<int, std::string> readObjectLabels(const std::string& path);

/// A label image of a recording, CV_16UC1: the id of the object per pixel, 0: none.
/// @throws Error when it cannot be read or is not a PNG of 16 bits and one channel.
[[nodiscard]] cv::Mat readLabelImage(const std::string& path);

}  // namespace occusg
