// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <string>

#include "occusg/perception/instance_mask.hpp"

namespace occusg {

/// A recorded label image -> one mask for each object in it, by rising object id, score 1.
///
/// Classes are numbered in alphabetical order of the labels. An object `label_of_object` does not
/// name keeps its mask, without a class name. When there are more than `kMaxMasks` objects, or
/// their boxes hold more than 2^26 pixels together, those of the fewest pixels are refused.
/// @param object_ids CV_16UC1: the id of the object per pixel, 0: none.
/// @param label_of_object what each object of the recording is.
/// @throws Error when the image is empty or of another type.
[[nodiscard]] InstanceMasks masksOf(const cv::Mat& object_ids,
                                    const std::map<int, std::string>& label_of_object);

}  // namespace occusg
