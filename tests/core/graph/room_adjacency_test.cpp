// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <vector>

#include "graph/room_layer.hpp"
#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::paperGraph;
using testing::roomOnRegion;
using testing::squareAt;
using testing::tracked;

/// Three rooms in a row, each 4 m square, anchored to the regions 1, 2 and 3.
class RoomAdjacency : public ::testing::Test {
 protected:
  void SetUp() override {
    maintain({});
    for (const double x : {2.0, 6.0, 10.0}) objectAt(x);
    maintain({});
    ASSERT_EQ(graph_.nodes(NodeType::kRoom).size(), 3U);
  }
  void objectAt(double x) { graph_.add({x, 2.0, 0.0}, 0.0, ObjectAttributes{}); }
  NodeId blockAt(double x) { return graph_.add({x, 2.0, 0.0}, 0.0, NavigationAttributes{}).id; }
  void maintain(std::vector<Crossing> crossings) {
    const auto regions =
        tracked({squareAt(1, 0.0), squareAt(2, 4.0), squareAt(3, 8.0)}, {}, std::move(crossings));
    layer_.update(graph_, regions, Point2{2.0, 2.0}, stamp_s_, Maintenance::kDue);
    stamp_s_ += 1.0;
  }
  [[nodiscard]] const Edge* edge(int a, int b) const {
    return graph_.findEdge(EdgeType::kRoomAdjacency, roomOnRegion(graph_, a),
                           roomOnRegion(graph_, b));
  }
  [[nodiscard]] std::size_t edgeCount() const {
    return graph_.edges(EdgeType::kRoomAdjacency).size();
  }

  SceneGraph graph_;
  RoomLayer layer_{paperGraph().rooms};
  double stamp_s_ = 0.0;
  const Crossing door12_{1, 2, {{4.0, 1.5}, {4.0, 2.5}}};
  const Crossing wide12_{1, 2, {{4.0, 2.8}, {4.0, 4.0}}};
};

TEST_F(RoomAdjacency, CrossingAndTraversableEdgeMakeOneUndirectedEdge) {
  const NodeId left = blockAt(3.5);
  const NodeId right = blockAt(4.5);
  graph_.connect({EdgeType::kTraversable, right, left, {}});
  maintain({door12_});
  EXPECT_EQ(edgeCount(), 1U);
  ASSERT_NE(edge(1, 2), nullptr);
  EXPECT_EQ(edge(2, 1), edge(1, 2));
}

TEST_F(RoomAdjacency, CrossingBehindAWallIsNoPassage) {
  blockAt(3.5);
  blockAt(4.5);
  maintain({door12_});
  EXPECT_EQ(edgeCount(), 0U);
}

TEST_F(RoomAdjacency, TraversableEdgeWithoutACrossingIsNoAdjacency) {
  graph_.connect({EdgeType::kTraversable, blockAt(3.5), blockAt(4.5), {}});
  maintain({});
  EXPECT_EQ(edgeCount(), 0U);
}

TEST_F(RoomAdjacency, ATraversableEdgeElsewhereDoesNotCount) {
  graph_.connect({EdgeType::kTraversable, blockAt(7.5), blockAt(8.5), {}});
  graph_.connect({EdgeType::kTraversable, blockAt(1.5), blockAt(2.5), {}});
  graph_.connect({EdgeType::kTraversable, blockAt(3.5), blockAt(60.0), {}});
  maintain({door12_});
  EXPECT_EQ(edgeCount(), 0U);
}

TEST_F(RoomAdjacency, WithoutNavigationNodesTheCrossingIsTheEvidence) {
  maintain({door12_});
  EXPECT_EQ(edgeCount(), 1U);
  EXPECT_NE(edge(1, 2), nullptr);
}

TEST_F(RoomAdjacency, AllCrossingsOfAPairAreKeptTheWidestFirst) {
  maintain({door12_, wide12_});
  ASSERT_NE(edge(1, 2), nullptr);
  ASSERT_EQ(edge(1, 2)->crossings.size(), 2U);
  EXPECT_EQ(edge(1, 2)->crossings[0].a, wide12_.segment.a);
  EXPECT_EQ(edge(1, 2)->crossings[1].a, door12_.segment.a);
}

TEST_F(RoomAdjacency, AnEdgeGoesWithItsCrossing) {
  maintain({door12_, {2, 3, {{8.0, 1.0}, {8.0, 2.0}}}});
  EXPECT_EQ(edgeCount(), 2U);
  maintain({{2, 3, {{8.0, 1.0}, {8.0, 2.0}}}});
  EXPECT_EQ(edgeCount(), 1U);
  EXPECT_EQ(edge(1, 2), nullptr);
}

TEST_F(RoomAdjacency, ACrossingToARegionWithoutARoomIsNoAdjacency) {
  const auto regions =
      tracked({squareAt(1, 0.0), squareAt(2, 4.0), squareAt(3, 8.0), squareAt(4, 12.0)}, {},
              {{3, 4, {{12.0, 1.0}, {12.0, 2.0}}}, {3, 99, {{12.0, 1.0}, {12.0, 2.0}}}});
  layer_.update(graph_, regions, Point2{2.0, 2.0}, stamp_s_, Maintenance::kDue);
  EXPECT_EQ(edgeCount(), 0U);
}

TEST_F(RoomAdjacency, EachCrossingOfAdjacentRoomsIsADoor) {
  maintain({door12_, wide12_});
  ASSERT_EQ(graph_.nodes(NodeType::kDoor).size(), 2U);
  const Node& wide = graph_.nodes(NodeType::kDoor).begin()->second;
  const auto& door = std::get<DoorAttributes>(wide.attributes);
  EXPECT_NEAR(door.width_m, 1.2, 1e-12);
  EXPECT_EQ(door.room_a, roomOnRegion(graph_, 1));
  EXPECT_EQ(door.room_b, roomOnRegion(graph_, 2));
  EXPECT_EQ(wide.groundPosition(), midpoint(wide12_.segment));
  maintain({wide12_});
  EXPECT_EQ(graph_.nodes(NodeType::kDoor).size(), 1U);
  maintain({});
  EXPECT_TRUE(graph_.nodes(NodeType::kDoor).empty());
}

TEST_F(RoomAdjacency, ADoorKeepsItsIdWhileItsCrossingStaysInPlace) {
  maintain({door12_});
  const NodeId door = graph_.nodes(NodeType::kDoor).begin()->first;
  maintain({{1, 2, {{4.0, 1.6}, {4.1, 2.6}}}});
  ASSERT_NE(graph_.find(door), nullptr);
  EXPECT_NEAR(graph_.at(door).position.y(), 2.1, 1e-12);
  maintain({{1, 2, {{4.0, 3.0}, {4.0, 4.0}}}});
  EXPECT_EQ(graph_.find(door), nullptr) << "a metre away it is another";
  EXPECT_EQ(graph_.nodes(NodeType::kDoor).size(), 1U);
}

TEST_F(RoomAdjacency, DoorsGoWithARoom) {
  maintain({door12_});
  const auto without_second =
      tracked({squareAt(1, 0.0), squareAt(3, 8.0)}, {}, std::vector<Crossing>{});
  for (int i = 0; i < 3; ++i) {
    layer_.update(graph_, without_second, Point2{2.0, 2.0}, stamp_s_, Maintenance::kDue);
    stamp_s_ += 1.0;
  }
  EXPECT_EQ(edgeCount(), 0U);
  EXPECT_TRUE(graph_.nodes(NodeType::kDoor).empty());
}

TEST_F(RoomAdjacency, AnEdgeIsDroppedWhenItsTraversableEdgeGoes) {
  const NodeId left = blockAt(3.5);
  const NodeId right = blockAt(4.5);
  graph_.connect({EdgeType::kTraversable, left, right, {}});
  maintain({door12_});
  ASSERT_EQ(edgeCount(), 1U);
  const Revision before = graph_.revision();
  maintain({door12_});
  const GraphChanges changes = graph_.changesSince(before);
  EXPECT_TRUE(changes.changed_edges.empty()) << "nothing changed, nothing is touched";
  graph_.disconnect(EdgeType::kTraversable, left, right);
  maintain({door12_});
  EXPECT_EQ(edgeCount(), 0U);
  graph_.connect({EdgeType::kTraversable, left, right, {}});
  maintain({door12_});
  EXPECT_EQ(edgeCount(), 1U);
  graph_.remove(left);
  maintain({door12_});
  EXPECT_EQ(edgeCount(), 0U);
}

}  // namespace
}  // namespace occusg
