// SPDX-License-Identifier: BSD-3-Clause
#include "io/decomposition_drawing.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "drawn_grid.hpp"
#include "occusg/regions/dude_decomposer.hpp"

namespace occusg {
namespace {

/// Two rooms of 4 m x 4 m with a door of 0.8 m between them.
FreeSpace twoRooms() {
  FreeSpace layer = testing::solid(9.0, 5.0);
  testing::fill(layer, 0.4, 0.5, 4.4, 4.5);
  testing::fill(layer, 4.6, 0.5, 8.6, 4.5);
  testing::fill(layer, 4.4, 2.0, 4.6, 2.8);
  return layer;
}

int pixelsOfColor(const cv::Mat& picture, const cv::Vec3b& bgr) {
  cv::Mat mask;
  cv::inRange(picture, bgr, bgr, mask);
  return cv::countNonZero(mask);
}

const cv::Vec3b kCutBgr(49, 48, 214);

cv::Mat drawnAt(const FreeSpace& layer, double depth_threshold_m) {
  DudeDecomposerConfig config;
  config.depth_threshold_m = depth_threshold_m;
  DudeDecomposer decomposer(config);
  const Decomposition& decomposition = decomposer.update(layer);
  return drawDecomposition(layer, decomposition, decomposer.trace(), depth_threshold_m,
                           "two rooms");
}

TEST(DecompositionDrawing, ShowsACutWhereOneIsMade) {
  const cv::Mat with_cut = drawnAt(twoRooms(), 1.0);
  const cv::Mat without = drawnAt(twoRooms(), 6.0);
  EXPECT_EQ(with_cut.type(), CV_8UC3);
  EXPECT_EQ(std::max(with_cut.cols, with_cut.rows), 1600);
  // 0.8 m at more than 150 pixels a metre, beside the legend that both have.
  EXPECT_GT(pixelsOfColor(with_cut, kCutBgr), pixelsOfColor(without, kCutBgr) + 200);
}

TEST(DecompositionDrawing, SameInputSamePixels) {
  EXPECT_EQ(cv::norm(drawnAt(twoRooms(), 1.0), drawnAt(twoRooms(), 1.0), cv::NORM_INF), 0.0);
}

TEST(DecompositionDrawing, EmptyMapGivesAPicture) {
  EXPECT_FALSE(drawDecomposition({}, {}, {}, 0.0, "nothing").empty());
}

}  // namespace
}  // namespace occusg
