// SPDX-License-Identifier: BSD-3-Clause
// Frames with a pixel lattice: what must not change the map, and what may be allocated.
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "allocation_counter.hpp"
#include "box_world.hpp"
#include "map_difference.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/perception/depth_projector.hpp"
#include "occusg/perception/range_image.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

constexpr IntegrationMode kModes[] = {IntegrationMode::kReference, IntegrationMode::kExact,
                                      IntegrationMode::kFast};

OccupancyMap mapWith(IntegrationMode mode) {
  OccupancyMapConfig config;
  config.mode = mode;
  return OccupancyMap(config);
}

RangeImage imageFrom(const Eigen::Vector3d& position, double yaw_rad = 0.3) {
  static const testing::BoxWorld world = testing::twoRooms();
  DepthProjector projector({1, 0.01, 10.0, BeyondMaxDepth::kClear});
  const DepthFrame frame = world.seenFrom(position, yaw_rad, 0.0);
  return projector.projectLattice(frame.depth, frame.camera, frame.T_map_camera);
}

/// The image with everything moved, as a robot far from the map's origin has it.
RangeImage movedAlongX(RangeImage image, float by_m) {
  image.origin.x += by_m;
  image.T_map_camera.translation().x() += static_cast<double>(by_m);
  for (Point3f& end : image.ends) end.x += by_m;
  return image;
}

TEST(RangeImageInsertion, FrameOfNothingButInvalidPixelsChangesNothing) {
  for (const IntegrationMode mode : kModes) {
    OccupancyMap map = mapWith(mode);
    RangeImage image = imageFrom({1.9, 2.05, 1.2});
    image.kinds.assign(image.kinds.size(), RayEnd::kNone);
    const MapChange change = map.insert(image);
    EXPECT_TRUE(change.no_rays);
    EXPECT_TRUE(change.columns.empty());
    EXPECT_EQ(map.tree().size(), 0U);
  }
}

TEST(RangeImageInsertion, PoseThatIsNotANumberChangesNothing) {
  for (const IntegrationMode mode : {IntegrationMode::kExact, IntegrationMode::kFast}) {
    OccupancyMap map = mapWith(mode);
    RangeImage image = imageFrom({1.9, 2.05, 1.2});
    image.T_map_camera.linear()(0, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(map.insert(image).origin_outside_map);
    image = imageFrom({1.9, 2.05, 1.2});
    image.origin.y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(map.insert(image).origin_outside_map);
    EXPECT_EQ(map.tree().size(), 0U);
  }
}

TEST(RangeImageInsertion, CameraInAnOccupiedVoxelChangesNothing) {
  OccupancyMap map = mapWith(IntegrationMode::kExact);
  map.insert(testing::occupiedVoxel({38, 41}, 24));
  const std::size_t nodes = map.tree().size();
  const MapChange change = map.insert(imageFrom({38.5 * 0.05, 41.5 * 0.05, 24.5 * 0.05}));
  EXPECT_TRUE(change.origin_occupied);
  EXPECT_EQ(map.tree().size(), nodes);
  EXPECT_FALSE(map.insert(imageFrom({39.5 * 0.05, 41.5 * 0.05, 24.5 * 0.05})).ignored());
}

TEST(RangeImageInsertion, RaysThatEndNowhereAreIgnoredAndCounted) {
  const float inf = std::numeric_limits<float>::infinity();
  RangeImage image = imageFrom({1.9, 2.05, 1.2});
  RangeImage damaged = image;
  damaged.ends[1000] = {inf, 0.0F, 0.0F};
  damaged.ends[1001] = {0.0F, std::numeric_limits<float>::quiet_NaN(), 0.0F};
  damaged.ends[1002] = {0.0F, 0.0F, -1e30F};
  for (const std::size_t i : {1000U, 1001U, 1002U}) {
    ASSERT_EQ(image.kinds[i], RayEnd::kHit);
    image.kinds[i] = RayEnd::kNone;
  }
  for (const IntegrationMode mode : kModes) {
    OccupancyMap clean = mapWith(mode);
    clean.insert(image);
    OccupancyMap map = mapWith(mode);
    EXPECT_EQ(map.insert(damaged).points_outside_map, 3U);
    EXPECT_TRUE(map.tree() == clean.tree());
  }
}

TEST(RangeImageInsertion, RaysBeyondTheKeysAreIgnoredAndCountedAsInTheReference) {
  const RangeImage image = movedAlongX(imageFrom({1.9, 2.05, 1.2}), 1634.4F);
  OccupancyMap reference = mapWith(IntegrationMode::kReference);
  OccupancyMap exact = mapWith(IntegrationMode::kExact);
  const std::size_t outside = reference.insert(image).points_outside_map;
  EXPECT_GT(outside, 0U);
  EXPECT_LT(outside, image.hits);
  EXPECT_EQ(exact.insert(image).points_outside_map, outside);
  const auto difference = testing::differenceOf(exact.tree(), reference.tree());
  EXPECT_EQ(difference.lost_occupied, 0U);
  EXPECT_LE(difference.missingShare(), 1e-3);
  EXPECT_LE(difference.extraShare(), 1e-3);
}

TEST(RangeImageInsertion, MapThatHasReachedItsMemoryTakesNoMore) {
  OccupancyMapConfig config;
  config.max_memory_mb = 0.1;
  for (const IntegrationMode mode : kModes) {
    config.mode = mode;
    OccupancyMap map(config);
    EXPECT_FALSE(map.insert(imageFrom({1.9, 2.05, 1.2})).memory_exhausted);
    const std::size_t nodes = map.tree().size();
    const MapChange change = map.insert(imageFrom({1.9, 2.05, 1.2}, 3.0));
    EXPECT_TRUE(change.memory_exhausted);
    EXPECT_TRUE(change.columns.empty());
    EXPECT_EQ(map.tree().size(), nodes);
    EXPECT_TRUE(map.insert(testing::occupiedVoxel({0, 0}, 0)).memory_exhausted);
  }
}

std::unique_ptr<octomap::OcTree> copyOf(const OccupancyMap& map) {
  return std::make_unique<octomap::OcTree>(map.tree());
}

TEST(RangeImageInsertion, LoadedMapThatIsTooLargeTakesNoMore) {
  OccupancyMap saved = mapWith(IntegrationMode::kExact);
  saved.insert(imageFrom({1.9, 2.05, 1.2}));
  OccupancyMapConfig config;
  config.max_memory_mb = 0.1;
  OccupancyMap map(config, copyOf(saved));
  EXPECT_TRUE(map.insert(imageFrom({1.9, 2.05, 1.2}, 3.0)).memory_exhausted);
  EXPECT_TRUE(map.tree() == saved.tree());
}

TEST(RangeImageInsertion, LoadedMapGoesOnAsIfItHadNotBeenSaved) {
  OccupancyMap one = mapWith(IntegrationMode::kExact);
  for (int i = 0; i < 8; ++i) one.insert(imageFrom({1.9, 2.05, 1.2}, 0.05 * i));
  OccupancyMap other(one.config(), copyOf(one));
  ASSERT_TRUE(other.tree() == one.tree());
  for (int i = 0; i < 8; ++i) {
    one.insert(imageFrom({1.9, 2.05, 1.2}, 3.0 - 0.05 * i));
    other.insert(imageFrom({1.9, 2.05, 1.2}, 3.0 - 0.05 * i));
  }
  EXPECT_TRUE(other.tree() == one.tree());
}

TEST(RangeImageInsertion, ChangedColumnsAreExactlyThoseThatDiffer) {
  OccupancyMap map = mapWith(IntegrationMode::kExact);
  auto before = std::make_unique<octomap::OcTree>(OccupancyMapConfig{}.resolution_m);
  for (int i = 0; i < 4; ++i) {
    const MapChange change = map.insert(imageFrom({1.9, 2.05, 1.2}, 0.1 * i));
    std::set<Cell> columns;
    testing::forEachVoxel(map.tree(), [&](const octomap::OcTreeKey& key, bool occupied) {
      const octomap::OcTreeNode* old = before->search(key);
      if (old == nullptr || before->isNodeOccupied(old) != occupied)
        columns.insert({key[0] - 32768, key[1] - 32768});
    });
    EXPECT_TRUE(change.columns == std::vector<Cell>(columns.begin(), columns.end()))
        << "frame " << i;
    before = std::make_unique<octomap::OcTree>(map.tree());
  }
}

TEST(RangeImageInsertion, VoxelsAtTheClampStillTakeHits) {
  // Enough frames that whole blocks are known to stand at the clamp, then something stands there.
  OccupancyMap exact = mapWith(IntegrationMode::kExact);
  OccupancyMap reference = mapWith(IntegrationMode::kReference);
  const RangeImage empty_room = imageFrom({1.9, 2.05, 1.2});
  RangeImage blocked = empty_room;
  for (Point3f& end : blocked.ends) {
    end = {blocked.origin.x + 0.6F * (end.x - blocked.origin.x),
           blocked.origin.y + 0.6F * (end.y - blocked.origin.y),
           blocked.origin.z + 0.6F * (end.z - blocked.origin.z)};
  }
  for (int i = 0; i < 24; ++i) {
    const bool is_blocked = i / 8 % 2 == 1;
    const RangeImage& image = is_blocked ? blocked : empty_room;
    exact.insert(image);
    reference.insert(image);
    const auto difference = testing::differenceOf(exact.tree(), reference.tree());
    ASSERT_EQ(difference.lost_occupied, 0U) << "frame " << i;
    ASSERT_LE(difference.missingShare(), 1e-4) << "frame " << i;
    ASSERT_LE(difference.extraShare(), 1e-3) << "frame " << i;
  }
}

TEST(RangeImageInsertion, AllocatesNoMoreInKnownSpaceHoweverManyFrames) {
  for (const IntegrationMode mode : {IntegrationMode::kExact, IntegrationMode::kFast}) {
    std::vector<RangeImage> images;
    for (int i = 0; i < 8; ++i) images.push_back(imageFrom({1.9, 2.05, 1.2}, 0.1 * i));
    OccupancyMap map = mapWith(mode);
    const auto allocatedBy = [&](int rounds) {
      const std::size_t before = testing::allocatedBytes();
      for (int round = 0; round < rounds; ++round)
        for (const RangeImage& image : images) (void)map.insert(image);
      return testing::allocatedBytes() - before;
    };
    (void)allocatedBy(15);  // until every voxel has settled
    const std::size_t early = allocatedBy(5);
    (void)allocatedBy(8);
    EXPECT_LE(allocatedBy(5), early);
    EXPECT_LT(early, 5U * 8U * 65536U) << "a frame is meant to reuse what earlier ones left";
  }
}

}  // namespace
}  // namespace occusg
