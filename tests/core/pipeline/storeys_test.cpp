// SPDX-License-Identifier: BSD-3-Clause
// A building with more than one storey: events of a camera that gets from one to another.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "error_sentence.hpp"
#include "occusg/geometry/polygon_overlap.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg/io/results.hpp"
#include "occusg/io/scene_graph_file.hpp"
#include "occusg/io/session_folder.hpp"
#include "occusg/pipeline/pipeline.hpp"
#include "temporary_folder.hpp"
#include "two_storey_house.hpp"

namespace occusg {
namespace {

using testing::BoxWorld;
using testing::kUpperFloor_m;
using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;
using testing::Tour;
using testing::tourOfBothStoreys;
using testing::twoStoreyHouse;

Pipeline carried(const std::vector<DepthFrame>& frames, const PipelineConfig& config = {}) {
  Pipeline pipeline(config);
  for (const DepthFrame& frame : frames) pipeline.process(frame);
  pipeline.finish();
  return pipeline;
}

Polygon box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

std::vector<RoomRecord> roomsOn(const RoomsFile& file, int storey) {
  std::vector<RoomRecord> rooms;
  for (const RoomRecord& room : file.rooms)
    if (room.level == storey) rooms.push_back(room);
  return rooms;
}

std::vector<StairsAttributes> stairsIn(const SceneGraph& graph) {
  std::vector<StairsAttributes> stairs;
  for (const auto& [id, node] : graph.nodes(NodeType::kStairs))
    stairs.push_back(std::get<StairsAttributes>(node.attributes));
  return stairs;
}

/// The greatest agreement of a room with the polygon.
double bestAgreement(const std::vector<RoomRecord>& rooms, const Polygon& polygon) {
  double best = 0.0;
  for (const RoomRecord& room : rooms)
    best = std::max(best, intersectionOverUnion(room.polygon, polygon));
  return best;
}

TEST(Storeys, HouseHasTwoStoreysWithTheirFloorsAndCeilings) {
  const RoomsFile file = roomsOf(carried(tourOfBothStoreys()), "house");
  ASSERT_EQ(file.storeys.size(), 2U);
  EXPECT_NEAR(file.storeys[0].floor_z_m, 0.0, 0.1);
  EXPECT_NEAR(file.storeys[1].floor_z_m, kUpperFloor_m, 0.1);
  ASSERT_TRUE(file.storeys[0].ceiling_z_m && file.storeys[1].ceiling_z_m);
  EXPECT_NEAR(*file.storeys[0].ceiling_z_m, 2.5, 0.1);
  EXPECT_NEAR(*file.storeys[1].ceiling_z_m, 5.5, 0.1);
}

TEST(Storeys, RoomsAboveEachOtherAreRoomsOfTheirOwnStorey) {
  const RoomsFile file = roomsOf(carried(tourOfBothStoreys()), "house");
  for (const int storey : {0, 1}) {
    SCOPED_TRACE(storey);
    const std::vector<RoomRecord> rooms = roomsOn(file, storey);
    EXPECT_EQ(rooms.size(), 2U);
    EXPECT_GT(bestAgreement(rooms, box(0, 0, 4, 4)), 0.9);
    EXPECT_GT(bestAgreement(rooms, box(4.2, 0, 8.2, 4)), 0.7);  // without the stair and its well
  }
}

TEST(Storeys, StairwellIsNoFloorOfTheUpperStorey) {
  const Pipeline pipeline = carried(tourOfBothStoreys());
  ASSERT_EQ(pipeline.storeys().size(), 2U);
  const FreeSpace& upper = pipeline.freeSpace(1);
  EXPECT_NE(upper.cells.valueOr(upper.frame.cellAt({5.0, 3.4}), kUnknown), kFree);
  EXPECT_EQ(upper.cells.valueOr(upper.frame.cellAt({5.0, 2.0}), kUnknown), kFree);
}

TEST(Storeys, EveryNodeLiesOnTheStoreyThatItNames) {
  const Pipeline pipeline = carried(tourOfBothStoreys());
  std::size_t agents_upstairs = 0;
  for (const NodeTypeInfo& type : kNodeTypes) {
    for (const auto& [id, node] : pipeline.graph().nodes(type.type)) {
      SCOPED_TRACE(std::string(type.name) + " " + std::to_string(id));
      const Storey& storey = pipeline.storeys().at(node.floor_id);
      if (type.type == NodeType::kStairs) continue;  // between two of them
      if (type.type == NodeType::kAgent) {
        agents_upstairs += node.floor_id == 1 ? 1U : 0U;
        EXPECT_GE(node.position.z(), storey.span.bottom_m);
        EXPECT_LT(node.position.z(), storey.span.top_m);
      } else {
        EXPECT_NEAR(node.position.z(), storey.floor_z_m, 1e-6);
      }
    }
  }
  EXPECT_GT(agents_upstairs, 5U);
}

TEST(Storeys, RoomsAboveEachOtherAreNotJoined) {
  const Pipeline pipeline = carried(tourOfBothStoreys());
  const SceneGraph& graph = pipeline.graph();
  EXPECT_EQ(graph.edges(EdgeType::kRoomAdjacency).size(), 2U);
  for (const auto& [ends, edge] : graph.edges(EdgeType::kContains))
    EXPECT_EQ(graph.at(edge.source).floor_id, graph.at(edge.target).floor_id);
  for (const auto& [ends, edge] : graph.edges(EdgeType::kRoomAdjacency))
    EXPECT_EQ(graph.at(edge.source).floor_id, graph.at(edge.target).floor_id);
}

TEST(Storeys, TrajectoryLeadsThroughAllStoreys) {
  const Pipeline pipeline = carried(tourOfBothStoreys());
  const SceneGraph& graph = pipeline.graph();
  EXPECT_EQ(graph.edges(EdgeType::kTemporal).size(), graph.nodes(NodeType::kAgent).size() - 1);
}

TEST(Storeys, GraphOfABuildingCanBeReadAgain) {
  const Pipeline pipeline = carried(tourOfBothStoreys());
  const SceneGraph& graph = pipeline.graph();
  const SceneGraph read = parseSceneGraph(toJson(graph, "house", "map"), "house").graph;
  EXPECT_EQ(read.nodeCount(), graph.nodeCount());
  EXPECT_EQ(read.edgeCount(), graph.edgeCount());
  for (const auto& [id, room] : graph.nodes(NodeType::kRoom))
    EXPECT_EQ(read.at(id).floor_id, room.floor_id);
}

TEST(Storeys, CameraThatReturnsFindsItsStoreyAgain) {
  Tour tour(twoStoreyHouse());
  tour.to({6.2, 2.0, 0.0}).lookRound().to({4.35, 2.4, 0.0}).to({4.35, 3.4, 0.0});
  tour.to({7.3, 3.4, kUpperFloor_m}).to({7.6, 1.8, kUpperFloor_m}).to({5.0, 1.8, kUpperFloor_m});
  tour.lookRound().to({7.6, 1.8, kUpperFloor_m}).to({7.3, 3.4, kUpperFloor_m});
  tour.to({4.35, 3.4, 0.0}).to({4.35, 2.4, 0.0}).to({1.9, 2.0, 0.0}).lookRound();
  const Pipeline pipeline = carried(tour.frames());
  ASSERT_EQ(pipeline.storeys().size(), 2U);
  EXPECT_EQ(pipeline.graph().nodes(NodeType::kAgent).rbegin()->second.floor_id, 0);
  EXPECT_EQ(roomsOn(roomsOf(pipeline, "house"), 0).size(), 2U);
}

TEST(Storeys, LiftGivesAStoreyToo) {
  Tour tour(twoStoreyHouse());
  tour.to({1.9, 2.0, 0.0}).lookRound().to({1.9, 2.0, kUpperFloor_m}).lookRound();
  tour.to({6.2, 2.0, kUpperFloor_m}).lookRound();
  const Pipeline pipeline = carried(tour.frames());
  EXPECT_EQ(pipeline.storeys().size(), 2U);
  const auto stairs = stairsIn(pipeline.graph());
  ASSERT_EQ(stairs.size(), 1U);
  EXPECT_EQ(stairs[0].kind, StairsKind::kLift);
  EXPECT_EQ(stairs[0].risers, 0);
}

TEST(Storeys, ClimbedStairIsANodeThatJoinsTheRoomsAtItsEnds) {
  const Pipeline pipeline = carried(tourOfBothStoreys());
  const SceneGraph& graph = pipeline.graph();
  const auto all = stairsIn(graph);
  ASSERT_EQ(all.size(), 1U);
  const StairsAttributes& stairs = all.front();
  EXPECT_EQ(stairs.kind, StairsKind::kStairs);
  EXPECT_NEAR(stairs.rise_m, kUpperFloor_m, 0.6);
  EXPECT_GE(stairs.risers, 10);  // those of 15 that the camera saw
  EXPECT_LE(stairs.risers, 15);
  EXPECT_EQ(stairs.lower_storey, 0);
  EXPECT_EQ(stairs.upper_storey, 1);
  EXPECT_EQ(stairs.lower_room, roomAt(graph, Place{6.0, 1.0, 0.0}));
  EXPECT_EQ(stairs.upper_room, roomAt(graph, Place{6.0, 1.0, kUpperFloor_m}));
  EXPECT_TRUE(contains({stairs.footprint, {}}, {6.0, 3.4}));
}

TEST(Storeys, StairClimbedTwiceIsOneNode) {
  Tour tour(twoStoreyHouse());
  tour.to({6.2, 2.0, 0.0}).lookRound().to({4.35, 2.4, 0.0}).to({4.35, 3.4, 0.0});
  tour.to({7.3, 3.4, kUpperFloor_m}).to({7.6, 1.8, kUpperFloor_m}).to({5.0, 1.8, kUpperFloor_m});
  tour.to({7.6, 1.8, kUpperFloor_m}).to({7.3, 3.4, kUpperFloor_m}).to({4.35, 3.4, 0.0});
  tour.to({4.35, 2.4, 0.0}).to({6.2, 2.0, 0.0});
  EXPECT_EQ(stairsIn(carried(tour.frames()).graph()).size(), 1U);
}

TEST(Storeys, CameraThatWasCarriedElsewhereClimbedNoStair) {
  std::vector<DepthFrame> frames = Tour(twoStoreyHouse()).to({1.9, 2.0, 0.0}).lookRound().frames();
  const double end_s = frames.back().stamp_s;
  Tour upstairs(twoStoreyHouse());
  upstairs.to({5.0, 1.8, kUpperFloor_m}).lookRound().to({7.6, 1.8, kUpperFloor_m}).lookRound();
  for (DepthFrame frame : upstairs.frames()) {
    frame.stamp_s += end_s + 20.0;
    frames.push_back(frame);
  }
  const Pipeline pipeline = carried(frames);
  EXPECT_EQ(pipeline.storeys().size(), 2U);
  EXPECT_TRUE(stairsIn(pipeline.graph()).empty());
}

TEST(Storeys, WayFromRoomToRoomLeadsOverTheStair) {
  const Pipeline pipeline = carried(tourOfBothStoreys());
  const SceneGraph& graph = pipeline.graph();
  const auto way = shortestRoute(graph, Place{1.0, 2.0, 0.0}, Place{1.0, 2.0, kUpperFloor_m});
  ASSERT_TRUE(way);
  EXPECT_EQ(way->rooms.size(), 4U);
  EXPECT_EQ(way->stairs.size(), 1U);
  EXPECT_GT(way->length_m, 10.0);
  const auto same_storey = shortestRoute(graph, Place{1.0, 2.0, 0.0}, Place{6.0, 2.0, 0.0});
  ASSERT_TRUE(same_storey);
  EXPECT_TRUE(same_storey->stairs.empty());
}

/// The poses rise by half a metre in the course of a drive that stays on its floor.
TEST(Storeys, DriftOfHalfAMetreMakesNoStorey) {
  Tour tour(testing::twoRooms());
  for (int round = 0; round < 4; ++round)
    tour.to({1.9, 2.0, 0.0}).lookRound().to({6.2, 2.0, 0.0}).lookRound();
  std::vector<DepthFrame> frames = tour.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(frames.size());
    frames[i].T_map_camera.translation().z() += 0.5 * share;
  }
  EXPECT_EQ(carried(frames).storeys().size(), 1U);
}

TEST(Storeys, StepsWithinARoomMakeNoStorey) {
  BoxWorld world = testing::twoRooms();
  world.add({4.2, 0.0, 0.0}, {8.2, 4.0, 0.36});  // two steps up to the east room
  Tour tour(std::move(world));
  tour.to({1.9, 2.0, 0.0}).lookRound().to({4.0, 2.0, 0.0});
  tour.to({4.4, 2.0, 0.36}).to({6.2, 2.0, 0.36}).lookRound();
  EXPECT_EQ(carried(tour.frames()).storeys().size(), 1U);
}

TEST(Storeys, LandingHalfWayUpMakesNoStorey) {
  BoxWorld world = testing::twoRooms();
  world.add({6.6, 2.9, 0.0}, {8.2, 4.0, 1.4});  // 1.6 m x 1.1 m
  Tour tour(std::move(world));
  tour.to({1.9, 2.0, 0.0}).lookRound().to({5.0, 3.4, 0.0}).to({6.7, 3.4, 1.3}).to({7.8, 3.4, 1.3});
  tour.lookRound();
  EXPECT_EQ(carried(tour.frames()).storeys().size(), 1U);
}

TEST(Storeys, CameraThatSeesNoFloorHasOneStorey) {
  BoxWorld world;
  world.add({-20.0, -20.0, 4.0}, {20.0, 20.0, 4.2});
  Tour tour(std::move(world));
  tour.to({0.0, 0.0, 0.0}).lookRound().to({3.0, 0.0, 0.0}).lookRound();
  EXPECT_EQ(carried(tour.frames()).storeys().size(), 1U);
}

TEST(Storeys, OneStoreyWritesTheFilesItAlwaysWrote) {
  Tour tour(testing::twoRooms());
  const Pipeline pipeline =
      carried(tour.to({1.9, 2.0, 0.0}).lookRound().to({6.2, 2.0, 0.0}).lookRound().frames());
  EXPECT_TRUE(roomsOf(pipeline, "flat").storeys.empty());
  for (const ResultFile& file : resultFiles(pipeline, "flat", pipeline.times()))
    EXPECT_EQ(file.name.find("free_space_"), std::string::npos) << file.name;
}

TEST(Storeys, EachStoreyHasItsMapFile) {
  const Pipeline pipeline = carried(tourOfBothStoreys());
  std::vector<std::string> maps;
  for (const ResultFile& file : resultFiles(pipeline, "house", pipeline.times()))
    if (file.name.find("free_space_") == 0) maps.push_back(file.name);
  EXPECT_EQ(maps, (std::vector<std::string>{"free_space_0.pgm", "free_space_0.yaml",
                                            "free_space_1.pgm", "free_space_1.yaml"}));
}

/// Goes on from a session of `first`'s frames with those from `next` on.
Pipeline resumedWith(const std::vector<DepthFrame>& first, const std::vector<DepthFrame>& next,
                     const TemporaryFolder& folder) {
  Pipeline before{PipelineConfig{}};
  for (const DepthFrame& frame : first) before.process(frame);
  saveSession(folder.at("session"), before.occupancyMap().tree(), before.sessionState("house"));
  Pipeline after{PipelineConfig{}};
  after.resume(loadSession(folder.at("session"), after.config().occupancy));
  for (const DepthFrame& frame : next) after.process(frame);
  after.finish();
  return after;
}

TEST(Storeys, SessionOfAHouseGoesOnWithItsStoreysRoomsAndStairs) {
  const std::vector<DepthFrame> frames = tourOfBothStoreys();
  const auto half = frames.end() - 20;  // upstairs
  const TemporaryFolder folder;
  const Pipeline whole = carried(frames);
  const Pipeline resumed = resumedWith({frames.begin(), half}, {half, frames.end()}, folder);
  ASSERT_EQ(resumed.storeys().size(), 2U);
  for (std::size_t storey = 0; storey < 2; ++storey) {
    EXPECT_NEAR(resumed.storeys()[storey].floor_z_m, whole.storeys()[storey].floor_z_m, 1e-3);
    EXPECT_EQ(resumed.freeSpace(storey).cells, whole.freeSpace(storey).cells) << storey;
  }
  const auto& expected = whole.graph().nodes(NodeType::kRoom);
  ASSERT_EQ(resumed.graph().nodes(NodeType::kRoom).size(), expected.size());
  for (const auto& [id, node] : expected) {
    ASSERT_NE(resumed.graph().find(id), nullptr) << id;
    EXPECT_EQ(resumed.graph().at(id).floor_id, node.floor_id);
    EXPECT_NEAR(resumed.graph().room(id).area_m2, whole.graph().room(id).area_m2, 0.1);
  }
  ASSERT_EQ(resumed.graph().nodes(NodeType::kStairs).size(), 1U);
  const StairsAttributes stairs = stairsIn(resumed.graph()).front();
  const StairsAttributes of_one_run = stairsIn(whole.graph()).front();
  EXPECT_EQ(stairs.lower_room, of_one_run.lower_room);
  EXPECT_EQ(stairs.upper_room, of_one_run.upper_room);
  EXPECT_EQ(stairs.risers, of_one_run.risers);
}

TEST(Storeys, SessionOfOneStoreyGoesOnUpstairs) {
  std::vector<DepthFrame> upstairs = tourOfBothStoreys();
  Tour tour(twoStoreyHouse());
  tour.to({1.9, 2.0, 0.0}).lookRound().to({6.2, 2.0, 0.0}).lookRound();
  const std::vector<DepthFrame> below = tour.frames();
  upstairs.erase(upstairs.begin(), upstairs.end() - 40);
  ASSERT_GT(upstairs.front().T_map_camera.translation().z(), kUpperFloor_m);
  const TemporaryFolder folder;
  const Pipeline resumed = resumedWith(below, upstairs, folder);
  ASSERT_EQ(resumed.storeys().size(), 2U);
  std::set<int> floors;
  for (const auto& [id, room] : resumed.graph().nodes(NodeType::kRoom))
    floors.insert(room.floor_id);
  EXPECT_EQ(floors, (std::set<int>{0, 1}));
}

TEST(Storeys, SessionOfSeveralStoreysNeedsThePipelinesOwnDecomposer) {
  Pipeline before{PipelineConfig{}};
  for (const DepthFrame& frame : tourOfBothStoreys()) before.process(frame);
  Session session{OccupancyMap(OccupancyMapConfig{}), before.sessionState("house")};
  Pipeline after(PipelineConfig{}, makeDecomposer(PipelineConfig{}));
  EXPECT_TRUE(
      tells(sentenceOf([&] { after.resume(std::move(session)); }), {"2 storeys", "decomposer"}));
}

TEST(Storeys, SessionWithRoomsOfOneStoreyTooFewIsRefused) {
  const TemporaryFolder folder;
  Pipeline before{PipelineConfig{}};
  for (const DepthFrame& frame : tourOfBothStoreys()) before.process(frame);
  SessionState state = before.sessionState("house");
  state.building.storeys.push_back({2, 6.0, {}});
  saveSession(folder.at("session"), before.occupancyMap().tree(), state);
  EXPECT_TRUE(
      tells(sentenceOf([&] { (void)loadSession(folder.at("session"), OccupancyMapConfig{}); }),
            {"session.json", "2 storeys", "3"}));
}

}  // namespace
}  // namespace occusg
