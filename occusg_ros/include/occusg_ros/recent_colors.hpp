// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <cstddef>
#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <utility>

namespace occusg_ros {

/// The last colour images of a bag, to be found by the stamp of a depth image.
///
///     RecentColors colors("/camera/rgb/image_color");
///     colors.add(message);
///     if (const auto picture = colors.at(depth_stamp_s)) segmenter.segment(*picture);
class RecentColors {
 public:
  /// Largest difference between the stamps of a colour and a depth image of one view [s].
  static constexpr double kTolerance_s = 0.05;

  /// @param topic opens every sentence.
  explicit RecentColors(std::string topic) : topic_(std::move(topic)) {}

  void add(const sensor_msgs::ImageConstPtr& image);
  /// The same of the transport compressed: JPEG or PNG.
  void add(const sensor_msgs::CompressedImageConstPtr& image);

  /// Whether an image of that time may still come, given that they come in order.
  [[nodiscard]] bool mayStillCome(double stamp_s) const;

  /// The picture nearest in time, CV_8UC3 in the order BGR; none within the tolerance: empty.
  /// @throws occusg::Error when it cannot be decoded or is larger than 100 megapixels.
  [[nodiscard]] std::optional<cv::Mat> at(double stamp_s) const;

 private:
  struct Color {
    double stamp_s = 0.0;
    sensor_msgs::ImageConstPtr plain;  ///< Either this or the next.
    sensor_msgs::CompressedImageConstPtr compressed;
  };
  static constexpr std::size_t kKept = 60;

  void add(Color color);

  std::string topic_;
  std::deque<Color> colors_;
};

}  // namespace occusg_ros
