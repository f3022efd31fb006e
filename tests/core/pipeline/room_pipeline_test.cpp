// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/room_pipeline.hpp"

#include <gtest/gtest.h>

namespace occusg {
namespace {

// Two rooms of 2 x 4 m joined by a door 1 m wide, as a laser map shows them.
FreeSpace twoRooms() {
  FreeSpace layer;
  layer.frame.resolution_m = 0.05;
  layer.cells = FreeSpaceCells(CellBox{{0, 0}, {82, 80}}, kFree);
  for (int y = 0; y < 80; ++y) {
    const bool is_door = y >= 30 && y < 50;
    for (int x = 40; x < 42 && !is_door; ++x) layer.cells.at({x, y}) = kFullObstacle;
  }
  layer.changed = layer.cells.box();
  return layer;
}

Pose standingAt(double x, double y) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x, y, 0.0);
  return pose;
}

TEST(RoomPipeline, FinishedMapIsEnoughForRooms) {
  RoomPipeline pipeline{PipelineConfig{}};
  const FreeSpace layer = twoRooms();
  pipeline.update(layer, layer.changed, standingAt(1.0, 2.0), 0.0);
  pipeline.finish(0.0);
  EXPECT_EQ(pipeline.graph().nodes(NodeType::kRoom).size(), 2U);
  EXPECT_EQ(pipeline.graph().edges(EdgeType::kRoomAdjacency).size(), 1U);
}

TEST(RoomPipeline, MaintenanceFollowsTheRobotAndPromotesWhileTheMapStays) {
  RoomPipeline pipeline{PipelineConfig{}};
  pipeline.maintain(standingAt(1.0, 2.0), 0.0);
  EXPECT_FALSE(pipeline.currentRoom());

  const FreeSpace layer = twoRooms();
  pipeline.update(layer, layer.changed, standingAt(1.0, 2.0), 0.0);
  ASSERT_EQ(pipeline.graph().nodes(NodeType::kRoom).size(), 1U);
  const auto first = pipeline.currentRoom();

  for (double stamp_s = 2.0; stamp_s <= 6.0; stamp_s += 2.0)
    pipeline.maintain(standingAt(1.0, 2.0), stamp_s);
  EXPECT_EQ(pipeline.graph().nodes(NodeType::kRoom).size(), 2U) << "the other one is old enough";

  pipeline.maintain(standingAt(3.0, 2.0), 8.0);
  ASSERT_TRUE(pipeline.currentRoom());
  EXPECT_NE(pipeline.currentRoom(), first);
  EXPECT_EQ(pipeline.counts().region_updates, 1U);
}

}  // namespace
}  // namespace occusg
