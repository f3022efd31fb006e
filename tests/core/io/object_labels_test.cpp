// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/object_labels.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <string>

#include "occusg/error.hpp"
#include "recorded_sequence.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::pngOf;
using testing::TemporaryFolder;

std::map<int, std::string> labelsIn(const std::string& json) {
  const TemporaryFolder folder;
  folder.write("rooms.json", json);
  return readObjectLabels(folder.path() + "/rooms.json");
}

TEST(ObjectLabels, AreReadFromTheObjectsOfARecording) {
  EXPECT_EQ(labelsIn(R"({"rooms": [], "objects": [{"id": 3, "label": "bed", "bbox": []},
                                                   {"id": 65535, "label": "oven"}]})"),
            (std::map<int, std::string>{{3, "bed"}, {65535, "oven"}}));
  EXPECT_TRUE(labelsIn(R"({"rooms": []})").empty());
}

TEST(ObjectLabels, WhatIsNoObjectIsRefused) {
  for (const char* json :
       {R"([])", R"({"objects": 3})", R"({"objects": [{"label": "bed"}]})",
        R"({"objects": [{"id": 0, "label": "bed"}]})",
        R"({"objects": [{"id": 65536, "label": "bed"}]})", R"({"objects": [{"id": 1}]})",
        R"({"objects": [{"id": 1, "label": ""}]})", R"({"objects": [{"id": 1, "label": 4}]})",
        R"({"objects": [{"id": 1, "label": "a"}, {"id": 1, "label": "b"}]})"}) {
    SCOPED_TRACE(json);
    EXPECT_THROW((void)labelsIn(json), Error);
  }
  EXPECT_THROW(
      (void)labelsIn(R"({"objects": [{"id": 1, "label": ")" + std::string(201, 'x') + "\"}]}"),
      Error);
}

TEST(LabelImage, IsReadAsItIs) {
  const TemporaryFolder folder;
  cv::Mat ids(6, 8, CV_16UC1, cv::Scalar(0));
  ids.at<std::uint16_t>(2, 3) = 40'000;
  folder.write("labels.png", pngOf(ids));
  const cv::Mat read = readLabelImage(folder.path() + "/labels.png");
  ASSERT_EQ(read.size(), ids.size());
  EXPECT_EQ(cv::countNonZero(read != ids), 0);
}

TEST(LabelImage, OfAnotherKindIsRefused) {
  const TemporaryFolder folder;
  folder.write("grey.png", pngOf(cv::Mat(6, 8, CV_8UC1, cv::Scalar(1))));
  folder.write("broken.png", pngOf(cv::Mat(6, 8, CV_16UC1, cv::Scalar(1))).substr(0, 60));
  EXPECT_THROW((void)readLabelImage(folder.path() + "/grey.png"), Error);
  EXPECT_THROW((void)readLabelImage(folder.path() + "/broken.png"), Error);
  EXPECT_THROW((void)readLabelImage(folder.path() + "/missing.png"), Error);
}

}  // namespace
}  // namespace occusg
