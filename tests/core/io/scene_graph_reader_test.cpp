// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>

#include "error_sentence.hpp"
#include "io/graphml_file.hpp"
#include "io/occusg_1_0_file.hpp"
#include "occusg/io/scene_graph_file.hpp"

namespace occusg {
namespace {

using nlohmann::json;
using testing::sentenceOf;
using testing::tells;

constexpr NodeId kRoom = 4'000'000;

RoomAttributes kitchenFrom(double x0, const std::string& name, int region_id) {
  RoomAttributes room;
  room.name = name;
  room.region_id = region_id;
  room.polygon.outer = {{x0, 0}, {x0 + 4, 0}, {x0 + 4, 3}, {x0, 3}};
  room.polygon.holes = {{{x0 + 1, 1}, {x0 + 1, 2}, {x0 + 2, 2}, {x0 + 2, 1}}};
  room.area_m2 = 11.0;
  room.reason = RoomReason::kVisited;
  return room;
}

/// Every type of node and edge, every optional member, and ids with a gap.
SceneGraph fullGraph() {
  SceneGraph graph;
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(1, 2, 1.25);
  const NodeId agent = graph.add(pose.translation(), 1.5, AgentAttributes{pose}).id;
  const NodeId next_agent = graph.add(pose.translation(), 2.5, AgentAttributes{pose}).id;
  RoomAttributes labelled = kitchenFrom(0, "room_1", 7);
  labelled.state = RoomState::kPartial;
  labelled.frontier_share = 0.25;
  labelled.label = "<kitchen & \"bath\">";
  labelled.label_score = 1.0;
  labelled.label_source = LabelSource::kPerson;
  const NodeId left = graph.add({2, 1.5, 0}, 3.0, labelled).id;
  const NodeId gone = graph.add({2, 1.5, 0}, 3.0, kitchenFrom(9, "room_2", 8)).id;
  RoomAttributes missing = kitchenFrom(4, "room_3", 9);
  missing.unsupported_since_s = 4.25;
  const NodeId right = graph.add({6, 1.5, 0}, 3.0, missing).id;
  graph.remove(gone);
  ObjectAttributes chair{"chair", 0.9};
  chair.observations = 3;
  chair.box = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 0.5));
  chair.class_histogram = {{"chair", 2.5}, {"sofa", 0.5}};
  const NodeId object = graph.add({1, 1, 0.5}, 4.0, chair).id;
  const NodeId place = graph.add({1, 1, 0}, 4.0, NavigationAttributes{{1, -1}, 100}).id;
  const NodeId next_place = graph.add({5, 1, 0}, 4.0, NavigationAttributes{{5, 1}, 90}).id;
  DoorAttributes door;
  door.segment = {{4, 1}, {4, 2}};
  door.width_m = 1.0;
  door.room_a = left;
  door.room_b = right;
  graph.add({4, 1.5, 0}, 4.0, door);
  graph.connect({EdgeType::kTemporal, agent, next_agent, {}});
  graph.connect({EdgeType::kContains, left, agent, {}});
  graph.connect({EdgeType::kContains, left, object, {}});
  graph.connect({EdgeType::kTraversable, place, next_place, {}});
  graph.connect({EdgeType::kNearestFreeSpace, object, place, {}});
  graph.connect({EdgeType::kRoomAdjacency, left, right, {{{4, 1}, {4, 2}}}});
  return graph;
}

/// The sentence that refuses the full graph's file after `change`.
std::string refusalOf(const std::function<void(json&)>& change) {
  json document = json::parse(toJson(fullGraph(), "flat"));
  change(document);
  return sentenceOf([&] { (void)parseSceneGraph(document.dump(), "graph.json"); });
}

json& nodeOf(json& document, NodeId id) {
  for (json& node : document["nodes"])
    if (node["id"] == id) return node;
  throw std::runtime_error("no such node");
}

TEST(SceneGraphReader, FileReadBackIsWrittenTheSame) {
  const std::string text = toJson(fullGraph(), "flat", "world");
  const SceneGraphFile file = parseSceneGraph(text, "graph.json");
  EXPECT_EQ(file.scene, "flat");
  EXPECT_EQ(file.frame, "world");
  EXPECT_EQ(toJson(file.graph, file.scene, file.frame), text);
  EXPECT_EQ(file.graph.nextId(NodeType::kRoom), kRoom + 3);
}

TEST(SceneGraphReader, OrderOfNodesDoesNotMatter) {
  json document = json::parse(toJson(fullGraph(), "flat"));
  std::reverse(document["nodes"].begin(), document["nodes"].end());
  std::reverse(document["edges"].begin(), document["edges"].end());
  EXPECT_EQ(toJson(parseSceneGraph(document.dump(), "").graph, "flat"),
            toJson(fullGraph(), "flat"));
}

TEST(SceneGraphReader, MembersThatCameLaterMayBeAbsent) {
  json document = json::parse(toJson(fullGraph(), "flat"));
  for (json& node : document["nodes"])
    for (const char* key : {"state", "frontier_share", "label_score", "label_source", "box",
                            "observations", "class_histogram", "width_m", "rooms"})
      node.erase(key);
  const SceneGraph graph = parseSceneGraph(document.dump(), "").graph;
  EXPECT_EQ(graph.room(kRoom).state, RoomState::kConfirmed);
  EXPECT_EQ(graph.nodeCount(), fullGraph().nodeCount());
}

TEST(SceneGraphReader, RefusesAnotherFormatOrVersion) {
  EXPECT_TRUE(tells(refusalOf([](json& d) { d["version"] = 2; }), {"version 2", "version 1"}));
  EXPECT_TRUE(tells(refusalOf([](json& d) { d["format"] = "geojson"; }), {"geojson"}));
  EXPECT_TRUE(tells(refusalOf([](json& d) { d.erase("nodes"); }), {"has no \"nodes\""}));
  EXPECT_TRUE(tells(refusalOf([](json& d) { d = json::array(); }), {"an object is needed"}));
}

TEST(SceneGraphReader, RefusesEdgesWithoutTheirNodesAndCycles) {
  EXPECT_TRUE(tells(refusalOf([](json& d) { d["edges"][0]["target"] = 77; }),
                    {"graph.json: edges[0]", "an end does not exist"}));
  EXPECT_TRUE(
      tells(refusalOf([](json& d) {
              d["edges"].push_back({{"type", "TEMPORAL_LINK"}, {"source", 1}, {"target", 0}});
            }),
            {"edges[6]", "back in time"}));
  EXPECT_TRUE(tells(refusalOf([](json& d) { d["edges"].push_back(d["edges"][0]); }),
                    {"edges[6]", "there already"}));
  EXPECT_TRUE(tells(
      refusalOf([](json& d) {
        d["edges"].push_back({{"type", "ROOM_CONTAINS"}, {"source", kRoom + 2}, {"target", 0}});
      }),
      {"node 0", "second room"}));
  EXPECT_TRUE(tells(refusalOf([](json& d) { d["edges"][1]["target"] = kRoom + 2; }),
                    {"edges[1]", "wrong types"}));
  EXPECT_TRUE(tells(refusalOf([](json& d) { d["edges"][0]["type"] = "FRIEND"; }),
                    {"FRIEND", "ROOM_CONTAINS"}));
}

TEST(SceneGraphReader, RefusesNodesThatCannotBe) {
  const auto spoilt = [](NodeId id, const std::string& key, const json& value) {
    return refusalOf([&](json& d) { nodeOf(d, id)[key] = value; });
  };
  EXPECT_TRUE(tells(spoilt(1, "id", 0), {"node 0", "twice"}));
  EXPECT_TRUE(tells(spoilt(1, "id", kRoom + 9), {"node 4000009", "AGENT"}));
  EXPECT_TRUE(tells(spoilt(kRoom, "id", 5), {"node 5", "ROOM"}));
  EXPECT_TRUE(tells(spoilt(0, "type", "GHOST"), {"node 0 type", "GHOST"}));
  EXPECT_TRUE(tells(spoilt(0, "position", {1, 2}), {"node 0 position", "2 values"}));
  EXPECT_TRUE(tells(spoilt(0, "position", {1, 2, "x"}), {"node 0 position"}));
  EXPECT_TRUE(tells(spoilt(0, "position", {1, 2, 1e9}), {"1e6 m"}));
  EXPECT_TRUE(tells(spoilt(0, "created_s", nullptr), {"created_s", "null"}));
  EXPECT_TRUE(tells(spoilt(0, "orientation", {0, 0, 0, 0}), {"unit quaternion"}));
  EXPECT_TRUE(tells(spoilt(kRoom, "polygon", json::array()), {"polygon", "3 different"}));
  EXPECT_TRUE(tells(spoilt(kRoom, "region_id", 9), {"region 9", "of its own"}));
  EXPECT_TRUE(tells(spoilt(kRoom, "reason", "whim"), {"whim", "bootstrap"}));
  EXPECT_TRUE(tells(spoilt(1'000'000, "box", {1}), {"box"}));
}

TEST(SceneGraphReader, RefusesNumbersJsonDoesNotHave) {
  std::string text = toJson(fullGraph(), "flat");
  text.replace(text.find("\"created_s\":1.5"), 15, "\"created_s\":NaN");
  EXPECT_TRUE(tells(sentenceOf([&] { (void)parseSceneGraph(text, "g"); }), {"g:", "JSON"}));
}

TEST(SceneGraphReader, RefusesAMillionNestedArrays) {
  const std::string text(1'000'000, '[');
  EXPECT_TRUE(tells(sentenceOf([&] { (void)parseSceneGraph(text, "g"); }), {"32 levels"}));
  const std::string closed = "{\"nodes\": " + text + std::string(1'000'000, ']') + "}";
  EXPECT_TRUE(tells(sentenceOf([&] { (void)parseSceneGraph(closed, "g"); }), {"32 levels"}));
}

TEST(SceneGraphReader, EveryTruncationAndManyFlippedBytesAreRefusedOrRead) {
  const std::string text = toJson(fullGraph(), "flat");
  for (std::size_t length = 0; length + 2 < text.size(); length += 7)
    EXPECT_FALSE(sentenceOf([&] { (void)parseSceneGraph(text.substr(0, length), "g"); }).empty());
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  for (int i = 0; i < 500; ++i) {
    std::string flipped = text;
    flipped[random() % flipped.size()] = static_cast<char>(random());
    try {
      EXPECT_LE(parseSceneGraph(flipped, "g").graph.nodeCount(), fullGraph().nodeCount());
    } catch (const Error& error) {
      EXPECT_TRUE(tells(error.what(), {"g"}));
    }
  }
}

TEST(GraphMlFile, EscapesTextAndWritesEachNodeAndEdgeOnce) {
  SceneGraph graph = fullGraph();
  ObjectAttributes odd{std::string("a\x01") + "b\xff", 0.5};
  graph.add({0, 0, 0}, 1.0, odd);
  const std::string text = toGraphMl(graph, "a <b>");
  const auto count = [&](const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(count("<node "), graph.nodeCount());
  EXPECT_EQ(count("<edge "), graph.edgeCount());
  EXPECT_EQ(count("&lt;kitchen &amp; \"bath\"&gt;"), 1U);
  EXPECT_EQ(count("a?b\xEF\xBF\xBD"), 1U);
  EXPECT_EQ(count("a &lt;b&gt;"), 1U);
}

TEST(Occusg10File, HoldsWhatThePublishedScriptsRead) {
  const json document = json::parse(toOccusg10(fullGraph(), "flat"));
  EXPECT_EQ(document["schema_version"], "1.0");
  EXPECT_EQ(document["metadata"]["num_nodes"], 7);
  EXPECT_EQ(document["metadata"]["node_type_counts"]["ROOM"], 2);
  // Navigable paths and adjacency lead both ways.
  EXPECT_EQ(document["metadata"]["num_edges"], 8);
  EXPECT_EQ(document["metadata"]["edge_type_counts"]["ROOM_ADJACENCY"], 2);
  const json& room = document["nodes"][5];
  EXPECT_EQ(room["id"], kRoom);
  EXPECT_EQ(room["layer"], "SEMANTIC");
  EXPECT_EQ(room["attributes"]["polygon"][1], json::parse(R"({"x": 4.0, "y": 0.0})"));
  EXPECT_EQ(room["geometry"]["polygon"], room["attributes"]["polygon"]);
  EXPECT_EQ(room["pose"]["position"]["x"], 2.0);
  EXPECT_EQ(document["nodes"][2]["semantic"]["class_name"], "chair");
}

}  // namespace
}  // namespace occusg
