// SPDX-License-Identifier: BSD-3-Clause
#include "graph/room_layer.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "occusg/graph/graph_builder.hpp"
#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::paperGraph;
using testing::poseAt;
using testing::rectangle;
using testing::regionFrom;
using testing::roomOnRegion;
using testing::roomsOf;
using testing::squareAt;
using testing::stale;
using testing::tracked;

constexpr double kOutsideM = -50.0;

/// Feeds a builder one update a second, from stamp 0; maintenance is due at 2, 4, 6...
class Rooms {
 public:
  explicit Rooms(const GraphBuilderConfig& config) : builder_(config) {}

  void step(const TrackedRegions& regions, double x, double y = 2.0) {
    builder_.update(regions, poseAt(x, y), stamp_s_);
    stamp_s_ += 1.0;
  }
  void steps(int count, const TrackedRegions& regions, double x, double y = 2.0) {
    for (int i = 0; i < count; ++i) step(regions, x, y);
  }
  void finish() { builder_.finish(stamp_s_ - 1.0); }
  NodeId objectAt(double x, double y) {
    return builder_.mutableGraph().add({x, y, 0.5}, stamp_s_, ObjectAttributes{"chair", 0.9}).id;
  }

  [[nodiscard]] const SceneGraph& graph() const { return builder_.graph(); }
  [[nodiscard]] std::optional<NodeId> current() const { return builder_.currentRoom(); }
  [[nodiscard]] std::vector<NodeId> ids() const { return roomsOf(graph()); }
  [[nodiscard]] NodeId on(int region) const { return roomOnRegion(graph(), region); }

 private:
  GraphBuilder builder_;
  double stamp_s_ = 0.0;
};

constexpr NodeId kFirst = firstId(NodeType::kRoom);

TEST(RoomLayer, TheFirstRoomIsTheRegionOfTheFirstPose) {
  Rooms rooms(paperGraph());
  const Region l_shape = regionFrom(5, {{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}}, {}});
  rooms.objectAt(1.0, 5.0);
  rooms.steps(5, tracked({l_shape, squareAt(6, 20.0)}), kOutsideM);
  EXPECT_TRUE(rooms.ids().empty());
  EXPECT_FALSE(rooms.current());

  rooms.step(tracked({l_shape, squareAt(6, 20.0)}), 1.0, 1.0);
  ASSERT_EQ(rooms.ids(), std::vector<NodeId>{kFirst});
  const RoomAttributes& room = rooms.graph().room(kFirst);
  EXPECT_EQ(room.polygon.outer, l_shape.polygon.outer);
  EXPECT_TRUE(room.polygon.holes.empty());
  EXPECT_EQ(room.region_id, 5);
  EXPECT_TRUE(room.isBootstrap());
  EXPECT_EQ(room.name, "room_1");
  EXPECT_EQ(room.label, "unknown");
  EXPECT_DOUBLE_EQ(room.area_m2, 20.0);
  EXPECT_EQ(rooms.current(), kFirst);
  EXPECT_EQ(rooms.graph().at(kFirst).created_s, 5.0);
}

TEST(RoomLayer, EnteringAnUnownedRegionAnchorsARoomAndComingBackRefreshesIt) {
  Rooms rooms(paperGraph());
  rooms.step(tracked({squareAt(1, 0.0), squareAt(2, 4.0)}), 2.0);
  rooms.step(tracked({squareAt(1, 0.0), squareAt(2, 4.0)}), 6.0);
  ASSERT_EQ(rooms.ids().size(), 2U);
  EXPECT_EQ(rooms.graph().room(rooms.on(2)).reason, RoomReason::kVisited);
  EXPECT_EQ(rooms.current(), rooms.on(2));

  // Stamp 2 maintains; the footprint grows at stamp 3, when only the robot can refresh it.
  rooms.step(tracked({squareAt(1, 0.0), squareAt(2, 4.0)}), 6.0);
  const Region grown = regionFrom(1, rectangle(-1.0, 0.0, 4.0, 4.0));
  rooms.step(tracked({grown, squareAt(2, 4.0)}), 2.0);
  EXPECT_EQ(rooms.current(), kFirst);
  EXPECT_EQ(rooms.ids().size(), 2U);
  EXPECT_EQ(rooms.graph().room(kFirst).polygon.outer, grown.polygon.outer);
  EXPECT_DOUBLE_EQ(rooms.graph().room(kFirst).area_m2, 20.0);
  EXPECT_EQ(rooms.graph().at(kFirst).last_seen_s, 3.0);
}

TEST(RoomLayer, MaintenanceRefreshesTheRoomsTheRobotIsNotIn) {
  Rooms rooms(paperGraph());
  rooms.step(tracked({squareAt(1, 0.0), squareAt(2, 4.0)}), 2.0);
  const auto grown = tracked({regionFrom(1, rectangle(-1.0, 0.0, 4.0, 4.0)), squareAt(2, 4.0)});
  rooms.step(grown, 6.0);
  EXPECT_DOUBLE_EQ(rooms.graph().room(kFirst).area_m2, 16.0);
  rooms.step(grown, 6.0);
  EXPECT_DOUBLE_EQ(rooms.graph().room(kFirst).area_m2, 20.0);
}

TEST(RoomLayer, MaintenancePromotesTheRegionThatHoldsAnObjectAndNoOther) {
  Rooms rooms(paperGraph());
  const auto regions = tracked({squareAt(1, 0.0), squareAt(2, 10.0), squareAt(3, 20.0)});
  rooms.step(regions, 2.0);
  const NodeId object = rooms.objectAt(12.0, 2.0);
  rooms.step(regions, 2.0);
  EXPECT_EQ(rooms.ids().size(), 1U) << "maintenance is not due yet";
  rooms.step(regions, 2.0);
  ASSERT_EQ(rooms.ids().size(), 2U);
  const NodeId promoted = rooms.on(2);
  EXPECT_EQ(rooms.graph().room(promoted).reason, RoomReason::kPromoted);
  EXPECT_EQ(rooms.graph().roomOf(object), promoted);
  EXPECT_EQ(rooms.current(), kFirst);
  rooms.steps(10, regions, 2.0);
  EXPECT_EQ(rooms.on(3), -1);
}

TEST(RoomLayer, ByDefaultARegionSeenLongEnoughIsPromotedWithoutEntities) {
  Rooms rooms{GraphBuilderConfig{}};
  const auto regions = tracked({squareAt(1, 0.0), squareAt(2, 10.0), squareAt(3, 20.0, 0.9)});
  rooms.objectAt(20.5, 0.5);
  rooms.steps(4, regions, 2.0);
  EXPECT_EQ(rooms.ids().size(), 1U);
  rooms.step(regions, 2.0);
  EXPECT_NE(rooms.on(2), -1) << "4 s old at the maintenance of stamp 4";
  rooms.steps(10, regions, 2.0);
  EXPECT_EQ(rooms.on(3), -1) << "0.81 m2 are too little";
}

TEST(RoomLayer, FinishPromotesARegionThatIsStillYoung) {
  Rooms rooms{GraphBuilderConfig{}};
  rooms.step(tracked({squareAt(1, 0.0), squareAt(2, 10.0), squareAt(3, 20.0, 0.9)}), 2.0);
  rooms.finish();
  EXPECT_EQ(rooms.ids().size(), 2U);
  EXPECT_NE(rooms.on(2), -1);
}

TEST(RoomLayer, FinishMakesRoomsEvenIfNoRegionEverHeldTheRobot) {
  Rooms by_area{GraphBuilderConfig{}};
  by_area.steps(10, tracked({squareAt(1, 0.0)}), kOutsideM);
  EXPECT_TRUE(by_area.ids().empty());
  by_area.finish();
  EXPECT_EQ(by_area.ids().size(), 1U);

  Rooms by_entity(paperGraph());
  by_entity.objectAt(1.0, 1.0);
  by_entity.steps(10, tracked({squareAt(1, 0.0)}), kOutsideM);
  by_entity.finish();
  EXPECT_TRUE(by_entity.ids().empty());
}

TEST(RoomLayer, ARoomMovesToTheRegionThatReplacesItsOwn) {
  Rooms rooms(paperGraph());
  const auto before = tracked({regionFrom(1, rectangle(0, 0, 10, 4)), squareAt(2, 20.0)});
  rooms.step(before, 5.0);
  const NodeId object = rooms.objectAt(3.0, 1.0);
  rooms.steps(2, before, 22.0);
  const NodeId second = rooms.on(2);

  const Region successor = regionFrom(7, rectangle(0, 0, 8, 4));
  rooms.steps(2, tracked({squareAt(2, 20.0), successor}), 22.0);
  EXPECT_EQ(rooms.ids(), (std::vector<NodeId>{kFirst, second}));
  EXPECT_EQ(rooms.on(7), kFirst);
  EXPECT_EQ(rooms.graph().room(kFirst).name, "room_1");
  EXPECT_EQ(rooms.graph().room(kFirst).polygon.outer, successor.polygon.outer);
  EXPECT_FALSE(rooms.graph().room(kFirst).unsupported_since_s);
  EXPECT_EQ(rooms.graph().roomOf(object), kFirst);
}

TEST(RoomLayer, TheCurrentRoomKeepsItsIdWhenItsRegionIsReplaced) {
  Rooms rooms(paperGraph());
  rooms.steps(2, tracked({squareAt(1, 0.0)}), 2.0);
  // Between two maintenances: the robot must not anchor a new room before succession is decided.
  rooms.step(tracked({regionFrom(9, rectangle(0.0, 0.0, 4.0, 3.5))}, {1}), 2.0);
  EXPECT_EQ(rooms.ids(), std::vector<NodeId>{kFirst});
  EXPECT_EQ(rooms.current(), kFirst);
  EXPECT_EQ(rooms.on(9), kFirst);
}

TEST(RoomLayer, AMergeThatLastsOneUpdateCostsNoRoomItsId) {
  Rooms rooms(paperGraph());
  const auto apart = tracked({squareAt(1, 0.0), squareAt(2, 4.0)});
  rooms.step(apart, 2.0);
  rooms.steps(2, apart, 6.0);
  const NodeId second = rooms.on(2);
  rooms.step(tracked({regionFrom(3, rectangle(0, 0, 8, 4))}, {1, 2}), 6.0);
  EXPECT_EQ(rooms.ids(), (std::vector<NodeId>{kFirst, second}));
  rooms.steps(3, apart, 6.0);
  EXPECT_EQ(rooms.ids(), (std::vector<NodeId>{kFirst, second}));
  EXPECT_EQ(rooms.on(1), kFirst);
  EXPECT_EQ(rooms.on(2), second);
  EXPECT_EQ(rooms.current(), second);
}

class RoomRemoval : public ::testing::Test {
 protected:
  /// Two rooms with an object each, adjacent to one another; the robot in the first.
  static void prepare(Rooms& rooms) {
    rooms.step(tracked({squareAt(1, 0.0), squareAt(2, 4.0)}), 6.0);
    rooms.objectAt(6.0, 2.0);
    const Crossing door{1, 2, {{4.0, 1.5}, {4.0, 2.5}}};
    rooms.steps(2, tracked({squareAt(1, 0.0), squareAt(2, 4.0)}, {}, {door}), 2.0);
    ASSERT_EQ(rooms.ids().size(), 2U);
    ASSERT_EQ(rooms.graph().edges(EdgeType::kRoomAdjacency).size(), 1U);
  }
  static TrackedRegions secondMissed() { return tracked({squareAt(1, 0.0)}, {2}); }
  static TrackedRegions secondGone() { return tracked({squareAt(1, 0.0)}); }
};

TEST_F(RoomRemoval, RoomSurvivesThreeMissedUpdates) {
  for (const GraphBuilderConfig& config : {paperGraph(), GraphBuilderConfig{}}) {
    Rooms rooms(config);
    prepare(rooms);
    const NodeId second = rooms.on(2);
    const auto members = rooms.graph().targets(EdgeType::kContains, second);
    ASSERT_FALSE(members.empty());
    for (int missed = 1; missed <= 3; ++missed) {
      rooms.steps(2, secondMissed(), 2.0);  // A maintenance each.
      ASSERT_EQ(rooms.on(2), second) << missed;
      EXPECT_TRUE(rooms.graph().room(second).unsupported_since_s);
      EXPECT_EQ(rooms.graph().targets(EdgeType::kContains, second), members);
      EXPECT_EQ(rooms.graph().edges(EdgeType::kRoomAdjacency).size(), 1U);
    }
    rooms.steps(2, tracked({squareAt(1, 0.0), squareAt(2, 4.0)}), 2.0);
    EXPECT_EQ(rooms.on(2), second);
    EXPECT_FALSE(rooms.graph().room(second).unsupported_since_s);
    EXPECT_EQ(rooms.graph().targets(EdgeType::kContains, second), members);
  }
}

TEST_F(RoomRemoval, RoomGoesWithItsEdgesWhenItsTrackDoes) {
  Rooms rooms(paperGraph());
  prepare(rooms);
  const NodeId second = rooms.on(2);
  rooms.steps(6, secondMissed(), 2.0);
  rooms.steps(2, secondGone(), 2.0);
  EXPECT_EQ(rooms.ids().size(), 1U);
  EXPECT_EQ(rooms.graph().find(second), nullptr);
  EXPECT_TRUE(rooms.graph().edges(EdgeType::kRoomAdjacency).empty());
  for (const auto& [ends, edge] : rooms.graph().edges(EdgeType::kContains))
    EXPECT_NE(ends.first, second);
}

TEST_F(RoomRemoval, ByDefaultARoomOutlivesItsTrackByTheGrace) {
  Rooms rooms{GraphBuilderConfig{}};
  prepare(rooms);
  const NodeId second = rooms.on(2);
  rooms.steps(4, secondMissed(), 2.0);  // Missing since stamp 3, gone at 7.
  rooms.steps(6, secondGone(), 2.0);    // Last maintenance at stamp 12.
  EXPECT_EQ(rooms.on(2), second);
  rooms.steps(2, secondGone(), 2.0);  // Maintenance at stamp 14.
  EXPECT_EQ(rooms.on(2), -1);
}

TEST_F(RoomRemoval, DuringTheGraceASuccessorRevivesTheRoom) {
  Rooms rooms{GraphBuilderConfig{}};
  prepare(rooms);
  const NodeId second = rooms.on(2);
  rooms.steps(6, secondGone(), 2.0);
  rooms.step(tracked({squareAt(1, 0.0), squareAt(8, 4.1)}), 2.0);
  EXPECT_EQ(rooms.on(8), second);
  EXPECT_FALSE(rooms.graph().room(second).unsupported_since_s);
}

TEST_F(RoomRemoval, FinishDoesNotWaitForTheGrace) {
  Rooms rooms{GraphBuilderConfig{}};
  prepare(rooms);
  rooms.step(secondGone(), 2.0);
  ASSERT_NE(rooms.on(2), -1);
  rooms.finish();
  EXPECT_EQ(rooms.on(2), -1);
  EXPECT_NE(rooms.on(1), -1);
}

TEST_F(RoomRemoval, StaleAndEmptyUpdatesChangeNoRoom) {
  for (const auto& invalid : {stale(tracked({squareAt(5, 0.0)})), tracked({})}) {
    Rooms rooms(paperGraph());
    prepare(rooms);
    const auto ids = rooms.ids();
    rooms.objectAt(1.0, 1.0);
    rooms.steps(8, invalid, 2.0);
    EXPECT_EQ(rooms.ids(), ids);
    EXPECT_EQ(rooms.graph().room(kFirst).region_id, 2);
    EXPECT_FALSE(rooms.graph().room(kFirst).unsupported_since_s);
    rooms.finish();
    EXPECT_EQ(rooms.ids(), ids);
  }
}

TEST_F(RoomRemoval, WhileStaleTheRobotStillChangesRooms) {
  Rooms rooms(paperGraph());
  prepare(rooms);
  const auto last = tracked({squareAt(1, 0.0), squareAt(2, 4.0)});
  rooms.step(stale(last), 6.0);
  EXPECT_EQ(rooms.current(), rooms.on(2));
  rooms.step(stale(last), kOutsideM);
  EXPECT_FALSE(rooms.current());
}

TEST_F(RoomRemoval, ARegionWithoutAreaIsAMissedOne) {
  Rooms rooms(paperGraph());
  prepare(rooms);
  const NodeId second = rooms.on(2);
  Region empty;
  empty.id = 2;
  rooms.steps(6, tracked({squareAt(1, 0.0), empty}), 2.0);
  EXPECT_EQ(rooms.on(2), second);
  EXPECT_GT(rooms.graph().room(second).area_m2, 0.0);
}

TEST(RoomLayer, NamesAreNeverUsedAgain) {
  Rooms rooms(paperGraph());
  rooms.steps(3, tracked({squareAt(1, 0.0)}), 2.0);
  rooms.steps(4, tracked({squareAt(2, 50.0)}), 52.0);
  ASSERT_EQ(rooms.ids().size(), 1U);
  EXPECT_EQ(rooms.graph().room(rooms.on(2)).name, "room_2");
}

TEST(RoomLayer, RoomsStandOnTheFloor) {
  GraphBuilderConfig config;
  config.rooms.floor_z_m = -0.3;
  Rooms rooms(config);
  rooms.step(tracked({squareAt(1, 0.0)}), 2.0);
  EXPECT_EQ(rooms.graph().at(kFirst).position, Eigen::Vector3d(2.0, 2.0, -0.3));
}

TEST(RoomLayer, AnEntityIsContainedInOneRoomUpToHalfAMetreAway) {
  Rooms rooms(paperGraph());
  const NodeId near = rooms.objectAt(4.49, 2.0);
  const NodeId far = rooms.objectAt(4.51, 2.0);
  rooms.steps(2, tracked({squareAt(1, 0.0)}), 2.0);
  EXPECT_EQ(rooms.graph().roomOf(near), kFirst);
  EXPECT_FALSE(rooms.graph().roomOf(far));

  // Room 2 opens right beside it: the object is inside now, and leaves the first room.
  rooms.steps(3, tracked({squareAt(1, 0.0), squareAt(2, 4.0)}), 2.0);
  EXPECT_EQ(rooms.graph().roomOf(near), rooms.on(2));
  EXPECT_EQ(rooms.graph().sources(EdgeType::kContains, near).size(), 1U);
}

TEST(RoomLayer, AMemberThatLeavesEveryRegionLeavesItsRoom) {
  Rooms rooms(paperGraph());
  const NodeId object = rooms.objectAt(3.0, 3.0);
  rooms.step(tracked({squareAt(1, 0.0)}), 1.0, 1.0);
  ASSERT_EQ(rooms.graph().roomOf(object), kFirst);
  rooms.step(tracked({squareAt(1, 0.0, 2.0)}), 1.0, 1.0);
  EXPECT_FALSE(rooms.graph().roomOf(object));
}

}  // namespace
}  // namespace occusg
