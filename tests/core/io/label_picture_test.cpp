// SPDX-License-Identifier: BSD-3-Clause
#include "io/label_picture.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "error_sentence.hpp"
#include "recorded_sequence.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::pngOf;
using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

TEST(LabelPicture, HoldsEveryCellWithTheHighestRowOnTop) {
  Grid<std::int32_t> labels({{0, 0}, {2, 2}}, 1);
  labels.at({1, 1}) = 65'535;
  const std::string png = labelPng(labels, {{0, 0}, {3, 2}});
  const cv::Mat pixels =
      cv::imdecode(std::vector<unsigned char>(png.begin(), png.end()), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(pixels.type(), CV_16UC1);
  ASSERT_EQ(pixels.size(), cv::Size(3, 2));
  EXPECT_EQ(pixels.at<std::uint16_t>(0, 1), 65'535);
  EXPECT_EQ(pixels.at<std::uint16_t>(1, 0), 1);
  EXPECT_EQ(pixels.at<std::uint16_t>(1, 2), 0);
}

TEST(LabelPicture, IdThatDoesNotFitIsRefused) {
  for (const std::int32_t id : {-1, 65'536}) {
    const Grid<std::int32_t> labels({{0, 0}, {1, 1}}, id);
    EXPECT_TRUE(tells(sentenceOf([&] { (void)labelPng(labels, labels.box()); }),
                      {std::to_string(id), "from 0 to 65535"}));
  }
}

TEST(LabelPicture, ReadsBackAsRoomsInMetres) {
  TemporaryFolder folder;
  Grid<std::int32_t> labels({{0, 0}, {5, 2}}, 0);
  labels.at({0, 0}) = 7;
  labels.at({0, 1}) = 7;
  labels.at({2, 0}) = 3;
  labels.at({4, 1}) = 7;
  folder.write("labels.png", labelPng(labels, labels.box()));
  const auto rooms = readLabelledRooms(folder.at("labels.png"), 0.5);
  ASSERT_EQ(rooms.size(), 2U);
  EXPECT_EQ(rooms[0].id, 3);
  EXPECT_EQ(rooms[0].parts.front().outer, (Ring{{1.0, 0.0}, {1.5, 0.0}, {1.5, 0.5}, {1.0, 0.5}}));
  EXPECT_EQ(rooms[1].id, 7);
  ASSERT_EQ(rooms[1].parts.size(), 2U);
  EXPECT_NEAR(area(rooms[1].parts[0]) + area(rooms[1].parts[1]), 0.75, 1e-12);
}

TEST(LabelPicture, WhatIsNoPictureOfLabelsIsRefused) {
  TemporaryFolder folder;
  folder.write("grey.png", pngOf(cv::Mat(2, 2, CV_8UC1, cv::Scalar(1))));
  EXPECT_TRUE(tells(sentenceOf([&] { (void)readLabelledRooms(folder.at("grey.png"), 0.05); }),
                    {"grey.png: has 8 bits and 1 channels", "16 bits"}));
  EXPECT_TRUE(tells(sentenceOf([&] { (void)readLabelledRooms(folder.at("no.png"), 0.05); }),
                    {"no.png: does not exist"}));
  for (const double resolution : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(tells(sentenceOf([&] { (void)readLabelledRooms("a.png", resolution); }),
                      {"a.png: has a resolution of"}));
  }
}

}  // namespace
}  // namespace occusg
