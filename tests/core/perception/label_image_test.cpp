// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "occusg/error.hpp"
#include "occusg/perception/instance_mask.hpp"

namespace occusg {
namespace {

const std::map<int, std::string> kLabels = {{1, "door"}, {2, "bed"}, {7, "door"}};

std::string refusal(const cv::Mat& image) {
  try {
    (void)masksOf(image, kLabels);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(LabelImage, EachObjectIsAMaskInItsBoundingBox) {
  const cv::Mat ids = (cv::Mat_<std::uint16_t>(3, 5) <<  //
                           0,
                       7, 7, 0, 2,     //
                       0, 0, 7, 0, 0,  //
                       0, 0, 0, 0, 2);
  const InstanceMasks result = masksOf(ids, kLabels);

  EXPECT_EQ(result.image_size, cv::Size(5, 3));
  ASSERT_EQ(result.masks.size(), 2U);
  const InstanceMask& bed = result.masks[0];
  EXPECT_EQ(bed.source_object_id, 2);
  EXPECT_EQ(bed.class_name, "bed");
  EXPECT_EQ(bed.class_id, 0);
  EXPECT_EQ(bed.score, 1.0);
  EXPECT_EQ(bed.box, cv::Rect(4, 0, 1, 3));
  EXPECT_EQ(cv::countNonZero(bed.pixels), 2);
  const InstanceMask& door = result.masks[1];
  EXPECT_EQ(door.source_object_id, 7);
  EXPECT_EQ(door.class_name, "door");
  EXPECT_EQ(door.class_id, 1);
  EXPECT_EQ(door.box, cv::Rect(1, 0, 2, 2));
  const cv::Mat expected = (cv::Mat_<std::uint8_t>(2, 2) << 255, 255, 0, 255);
  EXPECT_EQ(cv::countNonZero(door.pixels != expected), 0);
  EXPECT_EQ(result.refused.total(), 0U);
}

TEST(LabelImage, ObjectWithoutALabelHasNoClass) {
  const InstanceMasks result = masksOf(cv::Mat(2, 2, CV_16UC1, cv::Scalar(65535)), kLabels);
  ASSERT_EQ(result.masks.size(), 1U);
  EXPECT_EQ(result.masks[0].source_object_id, 65535);
  EXPECT_EQ(result.masks[0].class_name, "");
  EXPECT_EQ(result.masks[0].class_id, -1);
}

TEST(LabelImage, WithoutObjectsHasNoMasks) {
  EXPECT_TRUE(masksOf(cv::Mat::zeros(4, 4, CV_16UC1), kLabels).masks.empty());
}

TEST(LabelImage, OfManyObjectsTheLargestAreTakenAndTheRestCounted) {
  cv::Mat ids(100, 100, CV_16UC1);
  for (int i = 0; i < 10'000; ++i) ids.at<std::uint16_t>(i / 100, i % 100) = std::uint16_t(i + 1);
  ids.row(99).setTo(60'000);
  const InstanceMasks result = masksOf(ids, kLabels);
  ASSERT_EQ(result.masks.size(), kMaxMasks);
  EXPECT_EQ(result.masks.front().source_object_id, 1);
  EXPECT_EQ(result.masks.back().source_object_id, 60'000);
  EXPECT_EQ(result.refused.count(MaskRefusal::kOverLimit), 9'901U - kMaxMasks);
  EXPECT_EQ(result.refused.first(MaskRefusal::kOverLimit),
            "label image: holds 9901 objects; the largest 300 are taken");
}

TEST(LabelImage, ScatteredObjectsDoNotFillTheMemory) {
  // Columns of ids 1..300 from edge to edge, so that each of the boxes is the whole image.
  cv::Mat ids(1024, 1024, CV_16UC1);
  for (int y = 0; y < ids.rows; ++y)
    for (int x = 0; x < ids.cols; ++x)
      ids.at<std::uint16_t>(y, x) = std::uint16_t(1 + (x + y) % 300);
  const InstanceMasks result = masksOf(ids, kLabels);
  EXPECT_EQ(result.masks.size(), 64U);
  EXPECT_EQ(result.refused.count(MaskRefusal::kOverLimit), 236U);
}

TEST(LabelImage, OtherTypesAndEmptyImagesAreRefused) {
  EXPECT_EQ(refusal(cv::Mat::zeros(3, 4, CV_8UC1)),
            "label image: is 4 x 3 pixels of OpenCV type 0; an image of CV_16UC1, one object id a "
            "pixel, is needed");
  EXPECT_NE(refusal(cv::Mat()), "");
}

}  // namespace
}  // namespace occusg
