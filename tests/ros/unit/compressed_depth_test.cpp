// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/compressed_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "occusg/error.hpp"
#include "occusg_ros/image_conversions.hpp"

namespace occusg_ros {
namespace {

/// As compressed_depth_image_transport writes it: a format number and two parameters, then a PNG.
sensor_msgs::CompressedImage compressed(const cv::Mat& pixels, const std::string& format, float a,
                                        float b) {
  sensor_msgs::CompressedImage message;
  message.format = format;
  std::vector<unsigned char> png;
  cv::imencode(".png", pixels, png);
  message.data.resize(12);
  std::memcpy(&message.data[4], &a, sizeof(a));
  std::memcpy(&message.data[8], &b, sizeof(b));
  message.data.insert(message.data.end(), png.begin(), png.end());
  return message;
}

TEST(CompressedDepth, SixteenBitsComeBackAsTheyWere) {
  cv::Mat pixels(3, 4, CV_16UC1, cv::Scalar(1234));
  pixels.at<std::uint16_t>(1, 2) = 0;
  const sensor_msgs::Image image =
      decompressedDepth(compressed(pixels, "16UC1; compressedDepth png", 0.0F, 0.0F), "/depth");
  const occusg::DepthImage depth = toDepthImage(image, "/depth");
  EXPECT_EQ(depth.pixels.at<std::uint16_t>(0, 0), 1234);
  EXPECT_EQ(depth.pixels.at<std::uint16_t>(1, 2), 0);
  EXPECT_EQ(depth.pixels.size(), cv::Size(4, 3));
}

TEST(CompressedDepth, QuantisedInverseDepthComesBackInMetres) {
  // The transport's own numbers for a range of 10 m and a step of 0.01 m at 1 m.
  const float a = 100.0F * (100.0F + 1.0F);
  const float b = 1.0F - a / 10.0F;
  const float metres = 2.5F;
  cv::Mat pixels(2, 2, CV_16UC1, cv::Scalar(0));
  pixels.at<std::uint16_t>(0, 0) = static_cast<std::uint16_t>(a / metres + b);
  const sensor_msgs::Image image =
      decompressedDepth(compressed(pixels, "32FC1; compressedDepth", a, b), "/depth");
  const occusg::DepthImage depth = toDepthImage(image, "/depth");
  EXPECT_NEAR(depth.pixels.at<float>(0, 0), metres, 0.01);
  EXPECT_TRUE(std::isnan(depth.pixels.at<float>(1, 1)));
}

TEST(CompressedDepth, WhatIsNoneIsRefusedInOneSentence) {
  const cv::Mat pixels(2, 2, CV_16UC1, cv::Scalar(7));
  sensor_msgs::CompressedImage message =
      compressed(pixels, "16UC1; compressedDepth rvl", 0.0F, 0.0F);
  EXPECT_THROW((void)decompressedDepth(message, "/depth"), occusg::Error);
  message.format = "16UC1; compressedDepth";
  for (const std::size_t bytes : {0U, 5U, 12U, 20U, 60U}) {
    sensor_msgs::CompressedImage cut = message;
    cut.data.resize(bytes);
    EXPECT_THROW((void)decompressedDepth(cut, "/depth"), occusg::Error) << bytes;
  }
  const cv::Mat colour(2, 2, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_THROW((void)decompressedDepth(compressed(colour, "bgr8; compressedDepth", 0, 0), "/depth"),
               occusg::Error);
}

}  // namespace
}  // namespace occusg_ros
