// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/graph_query.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "graph/room_completeness.hpp"
#include "graph/room_labels.hpp"
#include "occusg/error.hpp"
#include "occusg/printable.hpp"
#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::rectangle;

/// Three rooms of 4 m in a row, doors at x = 4 and x = 8, a navigation node every metre at y = 2.
class Flat : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 3; ++i) rooms_.push_back(roomFrom(4.0 * i));
    for (int i = 0; i < 2; ++i) doors_.push_back(doorBetween(i));
    for (int i = 0; i < 12; ++i) {
      nodes_.push_back(graph_.add({i + 0.5, 2.0, 0.0}, 0.0, NavigationAttributes{}).id);
      graph_.connect(
          {EdgeType::kContains, rooms_[static_cast<std::size_t>(i / 4)], nodes_.back(), {}});
      if (i > 0) graph_.connect({EdgeType::kTraversable, *(nodes_.end() - 2), nodes_.back(), {}});
    }
  }
  NodeId roomFrom(double x) {
    RoomAttributes room;
    room.polygon = rectangle(x, 0.0, x + 4.0, 4.0);
    room.area_m2 = 16.0;
    return graph_.add({x + 2.0, 2.0, 0.0}, 0.0, room).id;
  }
  NodeId doorBetween(int i) {
    const NodeId a = rooms_[static_cast<std::size_t>(i)];
    const NodeId b = rooms_[static_cast<std::size_t>(i) + 1];
    const Segment2 segment{{4.0 * (i + 1), 1.5}, {4.0 * (i + 1), 2.5}};
    graph_.connect({EdgeType::kRoomAdjacency, a, b, {segment}});
    return graph_.add({4.0 * (i + 1), 2.0, 0.0}, 0.0, DoorAttributes{segment, 1.0, a, b}).id;
  }
  NodeId objectAt(const std::string& name, double x, int room) {
    const NodeId id = graph_.add({x, 1.0, 0.0}, 0.0, ObjectAttributes{name, 0.9}).id;
    graph_.connect({EdgeType::kContains, rooms_[static_cast<std::size_t>(room)], id, {}});
    return id;
  }

  SceneGraph graph_;
  std::vector<NodeId> rooms_;
  std::vector<NodeId> doors_;
  std::vector<NodeId> nodes_;
};

TEST_F(Flat, RoomsOfUsualSizeGiveNoDoubt) { EXPECT_EQ(doubtOnLargestRoom(graph_), ""); }

TEST_F(Flat, RoomLargerThanAnyOfAFlatIsNamedWithItsArea) {
  RoomAttributes hall;
  hall.name = "room_7";
  hall.area_m2 = 183.2;
  graph_.add({50.0, 50.0, 0.0}, 0.0, hall);
  EXPECT_EQ(doubtOnLargestRoom(graph_),
            "room_7 has 183 m2, more than any room of a flat: if the building has no such hall, "
            "check the unit of the depth images or the resolution of the map");
}

TEST_F(Flat, RoomAtAPointIsTheOneThatHoldsIt) {
  EXPECT_EQ(roomAt(graph_, {1.0, 1.0}), rooms_[0]);
  EXPECT_EQ(roomAt(graph_, {9.0, 1.0}), rooms_[2]);
  EXPECT_EQ(roomAt(graph_, {4.0, 1.0}), rooms_[0]) << "on a common wall: the older";
  EXPECT_EQ(roomAt(graph_, {-0.3, 1.0}), std::nullopt);
  EXPECT_EQ(roomAt(graph_, {-0.3, 1.0}, 0.5), rooms_[0]);
  EXPECT_EQ(roomAt(graph_, {std::numeric_limits<double>::quiet_NaN(), 1.0}, 0.5), std::nullopt);
  RoomAttributes closet;
  closet.polygon = rectangle(1.0, 1.0, 2.0, 2.0);
  closet.area_m2 = 1.0;
  const NodeId inner = graph_.add({1.5, 1.5, 0.0}, 0.0, closet).id;
  EXPECT_EQ(roomAt(graph_, {1.5, 1.5}), inner) << "the innermost";
}

TEST_F(Flat, TheShortestRouteTellsRoomsDoorsAndLength) {
  const auto route = shortestRoute(graph_, {0.5, 1.0}, {11.5, 2.5});
  ASSERT_TRUE(route);
  EXPECT_EQ(route->nodes, nodes_);
  EXPECT_EQ(route->rooms, rooms_);
  EXPECT_EQ(route->doors, doors_);
  EXPECT_NEAR(route->length_m, 1.0 + 11.0 + 0.5, 1e-9);
  const auto back = shortestRoute(graph_, {6.0, 2.0}, {2.4, 2.0});
  ASSERT_TRUE(back);
  EXPECT_EQ(back->rooms, (std::vector<NodeId>{rooms_[1], rooms_[0]}));
  EXPECT_EQ(back->doors, std::vector<NodeId>{doors_[0]});
}

TEST_F(Flat, RouteBetweenPlacesBesideOneNodeIsAsLongAsTheyAreApart) {
  const auto nowhere = shortestRoute(graph_, {0.5, 1.0}, {0.5, 1.0});
  ASSERT_TRUE(nowhere);
  EXPECT_EQ(nowhere->length_m, 0.0);
  const auto step = shortestRoute(graph_, {0.5, 1.0}, {0.8, 1.4});
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->length_m, 0.5, 1e-9);
}

TEST_F(Flat, ThereIsNoRouteToWhereNoWayLeads) {
  EXPECT_FALSE(shortestRoute(graph_, {0.5, 2.0}, {40.0, 2.0})) << "nothing near the goal";
  graph_.disconnect(EdgeType::kTraversable, nodes_[5], nodes_[6]);
  EXPECT_FALSE(shortestRoute(graph_, {0.5, 2.0}, {11.5, 2.0}));
  EXPECT_TRUE(shortestRoute(graph_, {0.5, 2.0}, {5.5, 2.0}));
  EXPECT_FALSE(shortestRoute(SceneGraph{}, {0.0, 0.0}, {1.0, 0.0}));
}

TEST_F(Flat, ARouteTakesTheShorterOfTwoWays) {
  const NodeId detour = graph_.add({5.0, 30.0, 0.0}, 0.0, NavigationAttributes{}).id;
  graph_.connect({EdgeType::kTraversable, nodes_[0], detour, {}});
  graph_.connect({EdgeType::kTraversable, detour, nodes_[11], {}});
  EXPECT_NEAR(shortestRoute(graph_, {0.5, 2.0}, {11.5, 2.0})->length_m, 11.0, 1e-9);
}

TEST_F(Flat, FindsObjectsByRoomAndByClass) {
  const NodeId near = objectAt("chair", 5.0, 1);
  const NodeId far = objectAt("Dining Table", 10.0, 2);
  EXPECT_EQ(objectsIn(graph_, rooms_[1]), std::vector<NodeId>{near});
  EXPECT_TRUE(objectsIn(graph_, rooms_[0]).empty());
  EXPECT_TRUE(objectsIn(graph_, 77).empty());
  EXPECT_EQ(nearestObject(graph_, "dining_table", {0.0, 0.0}), far);
  EXPECT_EQ(nearestObject(graph_, "oven", {0.0, 0.0}), std::nullopt);
}

TEST_F(Flat, ARoomIsFoundByNumberIdNameAndLabel) {
  setLabelByPerson(graph_, rooms_[1], "Küche");
  Node named = graph_.at(rooms_[1]);
  std::get<RoomAttributes>(named.attributes).name = "room_2";
  graph_.update(named);
  for (const std::string& name :
       {std::string("2"), std::to_string(rooms_[1]), std::string("room_2"), std::string("Küche")})
    EXPECT_EQ(roomNamed(graph_, name), rooms_[1]) << name;
  EXPECT_EQ(roomWith(graph_, 2), rooms_[1]);
  EXPECT_EQ(roomWith(graph_, rooms_[1]), rooms_[1]);
  for (const char* name : {"7", "bath", "unknown", "", "-1"})
    EXPECT_THROW((void)roomNamed(graph_, name), Error) << name;
}

TEST(PrintableUtf8, TakesWordsOfAnyLanguageAndNothingThatHidesOrBreaksALine) {
  for (const std::string& good : {std::string(), std::string("Küche 2"), std::string("廚房"),
                                  std::string("\xF0\x9F\x9B\x8B")})
    EXPECT_TRUE(isPrintableUtf8(good)) << good;
  const std::vector<std::string> bad = {"a\nb", "\x7F",     "\xC2\x85",     "\xE2\x80\xAE",
                                        "\xC3", "\xC0\xAF", "\xED\xA0\x80", "\xF5\x80\x80\x80",
                                        "\x80"};
  for (const std::string& text : bad) EXPECT_FALSE(isPrintableUtf8(text));
}

TEST_F(Flat, TellsAdjacentRoomsAndThroughWhichDoor) {
  const auto beside = adjacentRooms(graph_, rooms_[1]);
  ASSERT_EQ(beside.size(), 2U);
  EXPECT_EQ(beside[0].room, rooms_[0]);
  EXPECT_EQ(beside[0].doors, std::vector<NodeId>{doors_[0]});
  EXPECT_EQ(beside[1].room, rooms_[2]);
  EXPECT_TRUE(adjacentRooms(graph_, 77).empty());
}

TEST_F(Flat, ARoomIsNamedByWhatIsInIt) {
  RoomLabeler labeler(defaultRoomLabels());
  labeler.update(graph_);
  EXPECT_EQ(graph_.room(rooms_[0]).label, "unknown");
  EXPECT_EQ(graph_.room(rooms_[0]).label_score, 0.0);
  objectAt("Bed", 1.0, 0);
  objectAt("oven", 5.0, 1);
  labeler.update(graph_);
  EXPECT_EQ(graph_.room(rooms_[0]).label, "bedroom");
  EXPECT_EQ(graph_.room(rooms_[1]).label, "kitchen");
  EXPECT_GT(graph_.room(rooms_[0]).label_score, 0.5);
  EXPECT_LE(graph_.room(rooms_[0]).label_score, 1.0);
  objectAt("sofa", 5.0, 1);
  labeler.update(graph_);
  EXPECT_EQ(graph_.room(rooms_[1]).label, "unknown") << "oven and sofa: undecided";
}

TEST_F(Flat, AnObjectThatLeavesTakesItsEvidenceAlong) {
  RoomLabeler labeler(defaultRoomLabels());
  const NodeId bed = objectAt("bed", 3.9, 0);
  labeler.update(graph_);
  graph_.connect({EdgeType::kContains, rooms_[1], bed, {}});
  labeler.update(graph_);
  EXPECT_EQ(graph_.room(rooms_[0]).label, "unknown");
  EXPECT_EQ(graph_.room(rooms_[1]).label, "bedroom");
}

TEST_F(Flat, APersonsLabelStaysUntilItIsTakenBack) {
  RoomLabeler labeler(defaultRoomLabels());
  setLabelByPerson(graph_, rooms_[0], "guest room");
  objectAt("bed", 1.0, 0);
  labeler.update(graph_);
  EXPECT_EQ(graph_.room(rooms_[0]).label, "guest room");
  EXPECT_EQ(graph_.room(rooms_[0]).label_source, LabelSource::kPerson);
  EXPECT_EQ(graph_.room(rooms_[0]).label_score, 1.0);
  setLabelByPerson(graph_, rooms_[0], "");
  labeler.update(graph_);
  EXPECT_EQ(graph_.room(rooms_[0]).label, "bedroom");
  EXPECT_THROW(setLabelByPerson(graph_, nodes_[0], "hall"), Error);
  EXPECT_THROW(setLabelByPerson(graph_, 77, "hall"), Error);
  EXPECT_THROW(setLabelByPerson(graph_, rooms_[0], "a\nb"), Error);
  EXPECT_THROW(setLabelByPerson(graph_, rooms_[0], std::string(kMaxLabelLength + 1, 'x')), Error);
}

/// Free cells [0, 80) x [0, 80) with walls on three sides; to the east what `east` says.
FreeSpace roomWithEast(std::int8_t east) {
  FreeSpace layer;
  layer.cells = FreeSpaceCells({{-10, -10}, {90, 90}}, kUnknown);
  for (int y = -1; y <= 80; ++y)
    for (int x = -1; x <= 80; ++x) layer.cells.at({x, y}) = kFullObstacle;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 80; ++x) layer.cells.at({x, y}) = kFree;
    layer.cells.at({80, y}) = east;
  }
  return layer;
}

TEST(FrontierShare, IsTheShareOfTheBoundaryBehindWhichNothingIsKnown) {
  const Polygon room = rectangle(0.0, 0.0, 4.0, 4.0);
  EXPECT_EQ(frontierShare(room, roomWithEast(kFullObstacle)), 0.0);
  EXPECT_EQ(frontierShare(room, roomWithEast(kFree)), 0.0) << "an opening is no frontier";
  EXPECT_NEAR(frontierShare(room, roomWithEast(kUnknown)), 0.25, 0.01);
  EXPECT_EQ(frontierShare(room, FreeSpace{}), 1.0);
  EXPECT_EQ(frontierShare(Polygon{}, FreeSpace{}), 0.0);
}

TEST(RoomCompleteness, ARoomIsPartialUntilEnoughOfItsBoundaryIsKnownAndConfirmedFromThenOn) {
  SceneGraph graph;
  RoomAttributes attributes;
  attributes.polygon = rectangle(0.0, 0.0, 4.0, 4.0);
  const NodeId room = graph.add({2.0, 2.0, 0.0}, 0.0, attributes).id;
  RoomCompleteness completeness(0.2);
  completeness.update(graph, roomWithEast(kUnknown), {});
  EXPECT_EQ(graph.room(room).state, RoomState::kPartial);
  EXPECT_NEAR(graph.room(room).frontier_share, 0.25, 0.01);
  completeness.update(graph, roomWithEast(kFullObstacle), {});
  EXPECT_EQ(graph.room(room).state, RoomState::kPartial) << "nothing is said to have changed";
  completeness.update(graph, roomWithEast(kFullObstacle), {{80, 0}, {81, 80}});
  EXPECT_EQ(graph.room(room).state, RoomState::kConfirmed);
  completeness.update(graph, roomWithEast(kUnknown), {{80, 0}, {81, 80}});
  EXPECT_EQ(graph.room(room).state, RoomState::kConfirmed);
  RoomCompleteness all(1.0);
  all.update(graph, FreeSpace{}, {});
  EXPECT_EQ(graph.room(room).state, RoomState::kConfirmed) << "the paper knows no partial rooms";
}

}  // namespace
}  // namespace occusg
