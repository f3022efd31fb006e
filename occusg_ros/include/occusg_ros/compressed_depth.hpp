// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <string>

namespace occusg_ros {

/// The depth image in a message of the transports compressedDepth (PNG; for 32FC1 its quantised
/// inverse depth, as compressed_depth_image_transport writes it) or compressed (PNG of 16 bits).
/// @param where opens every sentence; the topic.
/// @throws occusg::Error when the format is another, or the data are no complete PNG of 16 bits.
[[nodiscard]] sensor_msgs::Image decompressedDepth(const sensor_msgs::CompressedImage& message,
                                                   const std::string& where);

}  // namespace occusg_ros
