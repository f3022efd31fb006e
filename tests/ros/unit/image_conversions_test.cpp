// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/image_conversions.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

sensor_msgs::Image depthImage(std::uint32_t width, std::uint32_t height,
                              const std::string& encoding, std::uint32_t pixel_bytes) {
  sensor_msgs::Image image;
  image.encoding = encoding;
  image.width = width;
  image.height = height;
  image.step = width * pixel_bytes;
  image.data.resize(std::size_t{image.step} * height);
  return image;
}

sensor_msgs::CameraInfo goodInfo() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.K = {500.0, 0.0, 320.0, 0.0, 510.0, 240.0, 0.0, 0.0, 1.0};
  return info;
}

template <typename Call>
std::string refusalOf(const Call& call) {
  try {
    call();
  } catch (const occusg::Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusalOf(const sensor_msgs::Image& image) {
  return refusalOf([&] { (void)toDepthImage(image, "depth"); });
}

std::string refusalOf(const sensor_msgs::CameraInfo& info) {
  return refusalOf([&] { (void)toCameraModel(info, "info"); });
}

TEST(ImageConversions, MillimetresAndMetresGiveTheSameDepth) {
  sensor_msgs::Image millimetres = depthImage(2, 1, "16UC1", 2);
  const std::uint16_t raw = 1500;
  std::memcpy(&millimetres.data[2], &raw, sizeof(raw));
  sensor_msgs::Image metres = depthImage(2, 1, "32FC1", 4);
  const float metre = 1.5F;
  std::memcpy(&metres.data[4], &metre, sizeof(metre));

  const occusg::DepthImage a = toDepthImage(millimetres, "depth");
  const occusg::DepthImage b = toDepthImage(metres, "depth");
  EXPECT_DOUBLE_EQ(a.pixels.at<std::uint16_t>(0, 1) / a.units_per_m, 1.5);
  EXPECT_DOUBLE_EQ(b.pixels.at<float>(0, 1) / b.units_per_m, 1.5);
}

TEST(ImageConversions, RowsLongerThanThePixelsAreHonoured) {
  sensor_msgs::Image image = depthImage(2, 2, "16UC1", 2);
  image.step = 10;
  image.data.assign(20, 0);
  const std::uint16_t raw = 700;
  std::memcpy(&image.data[10], &raw, sizeof(raw));
  EXPECT_EQ(toDepthImage(image, "depth").pixels.at<std::uint16_t>(1, 0), 700);
}

TEST(ImageConversions, FailureMode02ImagesThatDoNotFitAreRefusedBeforeAnythingIsAllocated) {
  EXPECT_NE(refusalOf(depthImage(4, 4, "rgb8", 3)).find("rgb8"), std::string::npos);

  sensor_msgs::Image short_of_data = depthImage(4, 4, "32FC1", 4);
  short_of_data.data.resize(63);
  EXPECT_NE(refusalOf(short_of_data).find("63 bytes"), std::string::npos);

  sensor_msgs::Image short_step = depthImage(4, 4, "32FC1", 4);
  short_step.step = 8;
  EXPECT_NE(refusalOf(short_step).find("step"), std::string::npos);

  sensor_msgs::Image odd_step = depthImage(4, 4, "32FC1", 4);
  odd_step.step = 17;
  odd_step.data.resize(68);
  EXPECT_NE(refusalOf(odd_step).find("step"), std::string::npos);

  sensor_msgs::Image big_endian = depthImage(4, 4, "16UC1", 2);
  big_endian.is_bigendian = 1;
  EXPECT_NE(refusalOf(big_endian).find("big-endian"), std::string::npos);

  EXPECT_NE(refusalOf(depthImage(0, 0, "16UC1", 2)), "accepted");

  sensor_msgs::Image huge;
  huge.encoding = "32FC1";
  huge.width = huge.height = 65535;
  huge.step = 4 * huge.width;
  EXPECT_NE(refusalOf(huge).find("65535"), std::string::npos);
}

TEST(ImageConversions, ColourComesOutAsBgr) {
  sensor_msgs::Image image = depthImage(1, 1, "rgb8", 3);
  image.data = {10, 20, 30};
  EXPECT_EQ(toColorImage(image, "rgb").at<cv::Vec3b>(0, 0), cv::Vec3b(30, 20, 10));
  image.encoding = "bayer_rggb8";
  EXPECT_NE(refusalOf([&] { (void)toColorImage(image, "rgb"); }).find("bayer"), std::string::npos);
}

TEST(ImageConversions, ProjectionGoesBeforeIntrinsics) {
  sensor_msgs::CameraInfo info = goodInfo();
  EXPECT_DOUBLE_EQ(toCameraModel(info, "info").fy, 510.0);
  info.P = {400.0, 0.0, 310.0, 0.0, 0.0, 410.0, 230.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  const occusg::CameraModel camera = toCameraModel(info, "info");
  EXPECT_DOUBLE_EQ(camera.fx, 400.0);
  EXPECT_DOUBLE_EQ(camera.cy, 230.0);
}

TEST(ImageConversions, BinningAndRegionOfInterestAreThoseOfTheImage) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.binning_x = info.binning_y = 2;
  info.roi.x_offset = 100;
  info.roi.width = 400;
  info.roi.height = 480;
  const occusg::CameraModel camera = toCameraModel(info, "info");
  EXPECT_EQ(camera.width, 200);
  EXPECT_EQ(camera.height, 240);
  EXPECT_DOUBLE_EQ(camera.fx, 250.0);
  EXPECT_DOUBLE_EQ(camera.cx, 110.0);
}

TEST(ImageConversions, FailureMode03CameraInfoThatIsNoCameraIsRefused) {
  EXPECT_EQ(refusalOf(goodInfo()), "accepted");
  for (const double focal : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    sensor_msgs::CameraInfo info = goodInfo();
    info.K[0] = focal;
    EXPECT_NE(refusalOf(info), "accepted") << focal;
  }
  sensor_msgs::CameraInfo outside = goodInfo();
  outside.K[2] = 1000.0;
  EXPECT_NE(refusalOf(outside), "accepted");
  EXPECT_NE(refusalOf(sensor_msgs::CameraInfo()), "accepted");
  sensor_msgs::CameraInfo not_a_number = goodInfo();
  not_a_number.P[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusalOf(not_a_number), "accepted");
}

}  // namespace
}  // namespace occusg_ros
