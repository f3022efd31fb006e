// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/session_folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "error_sentence.hpp"
#include "graph/agent_layer.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/scene_graph_file.hpp"
#include "temporary_folder.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;
using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

Polygon square(double x0) { return {{{x0, 0}, {x0 + 2, 0}, {x0 + 2, 2}, {x0, 2}}, {}}; }

/// One room on region 3, one that was removed, tracks with a gap, and two chairs seen apart.
SessionState sampleState() {
  SessionState state;
  state.scene = "flat";
  state.stamp_s = 12.5;
  state.T_map_agent.translation() = Eigen::Vector3d(1, 2, 3);
  state.last_room_update_s = 12.25;
  state.tracker.tracks = {{3, 0, square(0)}, {5, 2, square(4)}};
  state.tracker.next_id = 9;
  RoomAttributes room;
  room.name = "room_1";
  room.region_id = 3;
  room.polygon = square(0);
  room.area_m2 = 4.0;
  SceneGraph& graph = state.graph.graph;
  const NodeId id = graph.add({1, 1, 0}, 1.0, room).id;
  room.region_id = 4;
  graph.remove(graph.add({1, 1, 0}, 1.0, room).id);
  state.graph.rooms.first_seen_s = {{3, 0.5}, {5, 1.5}};
  state.graph.rooms.former_room_of_region = {{5, id}};
  state.graph.last_update_s = 12.25;
  state.graph.last_maintenance_s = 11.0;
  const NodeId chair = graph.add({1, 1, 0.5}, 1.0, ObjectAttributes{"chair", 0.9}).id;
  const NodeId other = graph.add({1.2, 1, 0.5}, 1.0, ObjectAttributes{"chair", 0.9}).id;
  state.graph.objects.seen_apart = {{{chair, other}, 7}};
  state.graph.objects.free_checks = {{other, 2}};
  state.graph.objects.last_checked = chair;
  return state;
}

class SessionFolder : public ::testing::Test {
 protected:
  SessionFolder() : map_(OccupancyMapConfig{}) {
    testing::insertSlice(map_, {"..#", ".#.", "###"});
  }
  void save(const SessionState& state = sampleState()) const {
    saveSession(path_, map_.tree(), state);
  }
  [[nodiscard]] std::string refusal() const {
    return sentenceOf([&] { (void)loadSession(path_, OccupancyMapConfig{}); });
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.at("kept/session");
  OccupancyMap map_;
};

TEST_F(SessionFolder, BringsBackAllThatWasSaved) {
  save();
  const Session session = loadSession(path_, OccupancyMapConfig{});
  const SessionState expected = sampleState();
  const SessionState& state = session.state;
  EXPECT_EQ(state.scene, "flat");
  EXPECT_EQ(state.stamp_s, 12.5);
  EXPECT_TRUE(state.T_map_agent.isApprox(expected.T_map_agent));
  EXPECT_EQ(state.last_room_update_s, 12.25);
  ASSERT_EQ(state.tracker.tracks.size(), 2U);
  EXPECT_EQ(state.tracker.tracks[1].id, 5);
  EXPECT_EQ(state.tracker.tracks[1].missed_updates, 2);
  EXPECT_EQ(state.tracker.tracks[1].polygon.outer, square(4).outer);
  EXPECT_EQ(state.tracker.next_id, 9);
  EXPECT_EQ(state.graph.rooms.first_seen_s, expected.graph.rooms.first_seen_s);
  EXPECT_EQ(state.graph.rooms.former_room_of_region, expected.graph.rooms.former_room_of_region);
  EXPECT_EQ(state.graph.last_update_s, 12.25);
  EXPECT_EQ(state.graph.last_maintenance_s, 11.0);
  EXPECT_EQ(state.graph.objects.seen_apart, expected.graph.objects.seen_apart);
  EXPECT_EQ(state.graph.objects.free_checks, expected.graph.objects.free_checks);
  EXPECT_EQ(state.graph.objects.last_checked, expected.graph.objects.last_checked);
  EXPECT_EQ(toJson(state.graph.graph, ""), toJson(expected.graph.graph, ""));
  EXPECT_EQ(toOctomap(session.map.value().tree(), OctomapEncoding::kFull),
            toOctomap(map_.tree(), OctomapEncoding::kFull));
}

TEST_F(SessionFolder, OneFromBeforeTheEvidenceOnObjectsWasSavedLoadsWithoutIt) {
  save();
  const std::string name = "kept/session/session.json";
  const std::string bytes = folder_.read(name);
  const std::size_t evidence = bytes.find(",\n\"objects_seen_apart\"");
  ASSERT_NE(evidence, std::string::npos) << bytes;
  folder_.write(name, bytes.substr(0, evidence) + "\n}\n");
  const Session session = loadSession(path_, OccupancyMapConfig{});
  EXPECT_TRUE(session.state.graph.objects.seen_apart.empty());
  EXPECT_TRUE(session.state.graph.objects.free_checks.empty());
  EXPECT_EQ(session.state.graph.rooms.first_seen_s, sampleState().graph.rooms.first_seen_s);
}

TEST_F(SessionFolder, OneWithoutAMapSaysSoAndHoldsTheRest) {
  save();
  saveSession(path_, sampleState());
  EXPECT_FALSE(fs::exists(fs::path(path_) / "map.ot"));
  const Session session = loadSession(path_, OccupancyMapConfig{});
  EXPECT_FALSE(session.map.has_value());
  EXPECT_EQ(toJson(session.state.graph.graph, ""), toJson(sampleState().graph.graph, ""));
}

TEST_F(SessionFolder, IdsOfRemovedNodesStayUsed) {
  save();
  const Session session = loadSession(path_, OccupancyMapConfig{});
  EXPECT_EQ(session.state.graph.graph.nextId(NodeType::kRoom), firstId(NodeType::kRoom) + 2);
}

// Every file of a session grows to a limit at which the writer is killed: at the kernel's hand,
// without a word, as by SIGKILL or a power cut.
TEST_F(SessionFolder, FailureMode14WriterKilledAtAnyWriteLeavesTheOldSessionOrTheNew) {
  save();
  SessionState second = sampleState();
  second.stamp_s = 99.0;
  std::size_t killed = 0;
  bool completed = false;
  for (rlim_t limit = 0; !completed; limit += 50) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const rlimit file_size{limit, limit};
      ::signal(SIGXFSZ, SIG_DFL);
      ::setrlimit(RLIMIT_FSIZE, &file_size);
      save(second);
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    completed = WIFEXITED(status);
    killed += WIFSIGNALED(status) ? 1 : 0;
    const Session session = loadSession(path_, OccupancyMapConfig{});
    EXPECT_EQ(session.state.stamp_s, completed ? 99.0 : 12.5) << "killed at byte " << limit;
  }
  EXPECT_GT(killed, 10U);
}

TEST_F(SessionFolder, ReplacesASessionAndLeavesNothingBeside) {
  save();
  SessionState second = sampleState();
  second.stamp_s = 99.0;
  save(second);
  EXPECT_EQ(loadSession(path_, OccupancyMapConfig{}).state.stamp_s, 99.0);
  const fs::directory_iterator entries(folder_.at("kept"));
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST_F(SessionFolder, LeavesOtherFoldersAndFilesAlone) {
  folder_.write("kept/session/thesis.txt", "years of work");
  EXPECT_TRUE(tells(sentenceOf([&] { save(); }), {"something else than a session"}));
  EXPECT_EQ(folder_.read("kept/session/thesis.txt"), "years of work");
  folder_.write("kept/file", "x");
  EXPECT_TRUE(
      tells(sentenceOf([&] { checkSessionPlace(folder_.at("kept/file")); }), {"is a file"}));
  EXPECT_TRUE(tells(sentenceOf([&] { checkSessionPlace("/"); }), {"no name for a session"}));
}

// A month of driving at 0.4 m/s: a million agents are offered.
TEST_F(SessionFolder, SessionOfAMonthOfDrivingIsSavedAndRead) {
  SessionState state = sampleState();
  AgentLayer agents(AgentLayerConfig{});
  Pose pose = Pose::Identity();
  constexpr int kOffered = 1'000'000;
  for (int i = 0; i < kOffered; ++i) {
    pose.translation() = Eigen::Vector3d(0.5 * (i % 401), 0.5 * (i / 401 % 97), 1.2);
    agents.observe(state.graph.graph, pose, 13.0 + 2.6 * i);
  }
  EXPECT_EQ(state.graph.graph.nextId(NodeType::kAgent), kFurtherAgents);
  save(state);
  const std::size_t kept = state.graph.graph.nodes(NodeType::kAgent).size();
  EXPECT_LE(kept, 20'000U);
  EXPECT_GT(kept, 1000U);
  EXPECT_LT(fs::file_size(fs::path(path_) / "scene_graph.json"), 10'000'000U);
  const Session session = loadSession(path_, OccupancyMapConfig{});
  EXPECT_EQ(session.state.graph.graph.nodes(NodeType::kAgent).size(), kept);
  EXPECT_EQ(session.state.graph.graph.nextId(NodeType::kAgent), kFurtherAgents);
}

TEST_F(SessionFolder, WhatNoReaderWouldTakeIsNotSaved) {
  save();
  SessionState state = sampleState();
  RoomAttributes room;
  room.region_id = 77;
  room.polygon.outer.assign(kMaxGraphVertices + 1, {1.0, 2.0});
  state.graph.graph.add({1, 1, 0}, 1.0, room);
  EXPECT_TRUE(tells(sentenceOf([&] { save(state); }),
                    {"vertices of rooms", "at most 500000 can be read back"}));
  EXPECT_EQ(loadSession(path_, OccupancyMapConfig{}).state.stamp_s, 12.5);
}

TEST_F(SessionFolder, SaveThatFailsLeavesTheOldSession) {
  save();
  SessionState broken = sampleState();
  broken.stamp_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(tells(sentenceOf([&] { save(broken); }), {"not finite"}));
  EXPECT_EQ(loadSession(path_, OccupancyMapConfig{}).state.stamp_s, 12.5);
}

TEST_F(SessionFolder, MissingPartsAreNamed) {
  EXPECT_TRUE(tells(refusal(), {"session.json", "does not exist"}));
  for (const std::string part : {"map.ot", "scene_graph.json", "session.json"}) {
    save();
    fs::remove(fs::path(path_) / part);
    EXPECT_TRUE(tells(refusal(), {part, "does not exist"}));
    fs::remove_all(path_);
  }
}

TEST_F(SessionFolder, FailureMode17AnyChangedByteOfAPartIsNoticed) {
  constexpr unsigned kSeed = 8;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  save();
  for (const std::string part : {"map.ot", "scene_graph.json"}) {
    const std::string name = "kept/session/" + part;
    const std::string bytes = folder_.read(name);
    for (int i = 0; i < 50; ++i) {
      std::string changed = bytes;
      char& byte = changed[random() % changed.size()];
      byte = static_cast<char>(byte ^ (1U << (random() % 8)));
      folder_.write(name, changed);
      EXPECT_TRUE(tells(refusal(), {part, "not what the session was saved with"}));
    }
    folder_.write(name, bytes.substr(0, bytes.size() / 2));
    EXPECT_TRUE(tells(refusal(), {part, "bytes long"}));
    folder_.write(name, bytes);
  }
}

TEST_F(SessionFolder, FailureMode17EveryTruncationOfTheIndexIsRefused) {
  save();
  const std::string bytes = folder_.read("kept/session/session.json");
  for (std::size_t length = 0; length + 2 < bytes.size(); length += 3) {
    folder_.write("kept/session/session.json", bytes.substr(0, length));
    EXPECT_TRUE(tells(refusal(), {"session.json"})) << length;
  }
}

TEST_F(SessionFolder, ValuesThatCannotBeAreNamed) {
  const std::vector<std::vector<std::string>> cases = {
      {"\"version\": 1", "\"version\": 3", "version 3"},
      {"\"next_region_id\": 9", "\"next_region_id\": 5", "region 5"},
      {"[[5,4000000]]", "[[5,4000001]]", "names room 4000001"},
      {"\"ROOM\":4000002", "\"ROOM\":7", "7 is no id of type ROOM"},
      {"[1000000,1000001,7]", "[1000000,1000002,7]", "names object 1000002"},
      {"[1000000,1000001,7]", "[1000001,1000000,7]", "the smaller id comes first"},
      {"[1000000,1000001,7]", "[1000000,1000001,0]", "objects_seen_apart: has a count of 0"},
      {"[1000000,1000001,7]", "[1000000,1000001]", "no triple"},
      {"[[1000001,2]]", "[[4000000,2]]", "names object 4000000"},
      {"[[1000001,2]]", "[[1000001,-1]]", "object_free_checks: has a count of -1"},
      {"\"stamp_s\": 12.5", "\"stamp_s\": null", "stamp_s"},
      {"0.0,0.0,0.0,1.0]", "0.0,0.0,0.0,0.0]", "unit quaternion"}};
  save();
  const std::string bytes = folder_.read("kept/session/session.json");
  for (const auto& spoilt : cases) {
    std::string changed = bytes;
    ASSERT_NE(changed.find(spoilt[0]), std::string::npos) << spoilt[0] << " in " << bytes;
    changed.replace(changed.find(spoilt[0]), spoilt[0].size(), spoilt[1]);
    folder_.write("kept/session/session.json", changed);
    EXPECT_TRUE(tells(refusal(), {"session.json", spoilt[2]}));
  }
}

}  // namespace
}  // namespace occusg
