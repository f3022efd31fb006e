// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/room_path.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

using occusg::EdgeType;
using occusg::NodeId;

// Rooms of 2 x 2 m in a row along x, navigation nodes at their middles and at the doors between.
class RoomPathTest : public ::testing::Test {
 protected:
  RoomPathTest() {
    for (int i = 0; i < 3; ++i) addRoom(i);
    for (int i = 0; i < 2; ++i) addDoor(i);
    for (std::size_t i = 0; i + 1 < navigation_.size(); ++i)
      graph_.connect({EdgeType::kTraversable, navigation_[i], navigation_[i + 1], {}});
    header_.frame_id = "map";
  }

  void addRoom(int i) {
    occusg::RoomAttributes room;
    room.name = "room_" + std::to_string(i);
    const double x = 2.0 * i;
    room.polygon = {{{x, 0.0}, {x + 2.0, 0.0}, {x + 2.0, 2.0}, {x, 2.0}}, {}};
    room.area_m2 = 4.0;
    rooms_.push_back(graph_.add({x + 1.0, 1.0, 0.0}, 1.0, room).id);
    for (const double step : {0.5, 1.0, 1.5}) {
      navigation_.push_back(
          graph_.add({x + step, 1.0, 0.0}, 1.0, occusg::NavigationAttributes{}).id);
      graph_.connect({EdgeType::kContains, rooms_.back(), navigation_.back(), {}});
    }
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
  std::vector<NodeId> navigation_;
  std_msgs::Header header_;
};

TEST_F(RoomPathTest, LeadsThroughFreeSpaceAndTheDoorsInOrder) {
  const RoomPath way = pathBetween(graph_, rooms_[0], rooms_[2], header_);
  EXPECT_EQ(way.rooms, (std::vector<std::int64_t>{rooms_[0], rooms_[1], rooms_[2]}));
  ASSERT_EQ(way.doors.size(), 2U);
  EXPECT_DOUBLE_EQ(way.doors[0].ends[0].x, 2.0);
  EXPECT_DOUBLE_EQ(way.doors[1].ends[0].x, 4.0);
  EXPECT_NEAR(way.length_m, 4.0, 1e-9);
  ASSERT_EQ(way.path.poses.size(), 9U) << "both rooms and the seven navigation nodes between";
  EXPECT_EQ(way.path.poses.front().header.frame_id, "map");
  EXPECT_DOUBLE_EQ(way.path.poses.back().pose.position.x, 5.0);
}

TEST_F(RoomPathTest, FromARoomToItselfIsThatRoom) {
  const RoomPath way = pathBetween(graph_, rooms_[1], rooms_[1], header_);
  EXPECT_EQ(way.rooms, std::vector<std::int64_t>{rooms_[1]});
  EXPECT_TRUE(way.doors.empty());
}

TEST_F(RoomPathTest, SaysWhenThereIsNoRoomOrNoWay) {
  EXPECT_THROW((void)pathBetween(graph_, rooms_[0], 1, header_), occusg::Error);
  EXPECT_THROW((void)pathBetween(graph_, navigation_[0], rooms_[0], header_), occusg::Error);
  graph_.disconnect(EdgeType::kTraversable, navigation_[5], navigation_[6]);
  EXPECT_THROW((void)pathBetween(graph_, rooms_[0], rooms_[2], header_), occusg::Error);
}

}  // namespace
}  // namespace occusg_ros
