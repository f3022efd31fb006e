// SPDX-License-Identifier: BSD-3-Clause
// The map of every mode against OctoMap's own insertion of the same points.
#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "deep_building.hpp"
#include "map_difference.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/perception/depth_projector.hpp"
#include "occusg/perception/range_image.hpp"
#include "recorded_frames.hpp"

namespace occusg {
namespace {

using testing::differenceOf;
using testing::MapDifference;

using FrameSource = std::function<DepthFrame(std::size_t)>;

/// What the frames make of an empty map.
OccupancyMap mapOf(const std::vector<RangeImage>& frames, IntegrationMode mode, int threads = 1) {
  OccupancyMapConfig config;
  config.mode = mode;
  config.threads = threads;
  OccupancyMap map(config);
  for (const RangeImage& frame : frames) EXPECT_FALSE(map.insert(frame).ignored());
  return map;
}

octomap::OcTree octomapOf(const std::vector<RangeImage>& frames) {
  octomap::OcTree tree = testing::emptyTreeLike(OccupancyMapConfig{});
  for (const RangeImage& frame : frames) {
    const octomap::point3d origin(frame.origin.x, frame.origin.y, frame.origin.z);
    tree.insertPointCloud(testing::toOctomapCloud(toPointCloud(frame)), origin, 8.0, false, false);
  }
  return tree;
}

std::vector<RangeImage> imagesOf(std::size_t count, int stride, const FrameSource& frameAt) {
  // Deeper pixels are dropped: OctoMap has no notion of a ray that clears its last voxel.
  DepthProjector projector({stride, 0.01, 65.0, BeyondMaxDepth::kDrop});
  std::vector<RangeImage> images;
  for (std::size_t i = 0; i < count; ++i) {
    const DepthFrame frame = frameAt(i);
    images.push_back(projector.projectLattice(frame.depth, frame.camera, frame.T_map_camera));
  }
  return images;
}

void expectAccuracyRule(const std::vector<RangeImage>& frames) {
  const octomap::OcTree reference = octomapOf(frames);
  EXPECT_TRUE(mapOf(frames, IntegrationMode::kReference).tree() == reference);

  const MapDifference exact =
      differenceOf(mapOf(frames, IntegrationMode::kExact).tree(), reference);
  EXPECT_LE(exact.missingShare(), 1e-4);
  EXPECT_LE(exact.extraShare(), 1e-3);
  EXPECT_GE(exact.occupiedIou(), 0.9999);

  const MapDifference fast = differenceOf(mapOf(frames, IntegrationMode::kFast).tree(), reference);
  EXPECT_GE(fast.sameShare(), 0.985);
  EXPECT_EQ(fast.extra, 0U);
  EXPECT_EQ(fast.lost_occupied, 0U);
  EXPECT_GT(exact.known, 100000U) << "the frames are meant to fill a map";
}

TEST(IntegrationAccuracy, HoldsOverAWholeRecording) {
  const testing::RecordedFrames recording;
  const std::size_t frames = recording.size() / 3;
  ASSERT_GE(frames, 100U);
  expectAccuracyRule(imagesOf(frames, 8, [&](std::size_t i) { return recording.at(3 * i); }));
}

TEST(IntegrationAccuracy, HoldsInABuildingWithLongViews) {
  const testing::BoxWorld world = testing::deepBuilding();
  expectAccuracyRule(
      imagesOf(3, 4, [&](std::size_t i) { return testing::deepFrame(world, 40 * i, 4); }));
}

TEST(IntegrationAccuracy, HoldsWithDepthNoiseAndPixelsThatAreMissing) {
  const testing::BoxWorld world = testing::deepBuilding();
  expectAccuracyRule(imagesOf(3, 4, [&](std::size_t i) {
    DepthFrame frame = testing::deepFrame(world, 60 * i, 4, testing::DepthNoise::kStereo);
    for (int v = 0; v < frame.depth.pixels.rows; v += 4)
      for (int u = v % 64; u < frame.depth.pixels.cols; u += 12)
        frame.depth.pixels.at<std::uint16_t>(v, u - u % 4) = 0;
    return frame;
  }));
}

TEST(IntegrationAccuracy, ExactIsTheReferenceUnderMissesBeyondTheMaximumDepth) {
  const testing::BoxWorld world = testing::deepBuilding();
  DepthProjector projector({8, 0.01, 5.0, BeyondMaxDepth::kClear});
  std::vector<RangeImage> images;
  for (std::size_t i = 0; i < 8; ++i) {
    const DepthFrame frame = testing::deepFrame(world, 30 * i, 8);
    images.push_back(projector.projectLattice(frame.depth, frame.camera, frame.T_map_camera));
  }
  const MapDifference difference = differenceOf(mapOf(images, IntegrationMode::kExact).tree(),
                                                mapOf(images, IntegrationMode::kReference).tree());
  EXPECT_LE(difference.missingShare(), 1e-4);
  EXPECT_LE(difference.extraShare(), 1e-3);
  EXPECT_EQ(difference.lost_occupied, 0U);
}

TEST(IntegrationAccuracy, ThreadsDoNotChangeTheMap) {
  const testing::BoxWorld world = testing::deepBuilding();
  const std::vector<RangeImage> images =
      imagesOf(3, 4, [&](std::size_t i) { return testing::deepFrame(world, 40 * i, 4); });
  for (const IntegrationMode mode : {IntegrationMode::kExact, IntegrationMode::kFast}) {
    const OccupancyMap alone = mapOf(images, mode, 1);
    EXPECT_TRUE(mapOf(images, mode, 2).tree() == alone.tree());
    EXPECT_TRUE(mapOf(images, mode, 5).tree() == alone.tree());
  }
}

}  // namespace
}  // namespace occusg
