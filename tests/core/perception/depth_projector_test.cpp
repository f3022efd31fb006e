// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/depth_projector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Focal length of 2 pixels, principal point at pixel (1, 1).
constexpr CameraModel kCamera{4, 3, 2.0, 2.0, 1.0, 1.0};

DepthProjectorConfig everyPixel(BeyondMaxDepth beyond = BeyondMaxDepth::kClear) {
  return {1, 0.5, 10.0, beyond};
}

DepthImage metres(const cv::Mat_<float>& pixels) { return {pixels, 1.0}; }

cv::Mat_<float> flat(float depth_m) { return cv::Mat_<float>(3, 4, depth_m); }

/// Looks along +x of the map from (1, 2, 3): camera x is map -y, camera y is map -z.
Pose lookingAlongX() {
  Pose pose = Pose::Identity();
  pose.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  pose.translation() << 1, 2, 3;
  return pose;
}

void expectNear(const Point3f& point, double x, double y, double z) {
  EXPECT_NEAR(point.x, x, 1e-6);
  EXPECT_NEAR(point.y, y, 1e-6);
  EXPECT_NEAR(point.z, z, 1e-6);
}

std::string refusal(const DepthProjectorConfig& config, const DepthImage& image,
                    const CameraModel& camera, const Pose& pose) {
  try {
    DepthProjector projector(config);
    (void)projector.project(image, camera, pose);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(DepthProjector, PixelGoesWhereThePinholeModelSays) {
  cv::Mat_<float> pixels = flat(kNan);
  pixels(2, 3) = 4.0F;  // (3 - 1) / 2 and (2 - 1) / 2 of the depth off the axis
  DepthProjector projector(everyPixel());
  const PointCloud cloud = projector.project(metres(pixels), kCamera, Pose::Identity());
  ASSERT_EQ(cloud.points.size(), 1U);
  expectNear(cloud.points[0], 4.0, 2.0, 4.0);
  expectNear(cloud.origin, 0.0, 0.0, 0.0);
}

TEST(DepthProjector, PoseCarriesPointsAndOriginIntoTheMap) {
  cv::Mat_<float> pixels = flat(0.0F);
  pixels(2, 3) = 4.0F;
  DepthProjector projector(everyPixel());
  const PointCloud cloud = projector.project(metres(pixels), kCamera, lookingAlongX());
  ASSERT_EQ(cloud.points.size(), 1U);
  expectNear(cloud.points[0], 1.0 + 4.0, 2.0 - 4.0, 3.0 - 2.0);
  expectNear(cloud.origin, 1.0, 2.0, 3.0);
}

TEST(DepthProjector, MillimetresAndMetresGiveTheSameCloud) {
  cv::Mat_<std::uint16_t> millimetres(3, 4, std::uint16_t{1500});
  DepthProjector projector(everyPixel());
  const PointCloud a = projector.project(DepthImage{millimetres, 1000.0}, kCamera, lookingAlongX());
  const PointCloud b = projector.project(metres(flat(1.5F)), kCamera, lookingAlongX());
  ASSERT_EQ(a.points.size(), 12U);
  ASSERT_EQ(b.points.size(), 12U);
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].x, b.points[i].x);
    EXPECT_EQ(a.points[i].y, b.points[i].y);
    EXPECT_EQ(a.points[i].z, b.points[i].z);
  }
}

TEST(DepthProjector, StrideKeepsTheLatticeFromTheFirstPixelInRowMajorOrder) {
  const CameraModel camera{5, 4, 1.0, 1.0, 0.0, 0.0};
  DepthProjectorConfig config = everyPixel();
  config.stride = 2;
  DepthProjector projector(config);
  const PointCloud cloud =
      projector.project(metres(cv::Mat_<float>(4, 5, 1.0F)), camera, Pose::Identity());
  ASSERT_EQ(cloud.points.size(), 6U);
  std::size_t i = 0;
  for (int v = 0; v < 4; v += 2)
    for (int u = 0; u < 5; u += 2) expectNear(cloud.points[i++], u, v, 1.0);
}

TEST(DepthProjector, StrideWiderThanTheImageKeepsTheFirstPixel) {
  DepthProjectorConfig config = everyPixel();
  config.stride = kMaxImageSide;
  DepthProjector projector(config);
  EXPECT_EQ(projector.project(metres(flat(1.0F)), kCamera, Pose::Identity()).points.size(), 1U);
}

TEST(DepthProjector, DropsAreCountedByKind) {
  cv::Mat_<float> pixels = flat(2.0F);
  pixels(0, 0) = 0.0F;
  pixels(0, 1) = -0.0F;
  pixels(0, 2) = kNan;
  pixels(0, 3) = kInf;
  pixels(1, 0) = -kInf;
  pixels(1, 1) = -1.0F;
  pixels(1, 2) = 0.49F;
  pixels(1, 3) = 10.5F;
  DepthProjector projector(everyPixel(BeyondMaxDepth::kDrop));
  const PointCloud cloud = projector.project(metres(pixels), kCamera, Pose::Identity());
  EXPECT_EQ(cloud.drops.zero, 2U);
  EXPECT_EQ(cloud.drops.nan, 1U);
  EXPECT_EQ(cloud.drops.infinite, 2U);
  EXPECT_EQ(cloud.drops.negative, 1U);
  EXPECT_EQ(cloud.drops.too_near, 1U);
  EXPECT_EQ(cloud.drops.too_far, 1U);
  EXPECT_EQ(cloud.drops.total(), 8U);
  EXPECT_EQ(cloud.points.size(), 4U);
  EXPECT_TRUE(cloud.misses.empty());
}

TEST(DepthProjector, BothDepthLimitsAreInside) {
  cv::Mat_<float> pixels = flat(0.5F);
  pixels(0, 0) = 10.0F;
  DepthProjector projector(everyPixel());
  const PointCloud cloud = projector.project(metres(pixels), kCamera, Pose::Identity());
  EXPECT_EQ(cloud.points.size(), 12U);
  EXPECT_EQ(cloud.drops.total(), 0U);
}

TEST(DepthProjector, PixelBeyondTheMaximumDepthClearsItsRay) {
  cv::Mat_<float> pixels = flat(kNan);
  pixels(2, 3) = 50.0F;
  DepthProjector projector(everyPixel(BeyondMaxDepth::kClear));
  const PointCloud cloud = projector.project(metres(pixels), kCamera, Pose::Identity());
  EXPECT_TRUE(cloud.points.empty());
  ASSERT_EQ(cloud.misses.size(), 1U);
  expectNear(cloud.misses[0], 10.0, 5.0, 10.0);
  EXPECT_EQ(cloud.drops.too_far, 0U);
}

TEST(DepthProjector, DepthThatNoSensorMeasuresNeverClearsAndIsCounted) {
  cv::Mat_<float> pixels = flat(1e30F);
  pixels(0, 0) = 99.0F;  // far, but a sensor can see so far
  pixels(0, 1) = 101.0F;
  DepthProjector projector(everyPixel(BeyondMaxDepth::kClear));
  const PointCloud cloud = projector.project(metres(pixels), kCamera, Pose::Identity());
  EXPECT_EQ(cloud.misses.size(), 1U);
  EXPECT_EQ(cloud.drops.implausible, 11U);
  EXPECT_EQ(cloud.drops.total(), 11U);
}

TEST(DepthProjector, MaximumDepthBeyondWhatIsPlausibleIsBelieved) {
  DepthProjectorConfig config = everyPixel(BeyondMaxDepth::kClear);
  config.max_depth_m = 300.0;
  DepthProjector projector(config);
  EXPECT_EQ(projector.project(metres(flat(250.0F)), kCamera, Pose::Identity()).points.size(), 12U);
}

TEST(DepthProjector, InfinityNeverClears) {
  DepthProjector projector(everyPixel(BeyondMaxDepth::kClear));
  const PointCloud cloud = projector.project(metres(flat(kInf)), kCamera, Pose::Identity());
  EXPECT_TRUE(cloud.misses.empty());
  EXPECT_EQ(cloud.drops.infinite, 12U);
}

TEST(DepthProjector, SaturatedSixteenBitPixelIsOutOfRangeNotFar) {
  cv::Mat_<std::uint16_t> pixels(3, 4, std::uint16_t{65535});
  pixels(0, 0) = 65534;
  pixels(0, 1) = 0;
  DepthProjector projector(everyPixel(BeyondMaxDepth::kClear));
  const PointCloud cloud = projector.project(DepthImage{pixels, 1000.0}, kCamera, Pose::Identity());
  EXPECT_EQ(cloud.misses.size(), 1U);
  EXPECT_EQ(cloud.drops.infinite, 10U);
  EXPECT_EQ(cloud.drops.zero, 1U);
}

TEST(DepthProjector, CameraMayChangeBetweenFrames) {
  const CameraModel wide{4, 3, 1.0, 1.0, 1.0, 1.0};
  const CameraModel larger{8, 6, 2.0, 2.0, 1.0, 1.0};
  DepthProjector projector(everyPixel());
  (void)projector.project(metres(flat(2.0F)), kCamera, Pose::Identity());
  const PointCloud second = projector.project(metres(flat(2.0F)), wide, Pose::Identity());
  expectNear(second.points[0], -2.0, -2.0, 2.0);
  const PointCloud third =
      projector.project(metres(cv::Mat_<float>(6, 8, 2.0F)), larger, Pose::Identity());
  EXPECT_EQ(third.points.size(), 48U);
}

TEST(DepthProjector, ImageThatIsPartOfALargerOneIsReadRowByRow) {
  cv::Mat_<float> larger(10, 10, 7.0F);
  const cv::Mat_<float> part = larger(cv::Rect(2, 3, 4, 3));
  larger(cv::Rect(2, 3, 4, 3)) = 2.0F;
  DepthProjector projector(everyPixel());
  const PointCloud cloud = projector.project(metres(part), kCamera, Pose::Identity());
  ASSERT_EQ(cloud.points.size(), 12U);
  for (const Point3f& point : cloud.points) EXPECT_EQ(point.z, 2.0F);
}

/// The nearest float of an exact result: one rounding, however far the camera is from the origin.
TEST(DepthProjector, RoundsOnceFromDoublePrecision) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    Pose pose = Pose::Identity();
    pose.rotate(
        Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized());
    pose.pretranslate(Eigen::Vector3d(1e3 * any(random), 1e3 * any(random), any(random)));
    cv::Mat_<float> pixels = flat(0.0F);
    for (float& depth : pixels) depth = static_cast<float>(5.0 + 4.0 * any(random));
    DepthProjector projector(everyPixel());
    const PointCloud cloud = projector.project(metres(pixels), kCamera, pose);
    ASSERT_EQ(cloud.points.size(), 12U);
    for (int i = 0; i < 12; ++i) {
      const double z = pixels(i / 4, i % 4);
      const Eigen::Vector3d ray((i % 4 - 1.0) / 2.0 * z, (i / 4 - 1.0) / 2.0 * z, z);
      const Eigen::Vector3d want = pose.linear() * ray + pose.translation();
      const Point3f& got = cloud.points[static_cast<std::size_t>(i)];
      // Half a unit in the last place of a float below 1024, and a little for the double sum.
      EXPECT_LE(std::abs(got.x - want.x()), 3.06e-5);
      EXPECT_LE(std::abs(got.y - want.y()), 3.06e-5);
      EXPECT_LE(std::abs(got.z - want.z()), 3.06e-5);
    }
  }
}

TEST(DepthProjector, RefusesAnImageItCannotRead) {
  const Pose pose = Pose::Identity();
  EXPECT_EQ(refusal(everyPixel(), {cv::Mat(3, 4, CV_8UC1), 1.0}, kCamera, pose),
            "depth image: has OpenCV depth code 0 and 1 channels; it must be CV_16UC1 or CV_32FC1 "
            "(codes 2 and 5, one channel)");
  EXPECT_NE(refusal(everyPixel(), {cv::Mat(3, 4, CV_32FC3), 1.0}, kCamera, pose), "");
  EXPECT_NE(refusal(everyPixel(), {cv::Mat(), 1.0}, kCamera, pose), "");
  EXPECT_EQ(refusal(everyPixel(), {cv::Mat(4, 3, CV_32FC1), 1.0}, kCamera, pose),
            "depth image: is 3 x 4 pixels; the camera model wants 4 x 3");
}

TEST(DepthProjector, RefusesAUnitThatIsNoScale) {
  const Pose pose = Pose::Identity();
  for (const double units : {0.0, -1000.0, static_cast<double>(kNan), static_cast<double>(kInf)})
    EXPECT_NE(refusal(everyPixel(), {flat(1.0F), units}, kCamera, pose).find("units_per_m is "),
              std::string::npos);
}

TEST(DepthProjector, RefusesACameraThatIsNone) {
  const std::string message =
      refusal(everyPixel(), {cv::Mat(0, 0, CV_32FC1), 1.0}, CameraModel{}, Pose::Identity());
  EXPECT_EQ(message.rfind("camera: width is 0 pixels", 0), 0U) << message;
}

TEST(DepthProjector, RefusesAPoseThatIsNotFinite) {
  Pose moved = Pose::Identity();
  moved.translation().x() = kNan;
  Pose turned = Pose::Identity();
  turned.linear()(1, 1) = kInf;
  EXPECT_EQ(refusal(everyPixel(), metres(flat(1.0F)), kCamera, moved).rfind("camera pose: ", 0),
            0U);
  EXPECT_EQ(refusal(everyPixel(), metres(flat(1.0F)), kCamera, turned).rfind("camera pose: ", 0),
            0U);
}

TEST(DepthProjector, RefusesAConfigurationOutOfRange) {
  const auto message = [](const DepthProjectorConfig& config) {
    return refusal(config, metres(flat(1.0F)), kCamera, Pose::Identity());
  };
  EXPECT_EQ(message({0, 0.5, 10.0, BeyondMaxDepth::kDrop}),
            "perception.depth.stride: is 0; allowed is [1, 16384]");
  EXPECT_EQ(message({1, -0.5, 10.0, BeyondMaxDepth::kDrop})
                .rfind("perception.depth.min_depth_m: is -0.5", 0),
            0U);
  EXPECT_EQ(message({1, kNan, 10.0, BeyondMaxDepth::kDrop})
                .rfind("perception.depth.min_depth_m: is .nan", 0),
            0U);
  EXPECT_EQ(message({1, 2.0, 2.0, BeyondMaxDepth::kDrop})
                .rfind("perception.depth.max_depth_m: is 2 m", 0),
            0U);
  EXPECT_EQ(message({1, 2.0, kInf, BeyondMaxDepth::kDrop})
                .rfind("perception.depth.max_depth_m: is .inf", 0),
            0U);
}

}  // namespace
}  // namespace occusg
