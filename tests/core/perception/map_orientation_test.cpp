// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/map_orientation.hpp"

#include <gtest/gtest.h>

#include "box_world.hpp"

namespace occusg {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

MapOrientation orientationOf(const std::vector<DepthFrame>& frames, const Pose& T_other_map) {
  MapOrientationEstimator estimator;
  for (DepthFrame frame : frames) {
    frame.T_map_camera = T_other_map * frame.T_map_camera;
    estimator.add(frame);
  }
  return estimator.estimate();
}

Pose turned(const Eigen::Vector3d& axis, double degrees, const Eigen::Vector3d& by) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(degrees * kDegree, axis.normalized()).toRotationMatrix();
  pose.translation() = by;
  return pose;
}

TEST(MapOrientation, LevelMapIsLevelAndItsFloorIsAtZero) {
  const MapOrientation orientation =
      orientationOf(testing::driveThroughTwoRooms(), Pose::Identity());
  EXPECT_NEAR(orientation.down_off_rad, 0.0, 0.5 * kDegree);
  ASSERT_TRUE(orientation.floor_height_m);
  EXPECT_NEAR(*orientation.floor_height_m, 0.0, 0.02);
}

TEST(MapOrientation, FloorFarFromTheOriginIsJudgedWhereTheCameraWas) {
  const MapOrientation near = orientationOf(testing::driveThroughTwoRooms(), Pose::Identity());
  const MapOrientation far =
      orientationOf(testing::driveThroughTwoRooms(), turned({0, 0, 1}, 0.0, {20000, -30000, 0}));
  ASSERT_TRUE(floorAtMiddle_m(near) && floorAtMiddle_m(far));
  EXPECT_NEAR(*floorAtMiddle_m(near), 0.0, 0.02);
  EXPECT_NEAR(*floorAtMiddle_m(far), 0.0, 0.05);
  EXPECT_FALSE(hasFarFloor(far));
  EXPECT_TRUE(hasFarFloor(
      orientationOf(testing::driveThroughTwoRooms(), turned({0, 0, 1}, 0.0, {20000, 0, 1.5}))));
}

TEST(MapOrientation, MapOfAVisualSlamIsLevelled) {
  // Its world is the first camera: y down, 1.2 m above the floor.
  const Pose T_other_map = turned({1, 0.2, 0}, 99.0, {0.4, 0.3, -1.2});
  const MapOrientation orientation = orientationOf(testing::driveThroughTwoRooms(), T_other_map);
  EXPECT_NEAR(orientation.down_off_rad, 99.0 * kDegree, 0.5 * kDegree);
  const Pose T_level_map = levelling(orientation) * T_other_map;
  EXPECT_NEAR(T_level_map.linear()(2, 2), 1.0, 1e-4) << "z is up";
  EXPECT_NEAR(T_level_map.translation().z(), 0.0, 0.02) << "the floor is at zero";
}

TEST(MapOrientation, WithoutFramesTheMapIsTakenAsItIs) {
  const MapOrientation orientation = MapOrientationEstimator().estimate();
  EXPECT_EQ(orientation.agreement, 0.0);
  EXPECT_FALSE(orientation.floor_height_m);
  EXPECT_TRUE(levelling(orientation).isApprox(Pose::Identity()));
}

}  // namespace
}  // namespace occusg
