// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "box_world.hpp"
#include "error_sentence.hpp"
#include "occusg/geometry/polygon_overlap.hpp"
#include "occusg/io/session_folder.hpp"
#include "occusg/pipeline/pipeline.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

void processRange(Pipeline& pipeline, const std::vector<DepthFrame>& frames, std::size_t first,
                  std::size_t last) {
  for (std::size_t i = first; i < last; ++i) pipeline.process(frames[i]);
}

TEST(Session, SecondHalfGoesOnWithTheRoomsOfTheFirst) {
  const std::vector<DepthFrame> frames = testing::driveThroughTwoRooms();
  const std::size_t half = frames.size() / 2;
  Pipeline whole{PipelineConfig{}};
  processRange(whole, frames, 0, frames.size());
  whole.finish();

  const TemporaryFolder folder;
  {
    Pipeline first{PipelineConfig{}};
    processRange(first, frames, 0, half);
    saveSession(folder.at("session"), first.occupancyMap().tree(), first.sessionState("drive"));
  }
  Pipeline second{PipelineConfig{}};
  second.resume(loadSession(folder.at("session"), second.config().occupancy));
  processRange(second, frames, half, frames.size());
  second.finish();

  const auto& expected = whole.graph().nodes(NodeType::kRoom);
  const auto& rooms = second.graph().nodes(NodeType::kRoom);
  ASSERT_EQ(rooms.size(), 2U);
  ASSERT_EQ(rooms.size(), expected.size());
  for (const auto& [id, node] : expected) {
    const RoomAttributes& room = second.graph().room(id);
    const RoomAttributes& of_one_run = whole.graph().room(id);
    EXPECT_EQ(room.name, of_one_run.name);
    EXPECT_EQ(room.region_id, of_one_run.region_id);
    EXPECT_EQ(room.reason, of_one_run.reason);
    EXPECT_GT(intersectionOverUnion(room.polygon, of_one_run.polygon), 0.999);
  }
  EXPECT_EQ(second.graph().nodes(NodeType::kAgent).size(),
            whole.graph().nodes(NodeType::kAgent).size());
  EXPECT_EQ(second.graph().edges(EdgeType::kTemporal).size(),
            whole.graph().edges(EdgeType::kTemporal).size());
  EXPECT_EQ(second.freeSpace().cells, whole.freeSpace().cells);
  for (const NodeType type : {NodeType::kNavigation, NodeType::kDoor})
    EXPECT_EQ(second.graph().nodes(type).size(), whole.graph().nodes(type).size()) << nameOf(type);
  EXPECT_EQ(second.graph().edges(EdgeType::kTraversable).size(),
            whole.graph().edges(EdgeType::kTraversable).size());
}

TEST(Session, LabelOfAPersonAndNavigationNodesComeBackUnderTheirIds) {
  const std::vector<DepthFrame> frames = testing::driveThroughTwoRooms();
  const TemporaryFolder folder;
  Pipeline first{PipelineConfig{}};
  processRange(first, frames, 0, frames.size() - 3);
  const NodeId room = first.graph().nodes(NodeType::kRoom).begin()->first;
  first.setRoomLabel(room, "den");
  saveSession(folder.at("session"), first.occupancyMap().tree(), first.sessionState("drive"));
  Pipeline second{PipelineConfig{}};
  second.resume(loadSession(folder.at("session"), second.config().occupancy));
  processRange(second, frames, frames.size() - 3, frames.size());
  second.finish();
  EXPECT_EQ(second.graph().room(room).label, "den");
  EXPECT_EQ(second.graph().room(room).label_source, LabelSource::kPerson);
  std::size_t kept = 0;
  for (const auto& [id, node] : first.graph().nodes(NodeType::kNavigation))
    kept += second.graph().find(id) != nullptr ? 1 : 0;
  const std::size_t before = first.graph().nodes(NodeType::kNavigation).size();
  EXPECT_GE(10 * kept, 9 * before) << kept << " of " << before;
}

/// A box [0, 0.6] x [0, 0.6] between two heights.
Detection boxBetween(double z0, double z1) {
  Detection detection;
  detection.class_name = "box";
  detection.score = 0.9;
  detection.box = {Eigen::Vector3d(0.0, 0.0, z0), Eigen::Vector3d(0.6, 0.6, z1)};
  detection.centroid = detection.box.center();
  return detection;
}

// One box on another: two things in each frame that shows both. Of a frame that shows the lower one
// alone, they would be taken for pieces of one thing.
TEST(Session, ThingsSeenApartStayApart) {
  const Detection lower = boxBetween(0.0, 0.3);
  const Detection upper = boxBetween(0.3, 0.6);
  const auto boxesIn = [](const BuildingPipeline& pipeline) {
    return pipeline.graph().nodes(NodeType::kObject).size();
  };
  BuildingPipeline whole{PipelineConfig{}};
  for (int frame = 0; frame < 3; ++frame) whole.observeObjects({lower, upper}, frame);
  const TemporaryFolder folder;
  SessionState state;
  state.stamp_s = 2.0;
  whole.saveTo(state);
  saveSession(folder.at("session"), state);

  BuildingPipeline resumed{PipelineConfig{}};
  resumed.resumeFrom(loadSession(folder.at("session"), OccupancyMapConfig{}).state);
  for (BuildingPipeline* pipeline : {&whole, &resumed}) pipeline->observeObjects({lower}, 3.0);
  EXPECT_EQ(boxesIn(whole), 2U);
  EXPECT_EQ(boxesIn(resumed), 2U);

  state.graph.objects.seen_apart.clear();
  BuildingPipeline forgetful{PipelineConfig{}};
  forgetful.resumeFrom(state);
  forgetful.observeObjects({lower}, 3.0);
  EXPECT_EQ(boxesIn(forgetful), 1U) << "the evidence decides nothing here";
}

TEST(Session, NeedsAFrameAndComesBeforeTheFirstOne) {
  Pipeline pipeline{PipelineConfig{}};
  EXPECT_TRUE(tells(sentenceOf([&] { (void)pipeline.sessionState("x"); }), {"no frame"}));
  const std::vector<DepthFrame> frames = testing::driveThroughTwoRooms();
  processRange(pipeline, frames, 0, 1);
  Pipeline other{PipelineConfig{}};
  processRange(other, frames, 0, 1);
  EXPECT_TRUE(
      tells(sentenceOf([&] {
              pipeline.resume({OccupancyMap{OccupancyMapConfig{}}, other.sessionState("x")});
            }),
            {"after the first frame"}));
  EXPECT_GT(pipeline.occupancyMap().tree().size(), 0U);
}

TEST(Session, OneWithoutAMapGoesOnWithTheMapItIsGiven) {
  const std::vector<DepthFrame> frames = testing::driveThroughTwoRooms();
  const std::size_t half = frames.size() / 2;
  Pipeline first{PipelineConfig{}};
  processRange(first, frames, 0, half);
  const TemporaryFolder folder;
  saveSession(folder.at("whole"), first.occupancyMap().tree(), first.sessionState("drive"));
  saveSession(folder.at("session"), first.sessionState("drive"));
  const auto load = [&](const char* name) {
    return loadSession(folder.at(name), first.config().occupancy);
  };
  Pipeline second{PipelineConfig{}};
  EXPECT_TRUE(tells(sentenceOf([&] { second.resume(load("session")); }), {"has no map"}));
  Session session = load("session");
  session.map = load("whole").map;
  second.resume(std::move(session));
  processRange(second, frames, half, frames.size());
  EXPECT_GE(second.graph().nodes(NodeType::kRoom).size(),
            first.graph().nodes(NodeType::kRoom).size());
  for (const auto& entry : first.graph().nodes(NodeType::kRoom))
    EXPECT_NE(second.graph().find(entry.first), nullptr);
}

TEST(Session, OlderFramesAreRefused) {
  const std::vector<DepthFrame> frames = testing::driveThroughTwoRooms();
  Pipeline first{PipelineConfig{}};
  processRange(first, frames, 0, 3);
  const TemporaryFolder folder;
  saveSession(folder.at("session"), first.occupancyMap().tree(), first.sessionState("drive"));
  Pipeline second{PipelineConfig{}};
  second.resume(loadSession(folder.at("session"), second.config().occupancy));
  EXPECT_TRUE(tells(sentenceOf([&] { second.process(frames[2]); }), {"not after 0.4 s"}));
}

}  // namespace
}  // namespace occusg
