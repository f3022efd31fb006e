// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/orientation_check.hpp"

#include <gtest/gtest.h>

#include "box_world.hpp"

namespace occusg_ros {
namespace {

std::string doubtAbout(const occusg::Pose& T_other_map, double units_per_m = 1000.0) {
  OrientationCheck check;
  double stamp_s = 0.0;
  for (occusg::DepthFrame frame : occusg::testing::driveThroughTwoRooms()) {
    frame.stamp_s = stamp_s++;
    frame.T_map_camera = T_other_map * frame.T_map_camera;
    frame.depth.units_per_m = units_per_m;
    check.add(frame);
  }
  EXPECT_TRUE(check.isDone());
  return check.doubt();
}

TEST(OrientationCheck, ALevelMapWithItsFloorAtZeroIsNotDoubted) {
  EXPECT_EQ(doubtAbout(occusg::Pose::Identity()), "");
}

TEST(OrientationCheck, AMapFrameWhoseZIsNotUpIsSaid) {
  occusg::Pose T_other_map = occusg::Pose::Identity();
  T_other_map.linear() = Eigen::AngleAxisd(1.6, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NE(doubtAbout(T_other_map).find("is about 92 degrees away"), std::string::npos);
}

TEST(OrientationCheck, AMapThatIsUpsideDownMayBeThatOfACameraThatIs) {
  occusg::Pose T_other_map = occusg::Pose::Identity();
  T_other_map.linear() = Eigen::AngleAxisd(3.14, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NE(doubtAbout(T_other_map).find("mounted upside down, nothing is to be done"),
            std::string::npos);
}

TEST(OrientationCheck, AWrongUnitOfTheDepthImagesShowsInTheFloor) {
  EXPECT_NE(doubtAbout(occusg::Pose::Identity(), 250.0)
                .find("the lowest floor that was seen is at z = -"),
            std::string::npos);
}

}  // namespace
}  // namespace occusg_ros
