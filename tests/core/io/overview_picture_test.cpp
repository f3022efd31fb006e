// SPDX-License-Identifier: BSD-3-Clause
#include "io/overview_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "drawn_grid.hpp"
#include "error_sentence.hpp"
#include "io/label_placement.hpp"

namespace occusg {
namespace {

using testing::fill;
using testing::sentenceOf;
using testing::solid;
using testing::tells;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

/// Two rooms of 4 m x 4.6 m side by side with a wall and a door between them.
FreeSpace twoRoomLayer() {
  FreeSpace layer = solid(8.6, 5.0);
  fill(layer, 0.2, 0.2, 4.2, 4.8);
  fill(layer, 4.4, 0.2, 8.4, 4.8);
  fill(layer, 4.2, 2.0, 4.4, 3.0);
  return layer;
}

OverviewContent twoRoomsContent() {
  return {"two rooms",
          {{1, "kitchen", rectangle(0.2, 0.2, 4.2, 4.8)},
           {2, "unknown", rectangle(4.4, 0.2, 8.4, 4.8)}},
          {{1, 2, {{4.3, 2.0}, {4.3, 3.0}}}},
          {{1.0, 1.0}, {3.0, 2.5}, {6.0, 2.5}}};
}

/// How many pixels have nearly that colour.
int countOf(const cv::Mat& picture, const cv::Vec3b& bgr) {
  constexpr int kNear = 12;
  cv::Mat near;
  cv::inRange(picture, cv::Scalar(bgr[0] - kNear, bgr[1] - kNear, bgr[2] - kNear),
              cv::Scalar(bgr[0] + kNear, bgr[1] + kNear, bgr[2] + kNear), near);
  return cv::countNonZero(near);
}

const cv::Vec3b kWallBgr(70, 62, 58);
const cv::Vec3b kFreeBgr(238, 235, 233);
const cv::Vec3b kPathBgr(210, 100, 28);
const cv::Vec3b kCrossingBgr(49, 48, 214);

bool isSame(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(OverviewPicture, LongerSideIs1600InEveryShape) {
  for (const auto& [width_m, height_m] :
       std::vector<std::pair<double, double>>{{8, 6}, {6, 8}, {30, 1}, {1, 30}, {0.05, 0.05}}) {
    SCOPED_TRACE(std::to_string(width_m) + " x " + std::to_string(height_m));
    const cv::Mat picture = drawOverview(solid(width_m, height_m), {});
    EXPECT_EQ(picture.type(), CV_8UC3);
    EXPECT_NEAR(std::max(picture.cols, picture.rows), 1600, 1);
    EXPECT_GE(std::min(picture.cols, picture.rows), 400);
  }
}

TEST(OverviewPicture, ShowsWallsPathAndCrossings) {
  const cv::Mat picture = drawOverview(twoRoomLayer(), twoRoomsContent());
  EXPECT_GT(countOf(picture, kWallBgr), 20'000);
  EXPECT_GT(countOf(picture, kPathBgr), 1'000);
  EXPECT_GT(countOf(picture, kCrossingBgr), 500);
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 0), cv::Vec3b(255, 255, 255));
}

TEST(OverviewPicture, FreeSpaceOutsideRoomsIsGreyAndInsideTinted) {
  OverviewContent content = twoRoomsContent();
  const int tinted = countOf(drawOverview(twoRoomLayer(), content), kFreeBgr);
  content.rooms.clear();
  EXPECT_GT(countOf(drawOverview(twoRoomLayer(), content), kFreeBgr), tinted + 500'000);
}

TEST(OverviewPicture, ColourOfARoomFollowsItsIdAlone) {
  OverviewContent content = twoRoomsContent();
  content.trajectory.clear();
  const cv::Mat one = drawOverview(twoRoomLayer(), content);
  std::swap(content.rooms[0], content.rooms[1]);
  const cv::Mat swapped = drawOverview(twoRoomLayer(), content);
  const cv::Point in_left(200, 200);
  const cv::Point in_right(1400, 200);
  EXPECT_EQ(one.at<cv::Vec3b>(in_left), swapped.at<cv::Vec3b>(in_left));
  EXPECT_NE(one.at<cv::Vec3b>(in_left), one.at<cv::Vec3b>(in_right));
}

TEST(OverviewPicture, UpIsUp) {
  FreeSpace layer = solid(4.0, 4.0);
  fill(layer, 0.0, 0.0, 4.0, 3.0, kUnknown);  // an obstacle at high y only
  OverviewContent content;
  content.trajectory = {{0.0, 0.0}, {4.0, 0.0}};
  const cv::Mat picture = drawOverview(layer, content);
  EXPECT_GT(countOf(picture.rowRange(0, picture.rows / 2), kWallBgr), 50'000);
  EXPECT_EQ(countOf(picture.rowRange(picture.rows / 2, picture.rows - 100), kWallBgr), 0);
}

TEST(OverviewPicture, HoleOfARoomKeepsTheColourBeneath) {
  OverviewContent content = twoRoomsContent();
  content.rooms = {{1, "", rectangle(0.2, 0.2, 4.2, 4.8)}};
  const int whole = countOf(drawOverview(twoRoomLayer(), content), kFreeBgr);
  content.rooms[0].polygon.holes = {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
  EXPECT_GT(countOf(drawOverview(twoRoomLayer(), content), kFreeBgr), whole + 10'000);
}

TEST(OverviewPicture, EqualInputGivesEqualPixels) {
  EXPECT_TRUE(isSame(drawOverview(twoRoomLayer(), twoRoomsContent()),
                     drawOverview(twoRoomLayer(), twoRoomsContent())));
}

TEST(OverviewPicture, EmptyMapSaysSo) {
  const cv::Mat empty = drawOverview(FreeSpace{}, {});
  EXPECT_EQ(empty.cols, 1600);
  const cv::Mat middle = empty.rowRange(empty.rows / 2 - 40, empty.rows / 2 + 40);
  EXPECT_GT(countOf(middle, cv::Vec3b(125, 117, 108)), 50) << "a notice stands in the middle";
}

TEST(OverviewPicture, WhatIsNotFiniteIsLeftOut) {
  OverviewContent content = twoRoomsContent();
  const cv::Mat clean = drawOverview(twoRoomLayer(), content);
  content.trajectory.insert(content.trajectory.begin() + 1, {kNan, 0.0});
  content.trajectory.push_back({0.0, 1e300});
  content.crossings.push_back({1, 2, {{kNan, 0.0}, {1.0, 1.0}}});
  content.rooms.push_back({3, "", {{{0, 0}, {1, 0}, {kNan, 1}}, {}}});
  content.rooms.push_back({4, "", {{{0, 0}, {1, 0}}, {}}});
  content.rooms.push_back({5, "", {{{0, 0}, {1, 0}, {1, 1}}, {{{0, 0}, {kNan, 0}, {0, 0}}}}});
  EXPECT_TRUE(isSame(drawOverview(twoRoomLayer(), content), clean));
}

TEST(OverviewPicture, ExtremeContentIsDrawnWithoutHarm) {
  OverviewContent content;
  content.title = std::string(10'000, 'W') + "\xC3\xA9^_\n";
  content.rooms = {
      {std::numeric_limits<int>::max(), std::string(5'000, '_'), rectangle(-1e6, -1e6, 1e6, 1e6)},
      {-3, "dot", rectangle(0, 0, 1e-9, 1e-9)}};
  content.trajectory = {{1e6, 1e6}};
  EXPECT_NEAR(drawOverview(twoRoomLayer(), content).rows, 1600, 1);
  FreeSpace no_lattice = twoRoomLayer();
  for (const double bad : {0.0, -1.0, kNan, 1e-9, HUGE_VAL}) {
    no_lattice.frame.resolution_m = bad;
    EXPECT_FALSE(drawOverview(no_lattice, twoRoomsContent()).empty());
  }
}

TEST(OverviewPicture, ManyRoomsOfAllSizesAreDrawn) {
  OverviewContent content;
  for (int i = 0; i < 400; ++i) {
    const double x = (i % 20) * 3.0;
    const double y = (i / 20) * 2.0;
    content.rooms.push_back(
        {i + 1, "storage", rectangle(x, y, x + 0.1 + 0.14 * (i % 20), y + 1.9)});
  }
  EXPECT_FALSE(drawOverview(FreeSpace{}, content).empty());
}

TEST(OverviewPicture, EncodesAsPng) {
  const cv::Mat picture = drawOverview(twoRoomLayer(), twoRoomsContent());
  const std::string png = encodePng(picture);
  const cv::Mat again =
      cv::imdecode(std::vector<unsigned char>(png.begin(), png.end()), cv::IMREAD_COLOR);
  EXPECT_TRUE(isSame(picture, again));
  EXPECT_TRUE(tells(sentenceOf([] { (void)encodePng(cv::Mat()); }), {"cannot be encoded"}));
}

TEST(LabelPlacement, LabelGoesToTheMiddleOfARoom) {
  cv::Mat mask = cv::Mat::zeros(200, 400, CV_8UC1);
  mask(cv::Rect(100, 50, 200, 100)) = 255;
  const LabelPlace place = placeLabel(mask, {40, 20});
  EXPECT_NEAR(place.center.x, 200, 10);
  EXPECT_NEAR(place.center.y, 100, 10);
  EXPECT_GE(place.fit, 1.0);
}

TEST(LabelPlacement, WideLabelGoesIntoTheWideArmOfAnL) {
  cv::Mat mask = cv::Mat::zeros(300, 300, CV_8UC1);
  mask(cv::Rect(0, 0, 60, 300)) = 255;
  mask(cv::Rect(0, 260, 300, 40)) = 255;
  const LabelPlace place = placeLabel(mask, {120, 24});
  EXPECT_GE(place.fit, 1.0);
  EXPECT_GT(place.center.y, 265);
  const LabelPlace tall = placeLabel(mask, {40, 120});
  EXPECT_GE(tall.fit, 1.0);
  EXPECT_LT(tall.center.x, 60);
}

TEST(LabelPlacement, LabelTooLargeForTheRoomIsTold) {
  cv::Mat mask = cv::Mat::zeros(100, 100, CV_8UC1);
  mask(cv::Rect(20, 20, 30, 30)) = 255;
  const LabelPlace place = placeLabel(mask, {60, 20});
  EXPECT_LT(place.fit, 0.7);
  EXPECT_NEAR(place.center.x, 35, 10);
}

TEST(LabelPlacement, SpeckOfARoomStillHasAPlace) {
  cv::Mat mask = cv::Mat::zeros(100, 100, CV_8UC1);
  mask.at<std::uint8_t>(30, 70) = 255;
  const LabelPlace place = placeLabel(mask, {60, 20});
  EXPECT_LT(place.fit, 0.2);
  EXPECT_NEAR(place.center.x, 70.5, 3.0);
  EXPECT_NEAR(place.center.y, 30.5, 3.0);
}

TEST(LabelPlacement, NothingFitsIntoNothing) {
  EXPECT_EQ(placeLabel(cv::Mat(), {60, 20}).fit, 0.0);
  EXPECT_EQ(placeLabel(cv::Mat::zeros(10, 10, CV_8UC1), {60, 20}).fit, 0.0);
}

RoomRecord roomAt(int id, double x, double y, double side) {
  return {id, "", {{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}}};
}

// How long a picture takes is bounded by how many labels are placed, and by how large the places
// are that are searched for them.
TEST(OverviewPicture, OfHundredsOfRoomsTheLargestAreLabelled) {
  std::vector<RoomRecord> rooms;
  for (int i = 0; i < 700; ++i) rooms.push_back(roomAt(i + 1, 0.0, 0.0, 10.0 - 0.001 * i));
  const auto differs = [&](RoomRecord& room) {
    const cv::Mat before = drawOverview({}, {"", rooms, {}, {}});
    room.label = "kitchen";
    return cv::norm(before, drawOverview({}, {"", rooms, {}, {}}), cv::NORM_L1) > 0.0;
  };
  EXPECT_FALSE(differs(rooms.back())) << "the smallest room has a label";
  EXPECT_TRUE(differs(rooms.front())) << "the largest room has no label";
  rooms.resize(3);
  EXPECT_TRUE(differs(rooms.back())) << "one of few rooms has no label";
}

TEST(OverviewPicture, PictureOfManyRoomsIsEncodedQuicklyAndThatOfFewSmall) {
  EXPECT_EQ(effortFor(501), PngEffort::kFast);
  EXPECT_EQ(effortFor(40), PngEffort::kSmallest);
  const cv::Mat picture = drawOverview(twoRoomLayer(), {"flat", {}, {}, {}});
  EXPECT_LE(encodePng(picture).size(), encodePng(picture, PngEffort::kFast).size());
}

}  // namespace
}  // namespace occusg
