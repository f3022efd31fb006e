// SPDX-License-Identifier: BSD-3-Clause
#include "graph/room_history.hpp"

#include <gtest/gtest.h>

#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::rectangle;

class RoomHistoryTest : public ::testing::Test {
 protected:
  NodeId roomAt(double x, double stamp_s, RoomState state = RoomState::kConfirmed) {
    RoomAttributes room;
    room.polygon = rectangle(x, 0.0, x + 4.0, 4.0);
    room.state = state;
    const NodeId id = graph_.add({x, 0.0, 0.0}, stamp_s, room).id;
    history_.update(graph_);
    return id;
  }
  void lose(NodeId id, double stamp_s) {
    Node node = graph_.at(id);
    std::get<RoomAttributes>(node.attributes).unsupported_since_s = stamp_s;
    graph_.update(node);
    history_.update(graph_);
  }
  void remove(NodeId id) {
    graph_.remove(id);
    history_.update(graph_);
  }

  SceneGraph graph_;
  RoomHistory history_;
};

TEST_F(RoomHistoryTest, ARoomThatComesBackUnderAnotherIdIsASwitch) {
  remove(roomAt(0.0, 1.0));
  EXPECT_EQ(history_.idSwitches(), 0U);
  roomAt(10.0, 2.0);
  EXPECT_EQ(history_.idSwitches(), 0U);
  roomAt(0.3, 3.0);
  EXPECT_EQ(history_.idSwitches(), 1U);
}

TEST_F(RoomHistoryTest, SoIsOneThatIsReplacedBeforeItGoes) {
  const NodeId room = roomAt(0.0, 1.0);
  lose(room, 5.0);
  roomAt(0.0, 6.0);
  remove(room);
  EXPECT_EQ(history_.idSwitches(), 1U);
}

TEST_F(RoomHistoryTest, AMergeAPartialRoomAndSpaceThatIsGoneAreNone) {
  const NodeId merged = roomAt(0.0, 1.0);
  roomAt(0.0, 2.0);
  lose(merged, 5.0);
  remove(merged);
  remove(roomAt(10.0, 6.0, RoomState::kPartial));
  roomAt(10.0, 7.0);
  remove(roomAt(20.0, 8.0));
  EXPECT_EQ(history_.idSwitches(), 0U);
}

}  // namespace
}  // namespace occusg
