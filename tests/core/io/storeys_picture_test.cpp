// SPDX-License-Identifier: BSD-3-Clause
#include "io/storeys_picture.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

namespace occusg {
namespace {

cv::Mat grey(int width, int height, int value) {
  return {height, width, CV_8UC3, cv::Scalar::all(value)};
}

int valueAt(const cv::Mat& picture, int x, int y) { return picture.at<cv::Vec3b>(y, x)[0]; }

TEST(StoreysPicture, FourSquarePanelsMakeTwoRowsFromTheTopLeft) {
  const cv::Mat picture =
      besideEachOther({grey(100, 100, 1), grey(100, 100, 2), grey(100, 100, 3), grey(80, 60, 4)});
  EXPECT_EQ(picture.size(), cv::Size(200, 200));
  EXPECT_EQ(valueAt(picture, 50, 50), 1);
  EXPECT_EQ(valueAt(picture, 150, 50), 2);
  EXPECT_EQ(valueAt(picture, 50, 150), 3);
  EXPECT_EQ(valueAt(picture, 150, 150), 4);
  EXPECT_EQ(valueAt(picture, 190, 190), 255) << "beside a smaller panel it is white";
}

TEST(StoreysPicture, LongPanelsLieAboveEachOther) {
  EXPECT_EQ(besideEachOther({grey(400, 100, 1), grey(400, 100, 2)}).size(), cv::Size(400, 200));
}

TEST(StoreysPicture, ManyPanelsShrink) {
  const std::vector<cv::Mat> panels(kMostPanels, grey(2000, 2000, 7));
  const cv::Mat picture = besideEachOther(panels);
  EXPECT_LE(picture.cols, 6400);
  EXPECT_EQ(valueAt(picture, picture.cols / 2, picture.rows / 2), 7);
}

}  // namespace
}  // namespace occusg
