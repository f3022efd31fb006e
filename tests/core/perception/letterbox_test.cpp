// SPDX-License-Identifier: BSD-3-Clause
#include "perception/letterbox.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

namespace occusg {
namespace {

TEST(Letterbox, WideImageIsPaddedAboveAndBelow) {
  const Letterbox box = fitLetterbox({128, 96}, {64, 64});
  EXPECT_EQ(box.content, cv::Rect(0, 8, 64, 48));
  EXPECT_EQ(box.scaleX(), 0.5);
  EXPECT_EQ(box.scaleY(), 0.5);
}

TEST(Letterbox, TallImageIsPaddedLeftAndRight) {
  EXPECT_EQ(fitLetterbox({30, 60}, {64, 64}).content, cv::Rect(16, 0, 32, 64));
}

TEST(Letterbox, ExtremeImageKeepsAPixel) {
  EXPECT_EQ(fitLetterbox({16384, 1}, {64, 64}).content, cv::Rect(0, 31, 64, 1));
}

TEST(Letterbox, BoxInTheInputIsThePixelsOfTheImageWithTheirCentreInIt) {
  const Letterbox box = fitLetterbox({128, 96}, {64, 64});
  EXPECT_EQ(box.toImage({8, 16, 24, 32}), cv::Rect(16, 16, 48, 64));
  // From x = 0.5 to 1.5 in the image: only the centre at 0.5 is in it.
  EXPECT_EQ(box.toImage({0.25, 8, 0.5, 1}), cv::Rect(0, 0, 1, 2));
}

TEST(Letterbox, BoxIsClippedToTheImage) {
  const Letterbox box = fitLetterbox({128, 96}, {64, 64});
  EXPECT_EQ(box.toImage({-1e30, -1e30, 2e30, 2e30}), cv::Rect(0, 0, 128, 96));
  EXPECT_TRUE(box.toImage({0, 0, 64, 8}).empty()) << "lies in the padding";
  EXPECT_TRUE(box.toImage({-50, 20, 30, 10}).empty());
}

TEST(Letterbox, NetworkInputIsRgbInZeroToOneWithGreyPadding) {
  const cv::Mat image(96, 128, CV_8UC3, cv::Scalar(51, 102, 255));
  const cv::Mat input = networkInput(image, fitLetterbox(image.size(), {64, 64}));
  ASSERT_EQ(input.dims, 4);
  ASSERT_EQ(input.total(), 3U * 64U * 64U);
  const auto at = [&](int channel, int y, int x) {
    return input.ptr<float>(0, channel)[y * 64 + x];
  };
  EXPECT_FLOAT_EQ(at(0, 32, 10), 1.0F);
  EXPECT_FLOAT_EQ(at(1, 32, 10), 0.4F);
  EXPECT_FLOAT_EQ(at(2, 32, 10), 0.2F);
  for (const int padding : {0, 7, 56, 63}) EXPECT_FLOAT_EQ(at(0, padding, 10), 114.0F / 255.0F);
  EXPECT_FLOAT_EQ(at(0, 8, 10), 1.0F);
  EXPECT_FLOAT_EQ(at(0, 55, 10), 1.0F);
}

}  // namespace
}  // namespace occusg
