// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/recent_colors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "occusg/io/color_image.hpp"
#include "occusg_ros/image_conversions.hpp"

namespace occusg_ros {

void RecentColors::add(Color color) {
  colors_.push_back(std::move(color));
  if (colors_.size() > kKept) colors_.pop_front();
}

void RecentColors::add(const sensor_msgs::ImageConstPtr& image) {
  add(Color{image->header.stamp.toSec(), image, nullptr});
}

void RecentColors::add(const sensor_msgs::CompressedImageConstPtr& image) {
  add(Color{image->header.stamp.toSec(), nullptr, image});
}

bool RecentColors::mayStillCome(double stamp_s) const {
  return colors_.empty() || colors_.back().stamp_s < stamp_s;
}

std::optional<cv::Mat> RecentColors::at(double stamp_s) const {
  const auto nearest =
      std::min_element(colors_.begin(), colors_.end(), [stamp_s](const Color& a, const Color& b) {
        return std::abs(a.stamp_s - stamp_s) < std::abs(b.stamp_s - stamp_s);
      });
  if (nearest == colors_.end() || std::abs(nearest->stamp_s - stamp_s) > kTolerance_s) return {};
  if (nearest->plain) return toColorImage(*nearest->plain, topic_);
  const std::vector<std::uint8_t>& data = nearest->compressed->data;
  return occusg::decodeColorImage(std::string(data.begin(), data.end()), topic_);
}

}  // namespace occusg_ros
