// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/compressed_depth.hpp"

#include <sensor_msgs/image_encodings.h>

#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/io/png_check.hpp"
#include "occusg_ros/image_conversions.hpp"
#include "occusg_ros/shown_text.hpp"

namespace occusg_ros {
namespace {

namespace enc = sensor_msgs::image_encodings;

/// What stands before the PNG: a format number and two parameters of the quantisation.
constexpr std::size_t kHeaderBytes = 12;

float parameterAt(const std::vector<std::uint8_t>& data, std::size_t offset) {
  float value = 0.0F;
  std::memcpy(&value, &data[offset], sizeof(value));
  return value;
}

cv::Mat pixelsOf(const std::vector<std::uint8_t>& data, std::size_t offset,
                 const std::string& where) {
  const std::string bytes(data.begin() + static_cast<std::ptrdiff_t>(offset), data.end());
  const occusg::PngHeader header = occusg::checkPng(bytes, where);
  if (header.bit_depth != 16 || header.channels != 1)
    throw occusg::refuse(where, "its PNG is no depth image", "16 bits and one channel are needed");
  const std::vector<std::uint8_t> png(bytes.begin(), bytes.end());
  cv::Mat pixels = cv::imdecode(png, cv::IMREAD_UNCHANGED);
  if (pixels.type() != CV_16UC1)
    throw occusg::refuse(where, "its PNG cannot be decoded", "a complete one is needed");
  return pixels;
}

/// Metres of quantised inverse depths.
cv::Mat metresOf(const cv::Mat& quantised, float a, float b) {
  cv::Mat metres(quantised.size(), CV_32FC1);
  for (int v = 0; v < quantised.rows; ++v) {
    for (int u = 0; u < quantised.cols; ++u) {
      const std::uint16_t value = quantised.at<std::uint16_t>(v, u);
      metres.at<float>(v, u) = value == 0 ? std::numeric_limits<float>::quiet_NaN()
                                          : a / (static_cast<float>(value) - b);
    }
  }
  return metres;
}

}  // namespace

sensor_msgs::Image decompressedDepth(const sensor_msgs::CompressedImage& message,
                                     const std::string& where) {
  const bool is_float = message.format.rfind(enc::TYPE_32FC1, 0) == 0;
  const bool has_header = message.format.find("compressedDepth") != std::string::npos;
  if (message.format.find("rvl") != std::string::npos) {
    throw occusg::refuse(where, "its format is '" + shownName(message.format) + "'",
                         "PNG is read; 'rosrun image_transport republish compressedDepth' makes "
                         "plain images of it");
  }
  if (!has_header)
    return imageMsg(pixelsOf(message.data, 0, where), enc::TYPE_16UC1, message.header);
  if (message.data.size() <= kHeaderBytes)
    throw occusg::refuse(where, "it has no data", "a PNG after 12 bytes is needed");
  const cv::Mat pixels = pixelsOf(message.data, kHeaderBytes, where);
  if (!is_float) return imageMsg(pixels, enc::TYPE_16UC1, message.header);
  return imageMsg(metresOf(pixels, parameterAt(message.data, 4), parameterAt(message.data, 8)),
                  enc::TYPE_32FC1, message.header);
}

}  // namespace occusg_ros
