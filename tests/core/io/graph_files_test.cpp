// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "error_sentence.hpp"
#include "io/rooms_geojson.hpp"
#include "io/spark_dsg_file.hpp"
#include "occusg/io/scene_graph_file.hpp"

namespace occusg {
namespace {

using nlohmann::json;
using testing::sentenceOf;
using testing::tells;

RoomAttributes roomFrom(double x0, const std::string& name, int region_id) {
  RoomAttributes room;
  room.name = name;
  room.region_id = region_id;
  room.polygon.outer = {{x0, 0}, {x0 + 4, 0}, {x0 + 4, 3}, {x0, 3}};
  room.polygon.holes = {{{x0 + 1, 1}, {x0 + 1, 2}, {x0 + 2, 2}, {x0 + 2, 1}}};
  room.area_m2 = 11.0;
  room.label = "kitchen";
  room.reason = RoomReason::kVisited;
  return room;
}

Edge edge(EdgeType type, NodeId source, NodeId target, std::vector<Segment2> crossings = {}) {
  return {type, source, target, std::move(crossings)};
}

/// Two rooms with a passage, two agents, an object in a room and one outside, two places, a door.
SceneGraph sampleGraph() {
  SceneGraph graph;
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(1, 2, 1.23456);
  const NodeId agent = graph.add(pose.translation(), 1.5, AgentAttributes{pose}).id;
  const NodeId next_agent = graph.add({2, 2, 1}, 2.5, AgentAttributes{pose}).id;
  const NodeId left = graph.add({2, 1.5, 0}, 3.0, roomFrom(0, "room_1", 7)).id;
  RoomAttributes missing = roomFrom(4, "room_2", 9);
  missing.unsupported_since_s = 4.25;
  const NodeId right = graph.add({6, 1.5, 0}, 3.0, missing).id;
  const NodeId chair = graph.add({1, 1, 0.5}, 4.0, ObjectAttributes{"chair", 0.9}).id;
  const NodeId lamp = graph.add({20, 1, 0.5}, 4.0, ObjectAttributes{"lamp", 0.7}).id;
  const NodeId place = graph.add({1, 1, 0}, 4.0, NavigationAttributes{{1, -1}, 100}).id;
  const NodeId next_place = graph.add({5, 1, 0}, 4.0, NavigationAttributes{{5, 1}, 90}).id;
  graph.add({4, 1.5, 0}, 4.0, DoorAttributes{{{4, 1}, {4, 2}}});
  graph.connect(edge(EdgeType::kTemporal, agent, next_agent));
  for (const NodeId member : {agent, next_agent, chair, place})
    graph.connect(edge(EdgeType::kContains, left, member));
  graph.connect(edge(EdgeType::kContains, right, next_place));
  graph.connect(edge(EdgeType::kTraversable, place, next_place));
  graph.connect(edge(EdgeType::kNearestFreeSpace, chair, place));
  graph.connect(edge(EdgeType::kNearestFreeSpace, lamp, next_place));
  graph.connect(edge(EdgeType::kRoomAdjacency, left, right, {{{4, 1}, {4, 2}}}));
  return graph;
}

json nodeOf(const json& document, std::int64_t id) {
  for (const json& node : document["nodes"])
    if (node["id"] == id) return node;
  return nullptr;
}

TEST(SceneGraphFile, HoldsEveryNodeAndEdgeInOrder) {
  const json document = json::parse(toJson(sampleGraph(), "flat", "world"));
  EXPECT_EQ(document["format"], "occusg-scene-graph");
  EXPECT_EQ(document["version"], 1);
  EXPECT_EQ(document["scene"], "flat");
  EXPECT_EQ(document["frame"], "world");
  ASSERT_EQ(document["nodes"].size(), 9U);
  for (std::size_t i = 1; i < 9; ++i)
    EXPECT_LT(document["nodes"][i - 1]["id"], document["nodes"][i]["id"]);
  ASSERT_EQ(document["edges"].size(), 10U);
  EXPECT_EQ(document["edges"][0],
            json::parse(R"({"type": "TEMPORAL_LINK", "source": 0, "target": 1})"));
  EXPECT_EQ(document["edges"][9], json::parse(R"({"type": "ROOM_ADJACENCY", "source": 4000000,
            "target": 4000001, "crossings": [[[4.0, 1.0], [4.0, 2.0]]]})"));
}

TEST(SceneGraphFile, NodesCarryWhatTheirTypeHas) {
  const json document = json::parse(toJson(sampleGraph(), "flat"));
  EXPECT_EQ(nodeOf(document, 0), json::parse(R"({"id": 0, "type": "AGENT", "created_s": 1.5,
    "last_seen_s": 1.5, "floor_id": 0, "position": [1.0, 2.0, 1.2346],
    "orientation": [0.0, 0.0, 0.707107, 0.707107]})"));
  const json object = nodeOf(document, 1'000'000);
  EXPECT_EQ(object["class"], "chair");
  EXPECT_EQ(object["score"], 0.9);
  const json place = nodeOf(document, 2'000'000);
  EXPECT_EQ(place["block"], json::array({1, -1}));
  EXPECT_EQ(place["free_cells"], 100);
  const json room = nodeOf(document, 4'000'001);
  EXPECT_EQ(room["name"], "room_2");
  EXPECT_EQ(room["label"], "kitchen");
  EXPECT_EQ(room["region_id"], 9);
  EXPECT_EQ(room["reason"], "visited");
  EXPECT_EQ(room["area_m2"], 11.0);
  EXPECT_EQ(room["polygon"][0], json::array({4.0, 0.0}));
  EXPECT_EQ(room["holes"].size(), 1U);
  EXPECT_EQ(room["unsupported_since_s"], 4.25);
  EXPECT_EQ(nodeOf(document, 4'000'000).count("unsupported_since_s"), 0U);
  EXPECT_EQ(nodeOf(document, 5'000'000)["segment"][1], json::array({4.0, 2.0}));
}

TEST(SceneGraphFile, ReasonsHaveNames) {
  const std::vector<std::pair<RoomReason, std::string>> names = {
      {RoomReason::kBootstrap, "bootstrap"},
      {RoomReason::kVisited, "visited"},
      {RoomReason::kPromoted, "promoted"}};
  for (const auto& [reason, name] : names) {
    SceneGraph graph;
    RoomAttributes room;
    room.reason = reason;
    graph.add({0, 0, 0}, 0.0, room);
    EXPECT_EQ(json::parse(toJson(graph, ""))["nodes"][0]["reason"], name);
  }
}

TEST(SceneGraphFile, EqualRotationsGiveEqualBytes) {
  SceneGraph graph;
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(4.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
  graph.add({0, 0, 0}, 0.0, AgentAttributes{pose});
  EXPECT_GE(json::parse(toJson(graph, ""))["nodes"][0]["orientation"][3].get<double>(), 0.0);
}

TEST(SceneGraphFile, EqualGraphsGiveEqualBytes) {
  EXPECT_EQ(toJson(sampleGraph(), "flat"), toJson(sampleGraph(), "flat"));
  EXPECT_EQ(toSparkDsg(sampleGraph(), "flat"), toSparkDsg(sampleGraph(), "flat"));
}

TEST(SceneGraphFile, EmptyGraphIsStillComplete) {
  const json document = json::parse(toJson(SceneGraph{}, ""));
  EXPECT_TRUE(document["nodes"].is_array() && document["nodes"].empty());
  EXPECT_TRUE(document["edges"].is_array() && document["edges"].empty());
}

TEST(SceneGraphFile, PolygonThatIsNotFiniteIsNotWritten) {
  SceneGraph graph;
  graph.add({0, 0, 0}, 0.0, roomFrom(std::nan(""), "room_1", 1));
  EXPECT_TRUE(tells(sentenceOf([&] { (void)toJson(graph, ""); }), {"not finite"}));
  EXPECT_TRUE(tells(sentenceOf([&] { (void)toSparkDsg(graph, ""); }), {"not finite"}));
}

TEST(SceneGraphFile, RoomsBecomeARoomsFile) {
  const RoomsFile rooms = roomsOf(sampleGraph(), "flat", 0.25);
  EXPECT_EQ(rooms.scene, "flat");
  EXPECT_EQ(rooms.floor_z_m, 0.25);
  ASSERT_EQ(rooms.rooms.size(), 2U);
  EXPECT_EQ(rooms.rooms[1].id, 2);
  EXPECT_EQ(rooms.rooms[1].label, "kitchen");
  EXPECT_EQ(area(rooms.rooms[1].polygon), 11.0);
  ASSERT_EQ(rooms.doors.size(), 1U);
  EXPECT_EQ(rooms.doors[0].room_a, 1);
  EXPECT_EQ(rooms.doors[0].room_b, 2);
  EXPECT_EQ(rooms.doors[0].segment.a, (Point2{4, 1}));
}

TEST(RoomsGeoJson, RoomsArePolygonsAndDoorsAreLines) {
  const json document = json::parse(toGeoJson(roomsOf(sampleGraph(), "flat", 0.0)));
  EXPECT_EQ(document["type"], "FeatureCollection");
  EXPECT_EQ(document["name"], "flat");
  EXPECT_EQ(document.count("crs"), 0U);
  EXPECT_TRUE(tells(document["note"].get<std::string>(), {"metres", "\"map\""}));
  ASSERT_EQ(document["features"].size(), 3U);
  EXPECT_EQ(document["features"][0], json::parse(R"({"type": "Feature",
    "properties": {"kind": "room", "id": 1, "label": "kitchen", "area_m2": 11.0},
    "geometry": {"type": "Polygon", "coordinates": [
      [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0], [0.0, 0.0]],
      [[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0], [1.0, 1.0]]]}})"));
  EXPECT_EQ(document["features"][2], json::parse(R"({"type": "Feature",
    "properties": {"kind": "door", "rooms": [1, 2]},
    "geometry": {"type": "LineString", "coordinates": [[4.0, 1.0], [4.0, 2.0]]}})"));
}

TEST(RoomsGeoJson, NoRoomsIsAnEmptyCollection) {
  const json document = json::parse(toGeoJson(RoomsFile{}));
  EXPECT_TRUE(document["features"].is_array() && document["features"].empty());
}

constexpr std::uint64_t symbol(char prefix, std::uint64_t number) {
  return (static_cast<std::uint64_t>(static_cast<unsigned char>(prefix)) << 56U) | number;
}

/// Layer, partition and attribute type of each node, by symbol.
std::map<std::uint64_t, json> dsgNodes(const json& document) {
  std::map<std::uint64_t, json> nodes;
  for (const json& node : document["nodes"]) nodes[node["id"].get<std::uint64_t>()] = node;
  return nodes;
}

TEST(SparkDsgFile, NodesAreInTheLayersSparkDsgKnows) {
  const json document = json::parse(toSparkDsg(sampleGraph(), "flat"));
  const auto nodes = dsgNodes(document);
  ASSERT_EQ(nodes.size(), 8U) << "all but the door";
  const std::vector<std::tuple<std::uint64_t, int, int, const char*>> expected = {
      {symbol('a', 1), 2, 'a', "AgentNodeAttributes"},
      {symbol('O', 0), 2, 0, "ObjectNodeAttributes"},
      {symbol('p', 1), 3, 0, "PlaceNodeAttributes"},
      {symbol('R', 0), 4, 0, "RoomNodeAttributes"}};
  for (const auto& [id, layer, partition, type] : expected) {
    SCOPED_TRACE(type);
    ASSERT_EQ(nodes.count(id), 1U);
    EXPECT_EQ(nodes.at(id)["layer"], layer);
    EXPECT_EQ(nodes.at(id)["partition"], partition);
    EXPECT_EQ(nodes.at(id)["attributes"]["type"], type);
    const json key = {{"layer", layer}, {"partition", partition}};
    const json& keys = document["layer_keys"];
    EXPECT_NE(std::find(keys.begin(), keys.end(), key), keys.end());
  }
}

TEST(SparkDsgFile, HeaderAndNamesAreThoseOfVersionOneOne) {
  const json document = json::parse(toSparkDsg(sampleGraph(), "flat", "world"));
  EXPECT_EQ(document["SPARK_DSG_header"]["version"],
            json::parse(R"({"major": 1, "minor": 1, "patch": 3})"));
  EXPECT_EQ(document["layer_names"]["ROOMS"], json::parse(R"({"layer": 4, "partition": 0})"));
  EXPECT_EQ(document["layer_names"]["AGENTS"], json::parse(R"({"layer": 2, "partition": 97})"));
  EXPECT_EQ(document["metadata"], json::parse(R"({"scene": "flat", "frame": "world"})"));
}

TEST(SparkDsgFile, RoomHasNameBoxPolygonAndColour) {
  const auto nodes = dsgNodes(json::parse(toSparkDsg(sampleGraph(), "flat")));
  const json& room = nodes.at(symbol('R', 1))["attributes"];
  EXPECT_EQ(room["name"], "room_2");
  EXPECT_EQ(room["position"], json::array({6.0, 1.5, 0.0}));
  EXPECT_EQ(room["bounding_box"]["type"], "AABB");
  EXPECT_EQ(room["bounding_box"]["world_P_center"], json::array({6.0, 1.5, 0.0}));
  EXPECT_EQ(room["bounding_box"]["dimensions"], json::array({4.0, 3.0, 0.0}));
  EXPECT_EQ(room["metadata"]["polygon"].size(), 4U);
  EXPECT_EQ(room["metadata"]["holes"].size(), 1U);
  EXPECT_EQ(room["metadata"]["label"], "kitchen");
  EXPECT_EQ(room["metadata"]["region_id"], 9);
  EXPECT_EQ(room["last_update_time_ns"], 3'000'000'000);
  EXPECT_NE(room["color"], nodes.at(symbol('R', 0))["attributes"]["color"]);
}

TEST(SparkDsgFile, RoomWithoutPolygonHasNoBox) {
  SceneGraph graph;
  graph.add({0, 0, 0}, -5.0, RoomAttributes{});
  const json node = json::parse(toSparkDsg(graph, ""))["nodes"][0]["attributes"];
  EXPECT_EQ(node["bounding_box"]["type"], "INVALID");
  EXPECT_EQ(node["last_update_time_ns"], 0) << "stamps before zero have no place there";
}

TEST(SparkDsgFile, EveryMemberHasOneParent) {
  const json document = json::parse(toSparkDsg(sampleGraph(), "flat"));
  std::map<std::uint64_t, std::vector<std::uint64_t>> parents;
  const auto nodes = dsgNodes(document);
  for (const json& edge : document["edges"]) {
    auto source = edge["source"].get<std::uint64_t>();
    auto target = edge["target"].get<std::uint64_t>();
    if (nodes.at(source)["layer"] < nodes.at(target)["layer"]) std::swap(source, target);
    if (nodes.at(source)["layer"] != nodes.at(target)["layer"]) parents[target].push_back(source);
  }
  const std::map<std::uint64_t, std::vector<std::uint64_t>> expected = {
      {symbol('a', 0), {symbol('R', 0)}}, {symbol('a', 1), {symbol('R', 0)}},
      {symbol('p', 0), {symbol('R', 0)}}, {symbol('p', 1), {symbol('R', 1)}},
      {symbol('O', 0), {symbol('R', 0)}}, {symbol('O', 1), {symbol('p', 1)}}};
  EXPECT_EQ(parents, expected);
}

TEST(SparkDsgFile, AdjacentRoomsAreJoinedWithTheirCrossings) {
  const json document = json::parse(toSparkDsg(sampleGraph(), "flat"));
  ASSERT_EQ(document["edges"].size(), 9U);
  const json& last = document["edges"][8];
  EXPECT_EQ(last["source"].get<std::uint64_t>(), symbol('R', 0));
  EXPECT_EQ(last["target"].get<std::uint64_t>(), symbol('R', 1));
  EXPECT_EQ(last["info"]["metadata"]["crossings"], json::parse("[[[4.0, 1.0], [4.0, 2.0]]]"));
}

}  // namespace
}  // namespace occusg
