// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/detection_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// At 2 m a pixel is 0.01 m wide.
constexpr CameraModel kCamera{40, 30, 200.0, 200.0, 20.0, 15.0};
const cv::Size kSize(kCamera.width, kCamera.height);

/// Looks along +x of the map from (1, 2, 3): camera x is map -y, camera y is map -z.
Pose lookingAlongX() {
  Pose pose = Pose::Identity();
  pose.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  pose.translation() << 1, 2, 3;
  return pose;
}

DepthFrame frameOf(const cv::Mat_<float>& metres) {
  return {7.5, {metres, 1.0}, kCamera, lookingAlongX()};
}

DepthFrame wallAt(float depth_m) { return frameOf(cv::Mat_<float>(kSize, depth_m)); }

/// A chair that fills `box`.
InstanceMask chair(const cv::Rect& box, double score = 0.9) {
  InstanceMask mask;
  mask.class_id = 3;
  mask.class_name = "chair";
  mask.score = score;
  mask.box = box;
  mask.pixels = cv::Mat(box.size(), CV_8UC1, cv::Scalar(255));
  return mask;
}

InstanceMasks masksOf(const std::vector<InstanceMask>& masks, const cv::Size& image = kSize) {
  return {image, masks, {}};
}

DetectionResult build(const InstanceMasks& masks, const DepthFrame& frame,
                      const DetectionBuilderConfig& config = {}) {
  return DetectionBuilder(config).build(masks, frame);
}

/// Refuses the only mask and returns the sentence.
std::string refusalOf(const InstanceMask& mask, MaskRefusal reason) {
  const DetectionResult result = build(masksOf({mask}), wallAt(2.0F));
  EXPECT_TRUE(result.detections.empty());
  EXPECT_EQ(result.refused.total(), 1U);
  EXPECT_EQ(result.refused.count(reason), 1U);
  return result.refused.first(reason);
}

std::string frameRefusal(const DepthFrame& frame, const cv::Size& image = kSize) {
  try {
    (void)build(masksOf({}, image), frame);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string configRefusal(const DetectionBuilderConfig& config) {
  try {
    DetectionBuilder builder(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expectNear(const Eigen::Vector3d& actual, double x, double y, double z) {
  EXPECT_NEAR(actual.x(), x, 1e-6);
  EXPECT_NEAR(actual.y(), y, 1e-6);
  EXPECT_NEAR(actual.z(), z, 1e-6);
}

TEST(DetectionBuilder, PixelsUnderTheMaskBecomeCentroidAndBoxInTheMap) {
  InstanceMask mask = chair({10, 5, 20, 10});
  mask.source_object_id = 12;
  const DetectionResult result = build(masksOf({mask}), wallAt(2.0F));
  ASSERT_EQ(result.detections.size(), 1U);
  const Detection& detection = result.detections[0];
  EXPECT_EQ(detection.class_name, "chair");
  EXPECT_EQ(detection.class_id, 3);
  EXPECT_EQ(detection.source_object_id, 12);
  EXPECT_EQ(detection.score, 0.9);
  EXPECT_EQ(detection.stamp_s, 7.5);
  EXPECT_EQ(detection.point_count, 200U);
  // Columns 10..29 are camera x -0.10..0.09, rows 5..14 camera y -0.10..-0.01.
  expectNear(detection.box.min(), 3.0, 1.91, 3.01);
  expectNear(detection.box.max(), 3.0, 2.10, 3.10);
  expectNear(detection.centroid, 3.0, 2.005, 3.055);
  EXPECT_EQ(result.refused.total(), 0U);
}

TEST(DetectionBuilder, BoxStandsUprightThoughTheCameraLooksDown) {
  const double pitch_rad = 0.5;
  DepthFrame frame = wallAt(0.0F);
  frame.T_map_camera.linear() =
      Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix() *
      lookingAlongX().linear();
  // A wall 2 m in front of the camera along map x: depth where the ray through (u, v) meets it.
  for (int v = 0; v < kCamera.height; ++v)
    frame.depth.pixels.row(v).setTo(
        2.0 / (std::cos(pitch_rad) - (v - kCamera.cy) / kCamera.fy * std::sin(pitch_rad)));
  const DetectionResult result = build(masksOf({chair({0, 0, 40, 30})}), frame);
  ASSERT_EQ(result.detections.size(), 1U);
  EXPECT_NEAR(result.detections[0].box.sizes().x(), 0.0, 1e-5);
  EXPECT_NEAR(result.detections[0].centroid.x(), 3.0, 1e-5);
  EXPECT_LT(result.detections[0].centroid.z(), 3.0 - 0.9);
}

TEST(DetectionBuilder, LargestClusterIsTheObjectAndTheRestIsBackground) {
  cv::Mat_<float> depth(kSize, 3.0F);
  depth(cv::Rect(12, 5, 16, 10)) = 2.0F;
  const DetectionResult result = build(masksOf({chair({10, 5, 20, 10})}), frameOf(depth));
  ASSERT_EQ(result.detections.size(), 1U);
  EXPECT_EQ(result.detections[0].point_count, 160U);
  EXPECT_NEAR(result.detections[0].box.max().x(), 3.0, 1e-6) << "the wall at 3 m is not in it";
}

TEST(DetectionBuilder, LargestClusterIsTheOneOfTheMostPixelsNotOfTheMostVoxels) {
  // 200 pixels at 1 m fill fewer voxels than 160 at 2 m.
  cv::Mat_<float> depth(kSize, 2.0F);
  depth(cv::Rect(10, 5, 20, 10)) = 1.0F;
  const DetectionResult result = build(masksOf({chair({10, 5, 20, 18})}), frameOf(depth));
  ASSERT_EQ(result.detections.size(), 1U);
  EXPECT_EQ(result.detections[0].point_count, 200U);
  EXPECT_NEAR(result.detections[0].centroid.x(), 2.0, 1e-6);
}

TEST(DetectionBuilder, OfEquallyLargeClustersTheFirstInTheImageIsTaken) {
  cv::Mat_<float> depth(kSize, 2.0F);
  depth.colRange(20, 40) = 3.0F;
  const DetectionResult result = build(masksOf({chair({10, 5, 20, 10})}), frameOf(depth));
  ASSERT_EQ(result.detections.size(), 1U);
  EXPECT_NEAR(result.detections[0].centroid.x(), 3.0, 1e-6);
}

/// Points of a mask whose left part, 80 of 200 pixels, is nearer than the right one by a step.
std::size_t pointsAcross(float depth_m, float step_m, const DetectionBuilderConfig& config = {}) {
  cv::Mat_<float> depth(kSize, depth_m);
  depth.colRange(18, 40) = depth_m + step_m;
  return build(masksOf({chair({10, 5, 20, 10})}), frameOf(depth), config)
      .detections.at(0)
      .point_count;
}

TEST(DetectionBuilder, StepUpToTheClusterDistanceJoinsAndBeyondItParts) {
  DetectionBuilderConfig config;
  config.cluster_gap_pixels = 0.0;
  EXPECT_EQ(pointsAcross(2.0F, 0.03F, config), 200U);
  EXPECT_EQ(pointsAcross(2.0F, 0.055F, config), 120U);
  EXPECT_EQ(pointsAcross(4.0F, 0.08F, config), 120U);
}

TEST(DetectionBuilder, ClusterDistanceGrowsWithThePixelsAtTheMasksDepth) {
  // Six pixels are 0.12 m at 4 m, and the cluster distance again at 1 m.
  EXPECT_EQ(pointsAcross(4.0F, 0.08F), 200U);
  EXPECT_EQ(pointsAcross(4.0F, 0.13F), 120U);
  EXPECT_EQ(pointsAcross(1.0F, 0.055F), 120U);
  DetectionBuilderConfig config;
  config.cluster_gap_pixels = 8.0;
  EXPECT_EQ(pointsAcross(4.0F, 0.13F, config), 200U);
  config.cluster_gap_pixels = 100.0;
  EXPECT_EQ(pointsAcross(4.0F, 0.6F, config), 120U) << "half a metre is the limit";
}

TEST(DetectionBuilder, TableTopSeenAtAnAngleIsOneDetection) {
  // 0.2 m below the camera: the four rows are 3.6 to 2.9 m away, up to 0.3 m apart.
  cv::Mat_<float> depth(kSize, 0.0F);
  for (int row = 26; row < 30; ++row) depth.row(row) = 40.0F / (static_cast<float>(row) - 15.0F);
  const InstanceMasks mask = masksOf({chair({0, 26, 40, 4})});
  DetectionBuilderConfig config;
  config.cluster_gap_pixels = 24.0;
  ASSERT_EQ(build(mask, frameOf(depth), config).detections.size(), 1U);
  EXPECT_EQ(build(mask, frameOf(depth), config).detections[0].point_count, 160U);
  config.cluster_gap_pixels = 0.0;
  EXPECT_TRUE(build(mask, frameOf(depth), config).detections.empty()) << "each row is a cluster";
}

TEST(DetectionBuilder, ClusterDistanceIsConfigurable) {
  cv::Mat_<float> depth(kSize, 2.0F);
  depth.colRange(18, 40) = 2.3F;
  DetectionBuilderConfig config;
  config.cluster_eps_m = 0.5;
  EXPECT_EQ(
      build(masksOf({chair({10, 5, 20, 10})}), frameOf(depth), config).detections.at(0).point_count,
      200U);
}

TEST(DetectionBuilder, FiftyPointsMakeADetectionAndFortyNineDoNot) {
  EXPECT_EQ(build(masksOf({chair({10, 5, 10, 5})}), wallAt(2.0F)).detections.size(), 1U);
  EXPECT_EQ(refusalOf(chair({10, 5, 7, 7}), MaskRefusal::kTooFewPoints),
            "mask 0 (chair): its largest cluster has 49 of 49 points; a detection needs 50");
}

TEST(DetectionBuilder, MaskOfAnotherResolutionCoversTheSamePixels) {
  const Eigen::Vector3d same =
      build(masksOf({chair({10, 6, 20, 10})}), wallAt(2.0F)).detections.at(0).centroid;
  for (const double scale : {0.5, 2.0, 3.0}) {
    SCOPED_TRACE("mask " + std::to_string(scale) + " times as large as the depth image");
    const auto scaled = [&](int pixels) { return static_cast<int>(pixels * scale); };
    const InstanceMasks masks =
        masksOf({chair({scaled(10), scaled(6), scaled(20), scaled(10)})}, {scaled(40), scaled(30)});
    const DetectionResult result = build(masks, wallAt(2.0F));
    ASSERT_EQ(result.detections.size(), 1U);
    EXPECT_EQ(result.detections[0].point_count, 200U);
    EXPECT_EQ(result.detections[0].centroid, same);
  }
}

TEST(DetectionBuilder, OnlyPixelsSetInTheMaskCount) {
  InstanceMask mask = chair({10, 5, 20, 10});
  mask.pixels.colRange(0, 10).setTo(0);
  mask.pixels.colRange(10, 20).setTo(1);
  const DetectionResult result = build(masksOf({mask}), wallAt(2.0F));
  ASSERT_EQ(result.detections.size(), 1U);
  EXPECT_EQ(result.detections[0].point_count, 100U);
}

TEST(DetectionBuilder, PixelsWithoutUsableDepthDoNotCount) {
  const float inf = std::numeric_limits<float>::infinity();
  for (const float depth_m : {0.0F, -1.0F, static_cast<float>(kNan), inf, -inf, 0.0009F, 10.1F}) {
    SCOPED_TRACE("depth " + std::to_string(depth_m));
    cv::Mat_<float> depth(kSize, 2.0F);
    depth.row(5) = depth_m;
    EXPECT_EQ(build(masksOf({chair({10, 5, 20, 10})}), frameOf(depth)).detections.at(0).point_count,
              180U);
    EXPECT_TRUE(build(masksOf({chair({10, 5, 20, 10})}), wallAt(depth_m)).detections.empty());
  }
}

TEST(DetectionBuilder, SixteenBitDepthIsInItsUnitAndTheLargestValueIsNone) {
  DepthFrame frame = wallAt(2.0F);
  frame.depth = {cv::Mat(kSize, CV_16UC1, cv::Scalar(2000)), 1000.0};
  frame.depth.pixels.row(5).setTo(0);
  frame.depth.pixels.row(6).setTo(65535);
  DetectionBuilderConfig config;
  config.max_depth_m = 100.0;
  const DetectionResult result = build(masksOf({chair({10, 5, 20, 10})}), frame, config);
  ASSERT_EQ(result.detections.size(), 1U);
  EXPECT_EQ(result.detections[0].point_count, 160U);
  EXPECT_NEAR(result.detections[0].centroid.x(), 3.0, 1e-6);
}

TEST(DetectionBuilder, CameraOfAbsurdFocalLengthIsRefused) {
  DepthFrame frame = wallAt(2.0F);
  frame.camera.fx = 1e-300;
  EXPECT_THROW((void)build(masksOf({chair({21, 5, 10, 10})}), frame), Error);
}

TEST(DetectionBuilder, ScoreThatIsNoConfidenceIsRefused) {
  EXPECT_EQ(refusalOf(chair({10, 5, 20, 10}, 1.5), MaskRefusal::kBadNumber),
            "mask 0 (chair): score is 1.500000; it must be in [0, 1]");
  EXPECT_NE(refusalOf(chair({10, 5, 20, 10}, kNan), MaskRefusal::kBadNumber), "");
  EXPECT_NE(refusalOf(chair({10, 5, 20, 10}, -0.1), MaskRefusal::kBadNumber), "");
}

TEST(DetectionBuilder, ClassWithoutANameIsRefused) {
  InstanceMask mask = chair({10, 5, 20, 10});
  mask.class_name.clear();
  mask.class_id = 97;
  mask.source_object_id = 5;
  EXPECT_EQ(refusalOf(mask, MaskRefusal::kUnknownClass),
            "mask 0: class id 97 of object 5 has no name; the list of names is too short");
}

TEST(DetectionBuilder, EmptyMasksAreRefused) {
  EXPECT_EQ(refusalOf(chair({10, 5, 0, 10}), MaskRefusal::kEmpty),
            "mask 0 (chair): is empty; it must hold at least one pixel");
  InstanceMask blank = chair({10, 5, 20, 10});
  blank.pixels.setTo(0);
  EXPECT_NE(refusalOf(blank, MaskRefusal::kEmpty), "");
  InstanceMask without_pixels = chair({10, 5, 20, 10});
  without_pixels.pixels.release();
  EXPECT_NE(refusalOf(without_pixels, MaskRefusal::kEmpty), "");
}

TEST(DetectionBuilder, MaskOfAnotherSizeThanItsBoxIsRefused) {
  InstanceMask mask = chair({10, 5, 20, 10});
  mask.box.width = 19;
  EXPECT_EQ(refusalOf(mask, MaskRefusal::kWrongSize),
            "mask 0 (chair): has 20 x 10 pixels of OpenCV type 0 for a box of 19 x 10 at (10, 5); "
            "it must be CV_8UC1, of the box's size, and inside the image of 40 x 30");
  InstanceMask floats = chair({10, 5, 20, 10});
  floats.pixels.convertTo(floats.pixels, CV_32F);
  EXPECT_NE(refusalOf(floats, MaskRefusal::kWrongSize), "");
}

TEST(DetectionBuilder, BoxOutsideTheImageIsRefused) {
  constexpr int kFar = std::numeric_limits<int>::max();
  for (const cv::Point& corner : {cv::Point(-1, 5), cv::Point(21, 5), cv::Point(10, -1),
                                  cv::Point(10, 21), cv::Point(kFar, 5), cv::Point(10, kFar)}) {
    InstanceMask mask = chair({10, 5, 20, 10});
    mask.box.x = corner.x;
    mask.box.y = corner.y;
    EXPECT_NE(refusalOf(mask, MaskRefusal::kWrongSize), "");
  }
}

TEST(DetectionBuilder, OfAHundredThousandMasksTheBestAreTaken) {
  std::vector<InstanceMask> many(100'000, chair({10, 5, 20, 10}, 0.5));
  many[70'000].score = 0.8;
  many[99'999].score = 0.7;
  const DetectionResult result = build(masksOf(many), wallAt(2.0F));
  ASSERT_EQ(result.detections.size(), kMaxMasks);
  EXPECT_EQ(result.detections[kMaxMasks - 3].score, 0.5);
  EXPECT_EQ(result.detections[kMaxMasks - 2].score, 0.8) << "in the order of the masks";
  EXPECT_EQ(result.detections[kMaxMasks - 1].score, 0.7);
  EXPECT_EQ(result.refused.count(MaskRefusal::kOverLimit), 100'000U - kMaxMasks);
  EXPECT_EQ(result.refused.first(MaskRefusal::kOverLimit),
            "instance masks: there are 100000; the best 300 are taken");
}

TEST(DetectionBuilder, OneBadMaskLeavesTheOthersAlone) {
  const DetectionResult result =
      build(masksOf({chair({10, 5, 20, 10}, kNan), chair({10, 5, 20, 10}), chair({0, 0, 2, 2})}),
            wallAt(2.0F));
  EXPECT_EQ(result.detections.size(), 1U);
  EXPECT_EQ(result.refused.total(), 2U);
  EXPECT_EQ(result.refused.first(MaskRefusal::kEmpty), "");
}

TEST(DetectionBuilder, RefusalsOfTheSegmenterAreKept) {
  InstanceMasks masks = masksOf({chair({0, 0, 2, 2})});
  masks.refused.add(
      MaskRefusal::kTooFewPoints, [] { return std::string("earlier"); }, 4);
  const DetectionResult result = build(masks, wallAt(2.0F));
  EXPECT_EQ(result.refused.count(MaskRefusal::kTooFewPoints), 5U);
  EXPECT_EQ(result.refused.first(MaskRefusal::kTooFewPoints), "earlier");
}

TEST(DetectionBuilder, MasksOfAnotherAspectRatioAreRefusedWhole) {
  EXPECT_EQ(frameRefusal(wallAt(2.0F), {160, 90}),
            "instance masks: their image is 160 x 90 pixels; it must have the aspect ratio of the "
            "depth image, 40 x 30, and be registered to it");
  EXPECT_NE(frameRefusal(wallAt(2.0F), {0, 0}), "");
  EXPECT_NE(frameRefusal(wallAt(2.0F), {40'000, 30'000}), "");
  EXPECT_EQ(frameRefusal(wallAt(2.0F), {641, 480}), "") << "rounded sides are the same view";
}

TEST(DetectionBuilder, FrameThatCannotBeUsedIsRefused) {
  DepthFrame frame = wallAt(2.0F);
  frame.camera.fx = kNan;
  EXPECT_NE(frameRefusal(frame).find("camera: fx"), std::string::npos);
  frame = wallAt(2.0F);
  frame.depth.pixels = cv::Mat(kSize, CV_8UC1, cv::Scalar(2));
  EXPECT_EQ(frameRefusal(frame), "depth image: has OpenCV type 0; it must be CV_16UC1 or CV_32FC1");
  frame = wallAt(2.0F);
  frame.depth.pixels = frame.depth.pixels.rowRange(0, 29);
  EXPECT_EQ(frameRefusal(frame), "depth image: is 40 x 29 pixels; the camera model wants 40 x 30");
  frame = wallAt(2.0F);
  frame.depth.units_per_m = 0.0;
  EXPECT_NE(frameRefusal(frame).find("units_per_m"), std::string::npos);
  frame = wallAt(2.0F);
  frame.T_map_camera.translation().x() = kNan;
  EXPECT_NE(frameRefusal(frame).find("camera pose"), std::string::npos);
  frame = wallAt(2.0F);
  frame.stamp_s = kNan;
  EXPECT_NE(frameRefusal(frame).find("stamp"), std::string::npos);
}

TEST(DetectionBuilder, RefusesSettingsOutOfRange) {
  EXPECT_EQ(configRefusal({0.004, 6.0, 50, 10.0, 300}),
            "perception.objects.cluster_eps_m: is 0.004; allowed is [0.005, 10]");
  EXPECT_NE(configRefusal({10.1, 6.0, 50, 10.0, 300}), "");
  EXPECT_NE(configRefusal({kNan, 6.0, 50, 10.0, 300}), "");
  EXPECT_EQ(configRefusal({0.05, -1.0, 50, 10.0, 300}),
            "perception.objects.cluster_gap_pixels: is -1; allowed is [0, 100]");
  EXPECT_NE(configRefusal({0.05, kNan, 50, 10.0, 300}), "");
  EXPECT_EQ(configRefusal({0.05, 6.0, 0, 10.0, 300}),
            "perception.objects.min_points: is 0; allowed is [1, 1e+06]");
  EXPECT_NE(configRefusal({0.05, 6.0, 50, 0.001, 300}), "");
  EXPECT_NE(configRefusal({0.05, 6.0, 50, kNan, 300}), "");
  EXPECT_EQ(configRefusal({0.05, 6.0, 50, 10.0, 0}),
            "perception.objects.max_masks: is 0; allowed is [1, 300]");
}

}  // namespace
}  // namespace occusg
