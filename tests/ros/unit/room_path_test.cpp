// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/room_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

using occusg::EdgeType;
using occusg::NodeId;

// Rooms of 2 x 2 m in a row along x, with walls of 0.1 m and doors of 1 m between them.
class RoomPathTest : public ::testing::Test {
 protected:
  RoomPathTest() {
    for (int i = 0; i < 3; ++i) addRoom(i);
    for (int i = 0; i < 2; ++i) addDoor(i);
    layer_.frame.resolution_m = 0.1;
    layer_.cells = occusg::FreeSpaceCells({{0, 0}, {60, 20}}, occusg::kFree);
    for (const int wall : {20, 40}) {
      for (int y = 0; y < 20; ++y)
        if (y < 5 || y >= 15) layer_.cells.at({wall, y}) = occusg::kFullObstacle;
    }
    header_.frame_id = "map";
  }

  void addRoom(int i) {
    occusg::RoomAttributes room;
    room.name = "room_" + std::to_string(i);
    const double x = 2.0 * i;
    room.polygon = {{{x, 0.0}, {x + 2.0, 0.0}, {x + 2.0, 2.0}, {x, 2.0}}, {}};
    room.area_m2 = 4.0;
    rooms_.push_back(graph_.add({x + 1.0, 1.0, 0.0}, 1.0, room).id);
  }

  void addDoor(int i) {
    occusg::DoorAttributes door;
    door.segment = {{2.0 * i + 2.0, 0.5}, {2.0 * i + 2.0, 1.5}};
    door.width_m = 1.0;
    door.room_a = rooms_[static_cast<std::size_t>(i)];
    door.room_b = rooms_[static_cast<std::size_t>(i) + 1];
    graph_.connect({EdgeType::kRoomAdjacency, door.room_a, door.room_b, {door.segment}});
    (void)graph_.add({2.0 * i + 2.0, 1.0, 0.0}, 1.0, door);
  }

  occusg::SceneGraph graph_;
  std::vector<NodeId> rooms_;
  occusg::FreeSpace layer_;
  std_msgs::Header header_;
};

TEST_F(RoomPathTest, LeadsThroughFreeSpaceAndTheDoorsInOrder) {
  const RoomPath way = pathBetween(graph_, {layer_}, rooms_[0], rooms_[2], 0.3, header_);
  EXPECT_EQ(way.rooms, (std::vector<std::int64_t>{rooms_[0], rooms_[1], rooms_[2]}));
  ASSERT_EQ(way.doors.size(), 2U);
  EXPECT_DOUBLE_EQ(way.doors[0].ends[0].x, 2.0);
  EXPECT_DOUBLE_EQ(way.doors[1].ends[0].x, 4.0);
  EXPECT_NEAR(way.length_m, 4.0, 0.1);
  EXPECT_EQ(way.path.poses.front().header.frame_id, "map");
  EXPECT_NEAR(way.path.poses.back().pose.position.x, 5.0, 0.1);
}

TEST_F(RoomPathTest, EachPoseLooksToTheNext) {
  const RoomPath way = pathBetween(graph_, {layer_}, rooms_[2], rooms_[0], 0.3, header_);
  ASSERT_GT(way.path.poses.size(), 10U);
  for (const auto& pose : way.path.poses) {
    EXPECT_NEAR(std::abs(pose.pose.orientation.z), 1.0, 0.02) << "it drives along -x";
    EXPECT_NEAR(pose.pose.orientation.w, 0.0, 0.1);
  }
}

TEST_F(RoomPathTest, ANumberMeansTheSameRoomAsItsId) {
  EXPECT_EQ(pathBetween(graph_, {layer_}, 1, 3, 0.3, header_).rooms,
            pathBetween(graph_, {layer_}, rooms_[0], rooms_[2], 0.3, header_).rooms);
}

TEST_F(RoomPathTest, FromARoomToItselfIsThatRoom) {
  const RoomPath way = pathBetween(graph_, {layer_}, rooms_[1], rooms_[1], 0.3, header_);
  EXPECT_EQ(way.rooms, std::vector<std::int64_t>{rooms_[1]});
  EXPECT_TRUE(way.doors.empty());
}

TEST_F(RoomPathTest, SaysWhyThereIsNoWay) {
  const auto problem = [&](std::int64_t from, std::int64_t to, double radius_m) -> std::string {
    try {
      (void)pathBetween(graph_, {layer_}, from, to, radius_m, header_);
    } catch (const occusg::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(
      problem(rooms_[0], 99, 0.2).find("has no room of id or number 99; its rooms are 1, 2, 3"),
      std::string::npos);
  EXPECT_NE(problem(rooms_[0], rooms_[2], 0.6).find("lets a radius of 0.4"), std::string::npos)
      << problem(rooms_[0], rooms_[2], 0.6);
  EXPECT_NE(problem(rooms_[0], rooms_[2], 1.5).find("has no free place"), std::string::npos);
  for (int y = 5; y < 15; ++y) layer_.cells.at({40, y}) = occusg::kUnknown;
  EXPECT_NE(problem(rooms_[0], rooms_[2], 0.2).find("no free space leads there"),
            std::string::npos);
}

}  // namespace
}  // namespace occusg_ros
