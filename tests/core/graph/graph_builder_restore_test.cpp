// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "occusg/graph/graph_builder.hpp"
#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::idsOf;
using testing::poseAt;
using testing::roomsOf;
using testing::squareAt;
using testing::tracked;

constexpr NodeType kTypes[] = {NodeType::kAgent, NodeType::kObject, NodeType::kNavigation,
                               NodeType::kRoom, NodeType::kDoor};

/// Two rooms of 4 m side by side, joined by an opening of 1 m, and a chair in each.
class TwoRooms {
 public:
  TwoRooms() {
    layer_.frame.resolution_m = 0.05;
    layer_.cells = FreeSpaceCells({{-4, -4}, {164, 84}}, kFullObstacle);
    paint({{1, 1}, {79, 79}}, kFree);
    paint({{81, 1}, {159, 79}}, kFree);
    paint({{79, 30}, {81, 50}}, kFree);
  }
  void paint(const CellBox& box, std::int8_t value) {
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x) layer_.cells.at({x, y}) = value;
  }
  [[nodiscard]] CellBox everything() const { return layer_.cells.box(); }

  void step(GraphBuilder& builder, double stamp_s, const CellBox& changed) const {
    std::vector<Detection> detections;
    for (const double x : {1.0, 6.0}) {
      Detection chair;
      chair.class_name = "chair";
      chair.score = 0.9;
      chair.centroid = {x, 1.0, 0.4};
      const Eigen::Vector3d half(0.25, 0.25, 0.4);
      chair.box = {Eigen::Vector3d(chair.centroid - half), Eigen::Vector3d(chair.centroid + half)};
      detections.push_back(chair);
    }
    builder.observeObjects(detections, stamp_s);
    MapView map;
    map.layer = &layer_;
    map.changed = changed;
    const auto regions =
        tracked({squareAt(1, 0.0), squareAt(2, 4.0)}, {}, {{1, 2, {{4.0, 1.5}, {4.0, 2.5}}}});
    builder.update(regions, poseAt(2.0, 2.0), stamp_s, map);
  }

  /// A builder after so many updates.
  [[nodiscard]] GraphBuilder driven(int updates = 20) const {
    GraphBuilder builder{GraphBuilderConfig{}};
    for (int i = 0; i < updates; ++i) step(builder, 0.5 * i, i == 0 ? everything() : CellBox{});
    return builder;
  }

 private:
  FreeSpace layer_;
};

TEST(GraphBuilderRestore, NothingIsDoubledByTheFirstUpdate) {
  const TwoRooms world;
  const GraphBuilder first = world.driven(20);
  const GraphBuilder whole = world.driven(30);
  for (const NodeType type : kTypes) ASSERT_FALSE(first.graph().nodes(type).empty());
  GraphBuilder second{GraphBuilderConfig{}};
  second.restore(first.state(), 9.5);
  for (int i = 20; i < 30; ++i)
    world.step(second, 0.5 * i, i == 20 ? world.everything() : CellBox{});
  for (const NodeType type : kTypes)
    EXPECT_EQ(idsOf(second.graph(), type), idsOf(whole.graph(), type)) << nameOf(type);
  for (const EdgeType type : {EdgeType::kTraversable, EdgeType::kContains,
                              EdgeType::kNearestFreeSpace, EdgeType::kRoomAdjacency})
    EXPECT_EQ(second.graph().edges(type).size(), whole.graph().edges(type).size()) << nameOf(type);
  for (const NodeId object : idsOf(second.graph(), NodeType::kObject))
    EXPECT_EQ(std::get<ObjectAttributes>(second.graph().at(object).attributes).observations, 30);
}

TEST(GraphBuilderRestore, FreeSpaceThatChangedMeanwhileIsFollowed) {
  TwoRooms world;
  const GraphBuilder first = world.driven();
  GraphBuilder second{GraphBuilderConfig{}};
  second.restore(first.state(), 9.5);
  world.paint({{81, 1}, {159, 79}}, kFullObstacle);
  world.step(second, 10.0, world.everything());
  for (const auto& [id, node] : second.graph().nodes(NodeType::kNavigation))
    EXPECT_LT(node.position.x(), 4.1) << "a node where nothing is free any more";
  EXPECT_LT(idsOf(second.graph(), NodeType::kNavigation).size(),
            idsOf(first.graph(), NodeType::kNavigation).size());
}

TEST(GraphBuilderRestore, LabelOfAPersonStays) {
  const TwoRooms world;
  GraphBuilder first = world.driven();
  const NodeId room = roomsOf(first.graph()).front();
  first.setRoomLabel(room, "den");
  GraphBuilder second{GraphBuilderConfig{}};
  second.restore(first.state(), 9.5);
  for (int i = 20; i < 30; ++i) world.step(second, 0.5 * i, world.everything());
  EXPECT_EQ(second.graph().room(room).label, "den");
  EXPECT_EQ(second.graph().room(room).label_source, LabelSource::kPerson);
}

TEST(GraphBuilderRestore, ConfirmedRoomStaysConfirmedWhenItsWallsAreForgotten) {
  TwoRooms world;
  const GraphBuilder first = world.driven();
  const NodeId room = roomsOf(first.graph()).front();
  ASSERT_EQ(first.graph().room(room).state, RoomState::kConfirmed);
  GraphBuilder second{GraphBuilderConfig{}};
  second.restore(first.state(), 9.5);
  world.paint({{-4, -4}, {164, 0}}, kUnknown);
  world.paint({{-4, -4}, {0, 84}}, kUnknown);
  world.paint({{-4, 80}, {164, 84}}, kUnknown);
  world.step(second, 10.0, world.everything());
  EXPECT_GT(second.graph().room(room).frontier_share, 0.5);
  EXPECT_EQ(second.graph().room(room).state, RoomState::kConfirmed);
}

TEST(GraphBuilderRestore, RoomsKeepTheirMembersUntilRegionsAreBack) {
  const TwoRooms world;
  const GraphBuilder first = world.driven();
  GraphBuilder second{GraphBuilderConfig{}};
  second.restore(first.state(), 9.5);
  second.update(tracked({}), poseAt(2.0, 2.0), 10.0);
  EXPECT_EQ(second.graph().edges(EdgeType::kContains).size(),
            first.graph().edges(EdgeType::kContains).size());
}

}  // namespace
}  // namespace occusg
