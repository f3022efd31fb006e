// SPDX-License-Identifier: BSD-3-Clause
#include "perception/yolo_output.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

cv::Mat zeros(const std::vector<int>& shape) {
  return cv::Mat(static_cast<int>(shape.size()), shape.data(), CV_32FC1, cv::Scalar(0));
}

/// 1 x rows x columns.
cv::Mat tensor(const cv::Mat_<float>& matrix) {
  const std::vector<int> shape = {1, matrix.rows, matrix.cols};
  return matrix.clone().reshape(1, shape);
}

/// Predictions of kAnchors with two classes and one coefficient, an anchor a column: centre x, y,
/// width, height, score of class 0, of class 1, coefficient.
cv::Mat anchors(const std::vector<cv::Vec<float, 7>>& columns) {
  cv::Mat_<float> matrix(7, static_cast<int>(columns.size()));
  for (int i = 0; i < matrix.cols; ++i)
    for (int row = 0; row < 7; ++row) matrix(row, i) = columns[static_cast<std::size_t>(i)][row];
  return tensor(matrix);
}

YoloInstances decodeAnchors(const cv::Mat& predictions) {
  return decodeYolo(predictions, 1, {YoloLayout::kAnchors, 0.7, 0.45});
}

YoloInstances decodeRows(const cv::Mat& predictions) {
  return decodeYolo(predictions, 1, {YoloLayout::kEndToEnd, 0.7, 0.45});
}

std::string refusal(const cv::Mat& predictions, const cv::Mat& prototypes, std::size_t classes) {
  try {
    (void)layoutOf(predictions, prototypes, classes, "model.onnx");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(YoloOutput, LayoutIsToldByTheShapes) {
  const cv::Mat prototypes = zeros({1, 32, 160, 160});
  EXPECT_EQ(layoutOf(zeros({1, 116, 8400}), prototypes, 80, "m"), YoloLayout::kAnchors);
  EXPECT_EQ(layoutOf(zeros({1, 300, 38}), prototypes, 80, "m"), YoloLayout::kEndToEnd);
  EXPECT_EQ(layoutOf(zeros({1, 38, 8400}), prototypes, 2, "m"), YoloLayout::kAnchors);
  EXPECT_EQ(layoutOf(zeros({1, 25200, 117}), prototypes, 80, "m"),
            YoloLayout::kAnchorsWithObjectness);
  EXPECT_EQ(layoutOf(zeros({1, 25200, 38}), prototypes, 1, "m"),
            YoloLayout::kAnchorsWithObjectness);
  EXPECT_EQ(layoutOf(zeros({1, 300, 38}), prototypes, 1, "m"), YoloLayout::kEndToEnd);
  EXPECT_NE(refusal(zeros({1, 25200, 117}), prototypes, 79).find("80 classes"), std::string::npos);
}

TEST(YoloOutput, ScoreWithObjectnessIsItsProductWithTheBestClass) {
  // Centre, size, objectness, two classes, coefficient.
  const YoloInstances found =
      decodeYolo(tensor((cv::Mat_<float>(4, 8) << 20, 32, 24, 30, 0.9F, 0.1F, 0.95F, -3,  //
                         21, 32, 24, 30, 0.9F, 0.1F, 0.9F, 1,                             //
                         80, 32, 24, 30, 0.9F, 0.5F, 0.6F, 1,                             //
                         80, 32, 24, 30, 0.1F, 0.1F, 0.9F, 1)),
                 1, {YoloLayout::kAnchorsWithObjectness, 0.7, 0.45});
  ASSERT_EQ(found.instances.size(), 1U) << "one is suppressed, two are below the confidence";
  EXPECT_EQ(found.instances[0].box, cv::Rect2d(8, 17, 24, 30));
  EXPECT_EQ(found.instances[0].class_id, 1);
  EXPECT_FLOAT_EQ(found.instances[0].score, 0.9F * 0.95F);
  EXPECT_EQ(found.instances[0].coefficients.at<float>(0), -3.0F);
}

TEST(YoloOutput, AnotherNumberOfClassesIsRefusedWithBothNumbers) {
  EXPECT_EQ(refusal(zeros({1, 116, 8400}), zeros({1, 32, 160, 160}), 79),
            "model.onnx: predictions 1 x 116 x 8400 are of 80 classes; the list of names has 79");
}

TEST(YoloOutput, ShapesOfNeitherLayoutAreRefusedWithTheShapes) {
  EXPECT_EQ(refusal(zeros({1, 20, 6}), zeros({1, 32, 16, 16}), 3),
            "model.onnx: predictions 1 x 20 x 6 do not fit prototypes 1 x 32 x 16 x 16; 1 x (4 + "
            "classes + 32 coefficients) x anchors, 1 x anchors x (5 + classes + 32 coefficients) "
            "or 1 x rows x (6 + 32 coefficients) is needed");
  EXPECT_NE(refusal(zeros({1, 84, 8400}), zeros({1, 84, 8400}), 80).find("1 x 84 x 8400"),
            std::string::npos);
  EXPECT_NE(refusal(zeros({2, 116, 8400}), zeros({2, 32, 16, 16}), 80), "") << "two images";
  EXPECT_NE(refusal(cv::Mat(), cv::Mat(), 80), "");
}

TEST(YoloOutput, AnchorsAreDecodedToBoxClassScoreAndCoefficients) {
  const YoloInstances found = decodeAnchors(anchors({{20, 32, 24, 30, 0.1F, 0.9F, -3}}));
  ASSERT_EQ(found.instances.size(), 1U);
  const YoloInstance& instance = found.instances[0];
  EXPECT_EQ(instance.box, cv::Rect2d(8, 17, 24, 30));
  EXPECT_EQ(instance.class_id, 1);
  EXPECT_FLOAT_EQ(instance.score, 0.9F);
  ASSERT_EQ(instance.coefficients.total(), 1U);
  EXPECT_EQ(instance.coefficients.at<float>(0), -3.0F);
}

TEST(YoloOutput, RowsAreDecodedToBoxClassScoreAndCoefficients) {
  const YoloInstances found =
      decodeRows(tensor((cv::Mat_<float>(2, 7) << 8, 17, 32, 47, 0.9F, 1, -3,  //
                         8, 17, 32, 47, 0.69F, 1, -3)));
  ASSERT_EQ(found.instances.size(), 1U);
  EXPECT_EQ(found.instances[0].box, cv::Rect2d(8, 17, 24, 30));
  EXPECT_EQ(found.instances[0].class_id, 1);
  EXPECT_FLOAT_EQ(found.instances[0].score, 0.9F);
  EXPECT_EQ(found.instances[0].coefficients.at<float>(0), -3.0F);
}

TEST(YoloOutput, BestScoreComesFirst) {
  const YoloInstances found = decodeAnchors(anchors(
      {{10, 10, 4, 4, 0.7F, 0, 1}, {50, 10, 4, 4, 0.8F, 0, 2}, {90, 10, 4, 4, 0.75F, 0, 3}}));
  ASSERT_EQ(found.instances.size(), 3U);
  EXPECT_EQ(found.instances[0].coefficients.at<float>(0), 2.0F);
  EXPECT_EQ(found.instances[1].coefficients.at<float>(0), 3.0F);
  EXPECT_EQ(found.instances[2].coefficients.at<float>(0), 1.0F);
}

TEST(YoloOutput, OverlappingAnchorsOfAClassAreSuppressed) {
  // The second overlaps the first by 8 / 12, the third by 4 / 16.
  const YoloInstances found = decodeAnchors(anchors(
      {{10, 10, 10, 10, 0.9F, 0, 1}, {12, 10, 10, 10, 0.8F, 0, 2}, {16, 10, 10, 10, 0.8F, 0, 3}}));
  ASSERT_EQ(found.instances.size(), 2U);
  EXPECT_EQ(found.instances[0].coefficients.at<float>(0), 1.0F);
  EXPECT_EQ(found.instances[1].coefficients.at<float>(0), 3.0F);
}

TEST(YoloOutput, OverlappingAnchorsOfTwoClassesStay) {
  EXPECT_EQ(decodeAnchors(anchors({{10, 10, 10, 10, 0.9F, 0, 1}, {10, 10, 10, 10, 0, 0.8F, 2}}))
                .instances.size(),
            2U);
}

TEST(YoloOutput, OverlappingRowsOfAnEndToEndModelStay) {
  EXPECT_EQ(decodeRows(tensor((cv::Mat_<float>(2, 7) << 0, 0, 10, 10, 0.9F, 0, 1,  //
                               0, 0, 10, 10, 0.8F, 0, 1)))
                .instances.size(),
            2U);
}

TEST(YoloOutput, NumbersThatAreNotFiniteAreRefusedAndCounted) {
  const YoloInstances found =
      decodeAnchors(anchors({{kNan, 10, 4, 4, 0.9F, 0, 1},
                             {10, 10, kInf, 4, 0.9F, 0, 1},
                             {10, 10, 4, 4, 0.9F, 0, kNan},
                             {10, 10, 4, 4, kNan, 0.1F, 1},
                             {10, 10, 4, 4, 0.1F, kNan, 1},
                             {kNan, 10, 4, 4, 0.1F, 0, 1},  // not confident: nobody looks at it
                             {50, 10, 4, 4, 0.9F, 0, 1}}));
  EXPECT_EQ(found.instances.size(), 1U);
  EXPECT_EQ(found.refused.count(MaskRefusal::kBadNumber), 5U);
  EXPECT_EQ(found.refused.first(MaskRefusal::kBadNumber),
            "prediction 0: holds NaN or infinity; all numbers must be finite");

  const YoloInstances rows =
      decodeRows(tensor((cv::Mat_<float>(3, 7) << 0, 0, kNan, 10, 0.9F, 0, 1,  //
                         0, 0, 10, 10, kNan, 0, 1,                             //
                         0, 0, 10, 10, 0.9F, kNan, 1)));
  EXPECT_EQ(rows.refused.count(MaskRefusal::kBadNumber), 2U);
  ASSERT_EQ(rows.instances.size(), 1U);
  EXPECT_EQ(rows.instances[0].class_id, -1) << "no class number";
}

TEST(YoloOutput, BoxesWithoutAnAreaAreRefusedAndCounted) {
  const YoloInstances found =
      decodeAnchors(anchors({{10, 10, 0, 4, 0.9F, 0, 1}, {10, 10, 4, -4, 0.9F, 0, 1}}));
  EXPECT_TRUE(found.instances.empty());
  EXPECT_EQ(found.refused.count(MaskRefusal::kEmpty), 2U);
}

TEST(YoloOutput, ManyConfidentAnchorsAreCapped) {
  std::vector<cv::Vec<float, 7>> columns;
  for (int i = 0; i < 20'000; ++i)
    columns.push_back({static_cast<float>(10 * i), 10, 4, 4, i == 19'999 ? 0.9F : 0.8F, 0, 1});
  const YoloInstances found = decodeAnchors(anchors(columns));
  ASSERT_EQ(found.instances.size(), kMaxMasks);
  EXPECT_FLOAT_EQ(found.instances[0].score, 0.9F);
  EXPECT_EQ(found.refused.count(MaskRefusal::kOverLimit), 20'000U - kMaxMasks);
  EXPECT_EQ(found.refused.first(MaskRefusal::kOverLimit),
            "model: found 20000 instances; the best 3000 are taken");
}

/// Prototypes 1 x 2 x 4 x 4 of an input of 16 x 16: the first is 1 in its left half and -1 in its
/// right half, the second is 1 everywhere.
cv::Mat halves() {
  cv::Mat prototypes = zeros({1, 2, 4, 4});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      prototypes.ptr<float>(0, 0)[y * 4 + x] = x < 2 ? 1.0F : -1.0F;
      prototypes.ptr<float>(0, 1)[y * 4 + x] = 1.0F;
    }
  return prototypes;
}

YoloInstance instanceOf(const cv::Rect2d& box, const cv::Mat_<float>& coefficients) {
  return {box, 0, 0.9F, coefficients};
}

TEST(YoloOutput, MaskIsWhereTheWeightedPrototypesArePositiveInTheBox) {
  const Letterbox letterbox = fitLetterbox({32, 32}, {16, 16});
  const InstanceMask left =
      maskInImage(instanceOf({4, 2, 8, 6}, (cv::Mat_<float>(1, 2) << 1, 0)), halves(), letterbox);
  EXPECT_EQ(left.box, cv::Rect(8, 4, 16, 12));
  // The sign changes at x = 8 of the input, x = 16 of the image: the eighth column of the box.
  EXPECT_EQ(cv::countNonZero(left.pixels.colRange(0, 8)), 8 * 12);
  EXPECT_EQ(cv::countNonZero(left.pixels.colRange(8, 16)), 0);

  const InstanceMask right =
      maskInImage(instanceOf({4, 2, 8, 6}, (cv::Mat_<float>(1, 2) << -1, 0)), halves(), letterbox);
  EXPECT_EQ(cv::countNonZero(right.pixels.colRange(0, 8)), 0);
  EXPECT_EQ(cv::countNonZero(right.pixels.colRange(8, 16)), 8 * 12);

  const InstanceMask all = maskInImage(instanceOf({4, 2, 8, 6}, (cv::Mat_<float>(1, 2) << 1, 1.5F)),
                                       halves(), letterbox);
  EXPECT_EQ(cv::countNonZero(all.pixels), 16 * 12);
}

TEST(YoloOutput, MaskIsMovedOutOfThePadding) {
  // 64 x 32 -> 16 x 8, from row 4 of the input.
  const Letterbox letterbox = fitLetterbox({64, 32}, {16, 16});
  const InstanceMask mask =
      maskInImage(instanceOf({0, 0, 16, 16}, (cv::Mat_<float>(1, 2) << 1, 0)), halves(), letterbox);
  EXPECT_EQ(mask.box, cv::Rect(0, 0, 64, 32));
  EXPECT_EQ(cv::countNonZero(mask.pixels.colRange(0, 32)), 32 * 32);
  EXPECT_EQ(cv::countNonZero(mask.pixels.colRange(32, 64)), 0);
}

TEST(YoloOutput, InstanceOutsideTheImageHasAnEmptyMask) {
  const InstanceMask mask = maskInImage(instanceOf({20, 2, 8, 6}, (cv::Mat_<float>(1, 2) << 1, 0)),
                                        halves(), fitLetterbox({32, 32}, {16, 16}));
  EXPECT_TRUE(mask.box.empty());
  EXPECT_TRUE(mask.pixels.empty());
}

}  // namespace
}  // namespace occusg
