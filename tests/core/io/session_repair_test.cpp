// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/session_repair.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "error_sentence.hpp"
#include "occusg/io/scene_graph_file.hpp"
#include "temporary_folder.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;
using testing::sentenceOf;
using testing::TemporaryFolder;

constexpr double kNow_s = 1000.0;

/// Two agents, seen at 10 s and 12.5 s.
SessionState soundState() {
  SessionState state;
  state.scene = "flat";
  state.stamp_s = 12.5;
  state.last_room_update_s = 12.0;
  state.graph.last_update_s = 12.0;
  state.graph.last_maintenance_s = 12.0;
  SceneGraph& graph = state.graph.graph;
  const NodeId first = graph.add({1, 1, 0}, 10.0, AgentAttributes{}).id;
  const NodeId second = graph.add({2, 1, 0}, 12.5, AgentAttributes{}).id;
  graph.connect({EdgeType::kTemporal, first, second, {}});
  return state;
}

class SessionRepair : public ::testing::Test {
 protected:
  SessionRepair() : map_(OccupancyMapConfig{}) {
    testing::insertSlice(map_, {"..#", ".#.", "###"});
  }
  void save(const SessionState& state = soundState()) const {
    saveSession(path_, map_.tree(), state);
  }
  [[nodiscard]] RepairedSession repaired() const {
    return readForRepair(path_, OccupancyMapConfig{}, kNow_s);
  }
  [[nodiscard]] std::string refusal() const {
    return sentenceOf([&] { (void)loadSession(path_, OccupancyMapConfig{}); });
  }
  void replace(const std::string& part, const std::string& from, const std::string& to) const {
    std::string bytes = folder_.read("session/" + part);
    ASSERT_NE(bytes.find(from), std::string::npos) << bytes;
    folder_.write("session/" + part, bytes.replace(bytes.find(from), from.size(), to));
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.at("session");
  OccupancyMap map_;
};

TEST_F(SessionRepair, SessionThatIsFineIsReadAsItIs) {
  save();
  const RepairedSession read = repaired();
  EXPECT_TRUE(read.repairs.empty());
  EXPECT_TRUE(read.session.map.has_value());
  EXPECT_EQ(toJson(read.session.state.graph.graph, ""), toJson(soundState().graph.graph, ""));
}

TEST_F(SessionRepair, FailureMode06StampsFromTheFutureBecomeTheLatestThatCanBe) {
  SessionState state = soundState();
  state.stamp_s = 4294967295.0;
  state.graph.last_maintenance_s = 4294967295.0;
  state.graph.graph.add({3, 1, 0}, 4294967295.0, AgentAttributes{});
  save(state);
  const RepairedSession read = repaired();
  ASSERT_EQ(read.repairs.size(), 1U);
  EXPECT_EQ(read.repairs[0], "4 stamps were from the future");
  EXPECT_EQ(read.session.state.stamp_s, 12.5);
  EXPECT_EQ(read.session.state.graph.last_maintenance_s, 12.5);
  EXPECT_EQ(read.session.state.graph.graph.at(2).created_s, 12.5);
  EXPECT_EQ(read.session.state.graph.graph.at(0).created_s, 10.0);
}

TEST_F(SessionRepair, StampsThatCanBeStayAndNoNodeCountsAsChanged) {
  SessionState state = soundState();
  const Revision before = state.graph.graph.revision();
  EXPECT_EQ(repairStamps(state, kNow_s), 0U);
  EXPECT_EQ(state.graph.graph.revision(), before);
}

TEST_F(SessionRepair, NodeTooFarAwayIsLeftOutWithItsEdges) {
  save();
  replace("scene_graph.json", "[2.0,1.0,0.0]", "[691000.0,5334000.0,0.0]");
  const RepairedSession read = repaired();
  EXPECT_EQ(read.repairs.size(), 2U);  // the file is another, and what was left out of it
  EXPECT_EQ(read.session.state.graph.graph.nodes(NodeType::kAgent).size(), 1U);
  EXPECT_EQ(read.session.state.graph.graph.edgeCount(), 0U);
  EXPECT_EQ(read.session.state.graph.graph.nextId(NodeType::kAgent), 2);
}

TEST_F(SessionRepair, FailureMode17PartThatWasChangedIsTakenAsItIs) {
  save();
  replace("scene_graph.json", "\"created_s\":10.0", "\"created_s\":11.0");
  EXPECT_NE(refusal(), "");
  const RepairedSession read = repaired();
  EXPECT_EQ(read.repairs.size(), 1U);
  EXPECT_EQ(read.session.state.graph.graph.at(0).created_s, 11.0);
}

TEST_F(SessionRepair, FailureMode17MapThatCannotBeReadIsLeftOut) {
  save();
  folder_.write("session/map.ot", "half a map");
  const RepairedSession read = repaired();
  EXPECT_FALSE(read.session.map.has_value());
  EXPECT_EQ(read.session.state.graph.graph.nodes(NodeType::kAgent).size(), 2U);
  EXPECT_NE(read.repairs.back().find("the map is left out"), std::string::npos);
}

TEST_F(SessionRepair, SessionThatAKilledSaveSetAsideIsReadAndRepaired) {
  save();
  fs::rename(path_, folder_.at(".session.before"));
  EXPECT_NO_THROW((void)loadSession(path_, OccupancyMapConfig{}));
  EXPECT_EQ(repaired().repairs.size(), 1U);
  SessionState next = soundState();
  next.stamp_s = 20.0;
  save(next);
  EXPECT_EQ(loadSession(path_, OccupancyMapConfig{}).state.stamp_s, 20.0);
  EXPECT_FALSE(fs::exists(folder_.at(".session.before")));
}

TEST_F(SessionRepair, WhatIsNoSessionIsRefused) {
  EXPECT_NE(sentenceOf([&] { (void)repaired(); }), "");
  save();
  folder_.write("session/scene_graph.json", "{");
  EXPECT_NE(sentenceOf([&] { (void)repaired(); }), "");
}

}  // namespace
}  // namespace occusg
