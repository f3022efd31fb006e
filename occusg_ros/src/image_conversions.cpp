// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/image_conversions.hpp"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <opencv2/imgproc.hpp>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

namespace enc = sensor_msgs::image_encodings;
using occusg::refuse;

// A view of the message's pixels; the core never writes to them.
cv::Mat viewOf(const sensor_msgs::Image& image, int type, const std::string& where) {
  const auto max_side = static_cast<std::uint32_t>(occusg::kMaxImageSide);
  if (image.width == 0 || image.height == 0 || image.width > max_side || image.height > max_side) {
    throw refuse(
        where, "the image is " + std::to_string(image.width) + " x " + std::to_string(image.height),
        "sides of 1 to " + std::to_string(max_side) + " pixels are allowed");
  }
  const std::size_t pixel_bytes = CV_ELEM_SIZE(type);
  const std::size_t row_bytes = pixel_bytes * image.width;
  if (image.step < row_bytes || image.step % CV_ELEM_SIZE1(type) != 0) {
    throw refuse(where, "its step is " + std::to_string(image.step) + " bytes",
                 "a row needs " + std::to_string(row_bytes));
  }
  const std::size_t bytes = std::size_t{image.step} * image.height;
  if (image.data.size() != bytes) {
    throw refuse(where, "it carries " + std::to_string(image.data.size()) + " bytes",
                 "step times height is " + std::to_string(bytes));
  }
  if (image.is_bigendian != 0 && CV_ELEM_SIZE1(type) > 1)
    throw refuse(where, "its pixels are big-endian", "little-endian ones are needed");
  return {static_cast<int>(image.height), static_cast<int>(image.width), type,
          const_cast<std::uint8_t*>(image.data.data()), image.step};
}

}  // namespace

occusg::DepthImage toDepthImage(const sensor_msgs::Image& image, const std::string& where,
                                double units_per_m) {
  if (image.encoding == enc::TYPE_16UC1 || image.encoding == enc::MONO16)
    return {viewOf(image, CV_16UC1, where), units_per_m};
  if (image.encoding == enc::TYPE_32FC1) return {viewOf(image, CV_32FC1, where), 1.0};
  throw refuse(where, "its encoding is '" + image.encoding.substr(0, 40) + "'",
               "a depth image is 32FC1 in metres or 16UC1");
}

cv::Mat toColorImage(const sensor_msgs::Image& image, const std::string& where) {
  struct Conversion {
    int type;
    int code;  ///< Of cv::cvtColor; negative: none needed.
  };
  static const std::map<std::string, Conversion> kConversions = {
      {enc::BGR8, {CV_8UC3, -1}},
      {enc::RGB8, {CV_8UC3, cv::COLOR_RGB2BGR}},
      {enc::BGRA8, {CV_8UC4, cv::COLOR_BGRA2BGR}},
      {enc::RGBA8, {CV_8UC4, cv::COLOR_RGBA2BGR}},
      {enc::MONO8, {CV_8UC1, cv::COLOR_GRAY2BGR}}};
  const auto found = kConversions.find(image.encoding);
  if (found == kConversions.end()) {
    throw refuse(where, "its encoding is '" + image.encoding.substr(0, 40) + "'",
                 "a colour image is bgr8, rgb8, bgra8, rgba8 or mono8");
  }
  const cv::Mat view = viewOf(image, found->second.type, where);
  if (found->second.code < 0) return view.clone();
  cv::Mat bgr;
  cv::cvtColor(view, bgr, found->second.code);
  return bgr;
}

sensor_msgs::Image imageMsg(const cv::Mat& pixels, const std::string& encoding,
                            const std_msgs::Header& header) {
  sensor_msgs::Image image;
  image.header = header;
  image.encoding = encoding;
  image.width = static_cast<std::uint32_t>(pixels.cols);
  image.height = static_cast<std::uint32_t>(pixels.rows);
  image.step = static_cast<std::uint32_t>(pixels.cols * pixels.elemSize());
  image.data.resize(std::size_t{image.step} * image.height);
  for (int row = 0; row < pixels.rows; ++row) {
    std::memcpy(&image.data[static_cast<std::size_t>(row) * image.step], pixels.ptr(row),
                image.step);
  }
  return image;
}

occusg::CameraModel toCameraModel(const sensor_msgs::CameraInfo& info, const std::string& where) {
  const bool has_projection = info.P[0] != 0.0;
  const double bin_x = std::max<std::uint32_t>(info.binning_x, 1);
  const double bin_y = std::max<std::uint32_t>(info.binning_y, 1);
  const std::uint32_t width = info.roi.width > 0 ? info.roi.width : info.width;
  const std::uint32_t height = info.roi.height > 0 ? info.roi.height : info.height;
  const auto side = [](std::uint32_t pixels, double binning) {
    // Beyond every limit `check` knows, but still an int.
    return static_cast<int>(std::min(pixels / binning, 1e9));
  };
  occusg::CameraModel camera;
  camera.width = side(width, bin_x);
  camera.height = side(height, bin_y);
  camera.fx = (has_projection ? info.P[0] : info.K[0]) / bin_x;
  camera.fy = (has_projection ? info.P[5] : info.K[4]) / bin_y;
  camera.cx = ((has_projection ? info.P[2] : info.K[2]) - info.roi.x_offset) / bin_x;
  camera.cy = ((has_projection ? info.P[6] : info.K[5]) - info.roi.y_offset) / bin_y;
  check(camera, where);
  return camera;
}

}  // namespace occusg_ros
