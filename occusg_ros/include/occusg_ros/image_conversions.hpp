// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

#include <opencv2/core/mat.hpp>
#include <string>

#include "occusg/perception/camera_model.hpp"
#include "occusg/perception/depth_projector.hpp"

namespace occusg_ros {

inline constexpr double kMillimetresPerMetre = 1000.0;

/// The depth image in `image` (REP 118: 32FC1 in metres or 16UC1 in millimetres), without a copy:
/// its pixels are those of the message, which must outlive it.
/// @param where opens every sentence; the topic.
/// @param units_per_m value of one metre in a 16UC1 image; 1000 but for cameras that keep to no REP
/// (L515: 4000).
/// @throws occusg::Error, before anything is allocated, when encoding, byte order, size, step or
/// the amount of data do not fit.
[[nodiscard]] occusg::DepthImage toDepthImage(const sensor_msgs::Image& image,
                                              const std::string& where,
                                              double units_per_m = kMillimetresPerMetre);

/// The colour image in `image` as CV_8UC3, BGR; encodings bgr8, rgb8, bgra8, rgba8 and mono8.
/// @throws occusg::Error as `toDepthImage`.
[[nodiscard]] cv::Mat toColorImage(const sensor_msgs::Image& image, const std::string& where);

/// `pixels` as a message, its pixels copied row by row.
/// @param encoding one of sensor_msgs/image_encodings.h, of the type of `pixels`.
[[nodiscard]] sensor_msgs::Image imageMsg(const cv::Mat& pixels, const std::string& encoding,
                                          const std_msgs::Header& header);

/// The intrinsics of the rectified image: those of P, or of K where P is not given; binning and
/// region of interest taken into account.
/// @throws occusg::Error when they are not those of a camera.
[[nodiscard]] occusg::CameraModel toCameraModel(const sensor_msgs::CameraInfo& info,
                                                const std::string& where);

}  // namespace occusg_ros
