// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <tf2/buffer_core.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>

#include "occusg/error.hpp"
#include "occusg_ros/input_health.hpp"
#include "occusg_ros/parameters.hpp"
#include "occusg_ros/pose_conversions.hpp"
#include "occusg_ros/saved_folder.hpp"
#include "occusg_ros/tf_poses.hpp"
#include "temporary_folder.hpp"

namespace occusg_ros {
namespace {

TEST(Parameters, AllErrorsComeAtOnceAndUnknownNamesGetASuggestion) {
  occusg::PipelineConfig config;
  std::string frame;
  std::vector<occusg::Parameter> parameters = occusg::parametersOf(config);
  parameters.push_back(textParameter(frame, {"map_frame", "", "Frame of the map."}));
  const ParameterReport report = assign({{"regions.period_s", "-1"},
                                         {"mapping.occupancy.resolution_m", "ten"},
                                         {"map_fram", "odom"},
                                         {"map_frame", "world"},
                                         {"num_worker_threads", "4"}},
                                        parameters, {"num_worker_threads"});
  EXPECT_EQ(report.errors.size(), 2U);
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_NE(report.warnings[0].find("did you mean ~map_frame"), std::string::npos);
  EXPECT_EQ(frame, "world");
}

TEST(Parameters, NestedStructsBecomeDottedKeys) {
  XmlRpc::XmlRpcValue value;
  value["mapping"]["occupancy"]["resolution_m"] = 0.1;
  value["regions"]["decomposer"] = "dude";
  value["perception"]["depth"]["stride"] = 3;
  value["save_on_exit"] = true;
  const GivenParameters given = flattened(value);
  EXPECT_EQ(given.at("mapping.occupancy.resolution_m"), "0.1");
  EXPECT_EQ(given.at("regions.decomposer"), "dude");
  EXPECT_EQ(given.at("perception.depth.stride"), "3");
  EXPECT_EQ(given.at("save_on_exit"), "true");
}

TEST(SavedFolder, FailureMode18NameIsNeverAPath) {
  EXPECT_EQ(checkedSaveName(""), "last");
  EXPECT_EQ(checkedSaveName("flat-2.b_1"), "flat-2.b_1");
  for (const char* name : {"..", "../x", "/etc", "a/b", ".hidden", "a b", "a\nb", "~", "a\\b"})
    EXPECT_THROW((void)checkedSaveName(name), occusg::Error) << name;
  EXPECT_THROW((void)checkedSaveName(std::string(65, 'a')), occusg::Error);
}

TEST(SavedFolder, FailureMode18FolderLiesWithinTheRootOfTheEnvironment) {
  const occusg::testing::TemporaryFolder folder;
  std::filesystem::create_directories(folder.at("root/maps"));
  std::filesystem::create_directory_symlink(folder.path(), folder.at("root/out"));
  for (const std::string& root : {folder.at("root"), folder.at("root/")}) {
    setenv(kSaveRootVariable, root.c_str(), 1);
    EXPECT_EQ(expandedFolder(folder.at("root/maps")), folder.at("root/maps"));
    EXPECT_EQ(expandedFolder(folder.at("root/new/one")), folder.at("root/new/one"));
    EXPECT_EQ(expandedFolder(folder.at("root")), folder.at("root"));
    for (const char* outside : {"rootless", "root/../maps", "root/out", "root/out/maps"})
      EXPECT_THROW((void)expandedFolder(folder.at(outside)), occusg::Error) << outside;
    EXPECT_THROW((void)expandedFolder("/etc"), occusg::Error);
  }
  unsetenv(kSaveRootVariable);
  EXPECT_EQ(expandedFolder("/etc"), "/etc");
}

TEST(SavedFolder, FailureMode16TildeIsTheHome) {
  setenv("HOME", "/home/robot", 1);
  unsetenv("ROS_HOME");
  EXPECT_EQ(expandedFolder("~/maps"), "/home/robot/maps");
  EXPECT_EQ(expandedFolder(""), "/home/robot/.ros/occusg");
  setenv("ROS_HOME", "/var/ros", 1);
  EXPECT_EQ(expandedFolder(""), "/var/ros/occusg");
  EXPECT_EQ(expandedFolder("/data"), "/data");
}

TEST(InputHealth, MissingInputsAreNamedInOneSentence) {
  const std::string sentence = missingInput(
      {{"depth image", "/camera/depth", 0, 0}, {"camera_info", "/camera/info", 0, 1}}, "");
  EXPECT_NE(sentence.find("no depth image on /camera/depth"), std::string::npos);
  EXPECT_NE(sentence.find("and no camera_info on /camera/info"), std::string::npos);
  EXPECT_EQ(sentence.find('\n'), std::string::npos);
  EXPECT_NE(
      missingInput({{"depth image", "/d", 5, 1}}, "no transform map <- cam").find("map <- cam"),
      std::string::npos);
  EXPECT_EQ(missingInput({{"depth image", "/d", 5, 1}}, ""), "");
}

TEST(InputHealth, MissingInputsAreSaidOnceAndAgainWhenOthersAreMissing) {
  MissingInputReport report;
  NeededInput image{"depth image", "/image", 0, 0};
  EXPECT_EQ(report.toSay({image}, "", 1.0), "") << "a driver takes a moment";
  EXPECT_NE(report.toSay({image}, "", 4.5), "");
  EXPECT_EQ(report.toSay({image}, "", 5.5), "");
  image.received = 3;
  EXPECT_EQ(report.toSay({image}, "", 6.5), "");
  EXPECT_NE(report.toSay({image}, "no transform", 7.5), "");
  EXPECT_EQ(report.toSay({image}, "no transform", 8.5), "");
  EXPECT_NE(report.toSay({image}, "no transform", 38.5), "");
}

TEST(InputHealth, DropsAreCountedByReason) {
  InputHealth health;
  health.noteReceived();
  health.noteDropped(Drop::kImage, "broken");
  health.noteDropped(Drop::kOverload, "", 3);
  const InputHealth::Counts counts = health.counts();
  EXPECT_EQ(counts.of(Drop::kImage), 1U);
  EXPECT_EQ(counts.droppedInAll(), 4U);
  EXPECT_EQ(counts.last_problem, "broken");
}

geometry_msgs::TransformStamped transform(double stamp_s, double x) {
  geometry_msgs::TransformStamped msg;
  msg.header.stamp = ros::Time(stamp_s);
  msg.header.frame_id = "map";
  msg.child_frame_id = "camera";
  msg.transform.translation.x = x;
  msg.transform.rotation.w = 1.0;
  return msg;
}

TEST(TfPoses, FailureMode04PoseIsNeverMadeUp) {
  tf2::BufferCore tf;
  EXPECT_EQ(poseAt(tf, "map", "camera", ros::Time(5.0)).kind, PoseAnswer::Kind::kNotYet);
  tf.setTransform(transform(10.0, 1.0), "test");
  tf.setTransform(transform(11.0, 2.0), "test");
  const PoseAnswer between = poseAt(tf, "map", "camera", ros::Time(10.5));
  ASSERT_EQ(between.kind, PoseAnswer::Kind::kFound);
  EXPECT_DOUBLE_EQ(between.T_target_source.translation().x(), 1.5);
  EXPECT_EQ(poseAt(tf, "map", "camera", ros::Time(12.0)).kind, PoseAnswer::Kind::kNotYet);
  const PoseAnswer too_old = poseAt(tf, "map", "camera", ros::Time(9.0));
  EXPECT_EQ(too_old.kind, PoseAnswer::Kind::kNever);
  EXPECT_NE(too_old.problem.find("map <- camera"), std::string::npos);
  EXPECT_EQ(poseAt(tf, "map", "", ros::Time()).kind, PoseAnswer::Kind::kUnusable);
}

TEST(TfPoses, LagIsThatOfTheNewestTransform) {
  tf2::BufferCore tf;
  EXPECT_FALSE(transformAge(tf, "map", "camera", ros::Time(12.0)));
  EXPECT_FALSE(transformAge(tf, "map", "", ros::Time(12.0)));
  tf.setTransform(transform(10.0, 1.0), "test");
  tf.setTransform(transform(11.0, 2.0), "test");
  EXPECT_DOUBLE_EQ(transformAge(tf, "map", "camera", ros::Time(12.5)).value_or(-1.0), 1.5);
  geometry_msgs::TransformStamped mount = transform(0.0, 1.0);
  mount.child_frame_id = "mount";
  tf.setTransform(mount, "test", true);
  EXPECT_EQ(transformAge(tf, "map", "mount", ros::Time(12.5)), 0.0) << "it holds for all times";
}

TEST(PoseConversions, FailureMode04OnlyRotationsAndFiniteNumbersAreAPose) {
  geometry_msgs::Transform msg = transform(0.0, 3.0).transform;
  EXPECT_DOUBLE_EQ(toPose(msg, "tf").translation().x(), 3.0);
  msg.rotation.w = 0.5;
  EXPECT_THROW((void)toPose(msg, "tf"), occusg::Error);
  msg.rotation.w = 0.0;
  EXPECT_THROW((void)toPose(msg, "tf"), occusg::Error);
  msg = transform(0.0, std::numeric_limits<double>::quiet_NaN()).transform;
  EXPECT_THROW((void)toPose(msg, "tf"), occusg::Error);
}

TEST(PoseConversions, PoseSurvivesTheWayThroughAMessage) {
  occusg::Pose pose = occusg::Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(1, -2, 3);
  EXPECT_TRUE(toPose(toPoseMsg(pose), "pose").isApprox(pose, 1e-12));
  EXPECT_TRUE(toPose(toTransformMsg(pose), "tf").isApprox(pose, 1e-12));
}

}  // namespace
}  // namespace occusg_ros
