// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/recent_colors.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

sensor_msgs::ImageConstPtr plain(double stamp_s, std::uint8_t blue) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->header.stamp.fromSec(stamp_s);
  image->width = 2;
  image->height = 1;
  image->encoding = "bgr8";
  image->step = 6;
  image->data = {blue, 0, 0, blue, 0, 0};
  return image;
}

sensor_msgs::CompressedImageConstPtr compressed(double stamp_s, const std::string& extension) {
  auto image = boost::make_shared<sensor_msgs::CompressedImage>();
  image->header.stamp.fromSec(stamp_s);
  cv::imencode(extension, cv::Mat(8, 8, CV_8UC3, cv::Scalar(0, 0, 200)), image->data);
  return image;
}

TEST(RecentColors, NearestWithinTheToleranceIsFound) {
  RecentColors colors("/rgb");
  EXPECT_FALSE(colors.at(10.0));
  colors.add(plain(10.0, 1));
  colors.add(plain(10.04, 2));
  EXPECT_EQ(colors.at(10.03)->at<cv::Vec3b>(0, 0)[0], 2);
  EXPECT_EQ(colors.at(9.96)->at<cv::Vec3b>(0, 0)[0], 1);
  EXPECT_FALSE(colors.at(10.1)) << "the last is too old";
}

TEST(RecentColors, OneIsWaitedForUntilALaterOneIsThere) {
  RecentColors colors("/rgb");
  EXPECT_TRUE(colors.mayStillCome(10.0));
  colors.add(plain(9.99, 1));
  EXPECT_TRUE(colors.mayStillCome(10.0));
  colors.add(plain(10.02, 2));
  EXPECT_FALSE(colors.mayStillCome(10.0));
}

TEST(RecentColors, CompressedPicturesAreDecoded) {
  RecentColors colors("/rgb/compressed");
  colors.add(compressed(10.0, ".jpg"));
  colors.add(compressed(11.0, ".png"));
  EXPECT_NEAR(colors.at(10.0)->at<cv::Vec3b>(4, 4)[2], 200, 3);
  EXPECT_EQ(colors.at(11.0)->at<cv::Vec3b>(4, 4)[2], 200);
  auto broken = boost::make_shared<sensor_msgs::CompressedImage>();
  broken->header.stamp.fromSec(12.0);
  broken->data = {1, 2, 3};
  colors.add(sensor_msgs::CompressedImageConstPtr(broken));
  EXPECT_THROW((void)colors.at(12.0), occusg::Error);
}

TEST(RecentColors, PictureThatUnpacksToGigabytesIsRefusedByItsHeader) {
  auto bomb = boost::make_shared<sensor_msgs::CompressedImage>(*compressed(10.0, ".png"));
  for (const std::size_t side : {16U, 20U}) {  // width and height in the header, big endian
    bomb->data[side] = 0;
    bomb->data[side + 1] = 1;
  }
  RecentColors colors("/rgb/compressed");
  colors.add(sensor_msgs::CompressedImageConstPtr(bomb));
  EXPECT_THROW((void)colors.at(10.0), occusg::Error);
}

TEST(RecentColors, MemoryIsBounded) {
  RecentColors colors("/rgb");
  for (int i = 0; i < 1000; ++i) colors.add(plain(i, 1));
  EXPECT_FALSE(colors.at(900.0));
  EXPECT_TRUE(colors.at(999.0));
}

}  // namespace
}  // namespace occusg_ros
