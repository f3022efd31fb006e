// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "error_sentence.hpp"
#include "occusg_ros/given_storeys.hpp"
#include "occusg_ros/room_path.hpp"
#include "occusg_ros/storey_conversions.hpp"

namespace occusg_ros {
namespace {

using occusg::NodeId;
using occusg::testing::sentenceOf;
using occusg::testing::tells;

constexpr double kUpperFloor_m = 3.0;

occusg::Pose poseAt(double x, double y, double z = 0.0) {
  occusg::Pose pose = occusg::Pose::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

TEST(GivenStoreys, RideFromMapToMapIsALiftBetweenTheStoreys) {
  GivenStoreys storeys(0.0);
  storeys.observe(poseAt(1.0, 2.0));
  storeys.enter(1, kUpperFloor_m);
  storeys.observe(poseAt(1.2, 2.0));
  ASSERT_EQ(storeys.building().passages.size(), 1U);
  const occusg::StoreyPassage& lift = storeys.building().passages.front();
  EXPECT_EQ(lift.kind, occusg::StairsKind::kLift);
  EXPECT_EQ(lift.lower_storey, 0);
  EXPECT_EQ(lift.upper_storey, 1);
  EXPECT_EQ(lift.path.front(), Eigen::Vector3d(1.0, 2.0, 0.0));
  EXPECT_EQ(lift.path.back(), Eigen::Vector3d(1.2, 2.0, kUpperFloor_m));
}

TEST(GivenStoreys, RideBackIsTheSameLift) {
  GivenStoreys storeys(0.0);
  storeys.observe(poseAt(1.0, 2.0));
  storeys.enter(1, kUpperFloor_m);
  storeys.observe(poseAt(1.0, 2.0));
  storeys.enter(0, 0.0);
  storeys.observe(poseAt(1.3, 2.0));
  EXPECT_EQ(storeys.building().passages.size(), 1U);
  EXPECT_EQ(storeys.building().current, 0U);
}

TEST(GivenStoreys, BasementIsBelow) {
  GivenStoreys storeys(0.0);
  storeys.observe(poseAt(1.0, 2.0));
  storeys.enter(1, -2.5);
  storeys.observe(poseAt(1.0, 2.0));
  EXPECT_EQ(storeys.building().passages.front().lower_storey, 1);
  EXPECT_EQ(storeys.building().passages.front().path.front().z(), -2.5);
}

TEST(GivenStoreys, PosesInAPlaneGetTheHeightOfTheFloor) {
  GivenStoreys storeys(0.0);
  EXPECT_EQ(storeys.heightOnStorey(0.1), 0.1);
  storeys.enter(1, kUpperFloor_m);
  EXPECT_DOUBLE_EQ(storeys.heightOnStorey(0.1), kUpperFloor_m + 0.1);
  EXPECT_DOUBLE_EQ(storeys.heightOnStorey(3.2), 3.2) << "a localisation that knows the height";
}

TEST(GivenStoreys, StoreyThatCannotBeIsRefused) {
  GivenStoreys storeys(0.0);
  EXPECT_TRUE(tells(sentenceOf([&] { storeys.enter(2, 6.0); }), {"floor_id", "is 2", "is 1"}));
  EXPECT_TRUE(tells(sentenceOf([&] { storeys.enter(-1, 6.0); }), {"floor_id", "-1"}));
  EXPECT_TRUE(tells(sentenceOf([&] { storeys.enter(1, 0.5); }), {"floor_z", "0.5", "0.8 m"}));
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(tells(sentenceOf([&] { storeys.enter(1, kNaN); }), {"floor_z", "nan"}));
  EXPECT_EQ(storeys.building().storeys.size(), 1U);
}

/// Two storeys with a room each, the upper one above the lower, and a stair between them.
class TwoStoreys : public ::testing::Test {
 protected:
  TwoStoreys() {
    for (int floor = 0; floor < 2; ++floor) addStorey(floor);
    occusg::StairsAttributes stairs;
    stairs.kind = occusg::StairsKind::kStairs;
    stairs.path = {{3.5, 0.5, 0.0}, {3.5, 3.5, kUpperFloor_m}};
    stairs.footprint = {{3.0, 0.5}, {4.0, 0.5}, {4.0, 3.5}, {3.0, 3.5}};
    stairs.rise_m = kUpperFloor_m;
    stairs.risers = 15;
    stairs.upper_storey = 1;
    stairs.lower_room = rooms_[0];
    stairs.upper_room = rooms_[1];
    (void)graph_.add({3.5, 2.0, 1.5}, 1.0, stairs);
    header_.frame_id = "map";
  }

  void addStorey(int floor) {
    const double z_m = floor * kUpperFloor_m;
    occusg::RoomAttributes room;
    room.name = "room_" + std::to_string(floor + 1);
    room.polygon = {{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}}, {}};
    room.area_m2 = 16.0;
    rooms_.push_back(graph_.add({2.0, 2.0, z_m}, 1.0, room, floor).id);
    occusg::NavigationAttributes block;
    const double y = floor == 0 ? 0.5 : 3.5;
    block.block = {3, floor == 0 ? 0 : 3};
    blocks_.push_back(graph_.add({3.5, y, z_m}, 1.0, block, floor).id);
    graph_.connect({occusg::EdgeType::kContains, rooms_.back(), blocks_.back(), {}});
    occusg::FreeSpace layer;
    layer.frame.resolution_m = 0.1;
    layer.cells = occusg::FreeSpaceCells({{0, 0}, {40, 40}}, occusg::kFree);
    layers_.push_back(layer);
  }

  void joinStoreys() {
    graph_.connect({occusg::EdgeType::kTraversable, blocks_[0], blocks_[1], {}});
  }

  occusg::SceneGraph graph_;
  std::vector<NodeId> rooms_;
  std::vector<NodeId> blocks_;
  std::vector<occusg::FreeSpace> layers_;
  std_msgs::Header header_;
};

TEST_F(TwoStoreys, PathLeadsOverTheStairAndRises) {
  joinStoreys();
  const RoomPath way = pathBetween(graph_, layers_, rooms_[0], rooms_[1], 0.2, header_);
  EXPECT_EQ(way.rooms, (std::vector<std::int64_t>{rooms_[0], rooms_[1]}));
  ASSERT_EQ(way.stairs.size(), 1U);
  EXPECT_EQ(way.stairs.front().kind, "stairs");
  EXPECT_DOUBLE_EQ(way.path.poses.front().pose.position.z, 0.0);
  EXPECT_DOUBLE_EQ(way.path.poses.back().pose.position.z, kUpperFloor_m);
  // To the foot of the stair, up its slope, and back to the middle of the room.
  EXPECT_NEAR(way.length_m, 2.12 + 4.24 + 2.12, 0.3);
}

TEST_F(TwoStoreys, PathDownIsThePathUpTurnedRound) {
  joinStoreys();
  const RoomPath down = pathBetween(graph_, layers_, rooms_[1], rooms_[0], 0.2, header_);
  EXPECT_DOUBLE_EQ(down.path.poses.front().pose.position.z, kUpperFloor_m);
  EXPECT_DOUBLE_EQ(down.path.poses.back().pose.position.z, 0.0);
  EXPECT_EQ(down.rooms, (std::vector<std::int64_t>{rooms_[1], rooms_[0]}));
}

TEST_F(TwoStoreys, StoreysThatNothingJoinsHaveNoPath) {
  EXPECT_TRUE(tells(
      sentenceOf([&] { (void)pathBetween(graph_, layers_, rooms_[0], rooms_[1], 0.2, header_); }),
      {"room_1 to room_2", "no stairs, ramp or lift"}));
}

TEST_F(TwoStoreys, StairsMessageNamesRoomsAndStoreys) {
  const std::vector<occusg::StairsInfo> stairs = toStairsMsgs(graph_);
  ASSERT_EQ(stairs.size(), 1U);
  EXPECT_EQ(stairs.front().rooms[0], rooms_[0]);
  EXPECT_EQ(stairs.front().rooms[1], rooms_[1]);
  EXPECT_EQ(stairs.front().floor_ids[1], 1);
  EXPECT_EQ(stairs.front().risers, 15U);
}

occusg::Building house() {
  occusg::Building building;
  building.storeys = {{0, 0.0, {}}, {1, kUpperFloor_m, {}}};
  occusg::StoreyPassage stairs;
  stairs.upper_storey = 1;
  stairs.path = {{1.0, 2.0, 0.0}, {4.0, 2.0, kUpperFloor_m}};
  stairs.risers = 15;
  building.passages = {stairs};
  building.current = 1;
  building.sensor_height_m = 1.2;
  return building;
}

TEST(StoreyArray, BuildingComesThroughTheMessage) {
  const occusg::Building building = toBuilding(toStoreyArray(house(), {}), "storeys");
  ASSERT_EQ(building.storeys.size(), 2U);
  EXPECT_EQ(building.storeys[1].floor_z_m, kUpperFloor_m);
  EXPECT_EQ(building.storeys[1].span.bottom_m, kUpperFloor_m - occusg::kStoreyBelowFloor_m);
  EXPECT_EQ(building.current, 1U);
  EXPECT_EQ(building.sensor_height_m, 1.2);
  ASSERT_EQ(building.passages.size(), 1U);
  EXPECT_EQ(building.passages.front().path, house().passages.front().path);
  EXPECT_EQ(building.passages.front().risers, 15);
}

TEST(StoreyArray, ValuesThatCannotBeAreRefused) {
  const auto refusal = [](const auto& spoil) {
    occusg::StoreyArray msg = toStoreyArray(house(), {});
    spoil(msg);
    return sentenceOf([&msg] { (void)toBuilding(msg, "/storeys"); });
  };
  EXPECT_TRUE(tells(refusal([](auto& msg) { msg.storeys.clear(); }), {"/storeys", "no storeys"}));
  EXPECT_TRUE(tells(refusal([](auto& msg) { msg.current = 2; }), {"floor_id 2", "2 storeys"}));
  EXPECT_TRUE(tells(refusal([](auto& msg) { msg.storeys[1].floor_id = 5; }), {"floor_id 5"}));
  EXPECT_TRUE(tells(
      refusal([](auto& msg) { msg.storeys[0].floor_z = std::numeric_limits<double>::quiet_NaN(); }),
      {"not finite"}));
  EXPECT_TRUE(tells(refusal([](auto& msg) { msg.stairs[0].kind = "rope"; }), {"rope", "lift"}));
  EXPECT_TRUE(tells(refusal([](auto& msg) { msg.stairs[0].path.resize(1); }), {"one point"}));
  EXPECT_TRUE(tells(refusal([](auto& msg) { msg.stairs[0].floor_ids[0] = -1; }), {"floor_id -1"}));
}

}  // namespace
}  // namespace occusg_ros
