// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/scene_graph.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

NodeId addAt(SceneGraph& graph, NodeAttributes attributes, double x = 0.0) {
  return graph.add({x, 0.0, 0.0}, 1.0, std::move(attributes)).id;
}

TEST(SceneGraph, IdsAreATypeOffsetAndACounter) {
  SceneGraph graph;
  EXPECT_EQ(addAt(graph, AgentAttributes{}), 0);
  EXPECT_EQ(addAt(graph, AgentAttributes{}), 1);
  EXPECT_EQ(addAt(graph, ObjectAttributes{}), 1'000'000);
  EXPECT_EQ(addAt(graph, NavigationAttributes{}), 2'000'000);
  EXPECT_EQ(addAt(graph, RoomAttributes{}), 4'000'000);
  EXPECT_EQ(addAt(graph, DoorAttributes{}), 5'000'000);
  EXPECT_EQ(graph.nodeCount(), 6U);
}

TEST(SceneGraph, AnIdIsNeverUsedAgain) {
  SceneGraph graph;
  const NodeId first = addAt(graph, RoomAttributes{});
  EXPECT_TRUE(graph.remove(first));
  EXPECT_EQ(addAt(graph, RoomAttributes{}), first + 1);
}

TEST(SceneGraph, KnowsTheTypeOfEveryNode) {
  SceneGraph graph;
  for (const NodeId id : {addAt(graph, AgentAttributes{}), addAt(graph, ObjectAttributes{}),
                          addAt(graph, NavigationAttributes{}), addAt(graph, RoomAttributes{}),
                          addAt(graph, DoorAttributes{})}) {
    const Node& node = graph.at(id);
    EXPECT_EQ(graph.nodes(node.type()).count(id), 1U) << nameOf(node.type());
    EXPECT_GE(id, firstId(node.type()));
  }
}

TEST(SceneGraph, FindsNothingOutsideTheIdsOfATypes) {
  SceneGraph graph;
  EXPECT_EQ(graph.find(-1), nullptr);
  EXPECT_EQ(graph.find(0), nullptr);
  EXPECT_EQ(graph.find(kIdEnd), nullptr);
  EXPECT_FALSE(graph.remove(7));
  EXPECT_THROW((void)graph.at(7), Error);
}

TEST(SceneGraph, UpdateReplacesTheNode) {
  SceneGraph graph;
  Node node = graph.at(addAt(graph, ObjectAttributes{"chair", 0.5}));
  node.position.x() = 3.0;
  node.last_seen_s = 9.0;
  graph.update(node);
  EXPECT_EQ(graph.at(node.id).position.x(), 3.0);
  EXPECT_EQ(graph.at(node.id).created_s, 1.0);
  EXPECT_EQ(graph.at(node.id).last_seen_s, 9.0);
}

TEST(SceneGraph, UpdateRefusesAnUnknownNodeAnotherTypeAndNaN) {
  SceneGraph graph;
  Node node = graph.at(addAt(graph, ObjectAttributes{}));
  Node unknown = node;
  unknown.id += 1;
  EXPECT_THROW(graph.update(unknown), Error);
  Node other_type = node;
  other_type.attributes = RoomAttributes{};
  EXPECT_THROW(graph.update(other_type), Error);
  node.last_seen_s = kNaN;
  EXPECT_THROW(graph.update(node), Error);
}

TEST(SceneGraph, AddRefusesNaN) {
  SceneGraph graph;
  EXPECT_THROW(graph.add({kNaN, 0.0, 0.0}, 0.0, AgentAttributes{}), Error);
  EXPECT_THROW(graph.add({0.0, 0.0, 0.0}, kNaN, AgentAttributes{}), Error);
  EXPECT_EQ(graph.nodeCount(), 0U);
  EXPECT_EQ(graph.nextId(NodeType::kAgent), 0);
}

TEST(SceneGraph, RoomRefusesAnythingElse) {
  SceneGraph graph;
  const NodeId object = addAt(graph, ObjectAttributes{});
  EXPECT_THROW((void)graph.room(object), Error);
  EXPECT_EQ(graph.room(addAt(graph, RoomAttributes{})).label, "unknown");
}

TEST(SceneGraph, RemovingANodeRemovesItsEdges) {
  SceneGraph graph;
  const NodeId room = addAt(graph, RoomAttributes{});
  const NodeId neighbour = addAt(graph, RoomAttributes{});
  const NodeId object = addAt(graph, ObjectAttributes{});
  graph.connect({EdgeType::kContains, room, object, {}});
  graph.connect({EdgeType::kRoomAdjacency, room, neighbour, {}});
  EXPECT_EQ(graph.edgeCount(), 2U);
  EXPECT_TRUE(graph.remove(room));
  EXPECT_EQ(graph.edgeCount(), 0U);
  EXPECT_FALSE(graph.roomOf(object));
  EXPECT_TRUE(graph.targets(EdgeType::kRoomAdjacency, neighbour).empty());
}

TEST(SceneGraph, AMemberIsInOneRoomOnly) {
  SceneGraph graph;
  const NodeId kitchen = addAt(graph, RoomAttributes{});
  const NodeId hall = addAt(graph, RoomAttributes{});
  const NodeId object = addAt(graph, ObjectAttributes{});
  graph.connect({EdgeType::kContains, kitchen, object, {}});
  graph.connect({EdgeType::kContains, hall, object, {}});
  EXPECT_EQ(graph.roomOf(object), hall);
  EXPECT_EQ(graph.edges(EdgeType::kContains).size(), 1U);
  EXPECT_EQ(graph.sources(EdgeType::kContains, object), std::vector<NodeId>{hall});
}

TEST(SceneGraph, AnUndirectedEdgeIsTheSameFromBothEnds) {
  SceneGraph graph;
  const NodeId a = addAt(graph, RoomAttributes{});
  const NodeId b = addAt(graph, RoomAttributes{});
  const NodeId c = addAt(graph, RoomAttributes{});
  graph.connect({EdgeType::kRoomAdjacency, b, a, {}});
  graph.connect({EdgeType::kRoomAdjacency, a, b, {{{0.0, 0.0}, {1.0, 0.0}}}});
  graph.connect({EdgeType::kRoomAdjacency, c, b, {}});
  EXPECT_EQ(graph.edges(EdgeType::kRoomAdjacency).size(), 2U);
  ASSERT_NE(graph.findEdge(EdgeType::kRoomAdjacency, b, a), nullptr);
  EXPECT_EQ(graph.findEdge(EdgeType::kRoomAdjacency, b, a)->crossings.size(), 1U);
  EXPECT_EQ(graph.targets(EdgeType::kRoomAdjacency, b), (std::vector<NodeId>{a, c}));
  EXPECT_EQ(graph.sources(EdgeType::kRoomAdjacency, b), (std::vector<NodeId>{a, c}));
  EXPECT_TRUE(graph.disconnect(EdgeType::kRoomAdjacency, b, a));
  EXPECT_FALSE(graph.disconnect(EdgeType::kRoomAdjacency, a, b));
}

TEST(SceneGraph, ADirectedEdgeLeadsOneWay) {
  SceneGraph graph;
  const NodeId object = addAt(graph, ObjectAttributes{});
  const NodeId block = addAt(graph, NavigationAttributes{});
  graph.connect({EdgeType::kNearestFreeSpace, object, block, {}});
  EXPECT_EQ(graph.targets(EdgeType::kNearestFreeSpace, object), std::vector<NodeId>{block});
  EXPECT_EQ(graph.sources(EdgeType::kNearestFreeSpace, block), std::vector<NodeId>{object});
  EXPECT_TRUE(graph.targets(EdgeType::kNearestFreeSpace, block).empty());
  EXPECT_EQ(graph.findEdge(EdgeType::kNearestFreeSpace, block, object), nullptr);
}

TEST(SceneGraph, ConnectRefusesMissingEndsWrongTypesAndLoops) {
  SceneGraph graph;
  const NodeId old_agent = addAt(graph, AgentAttributes{});
  const NodeId agent = addAt(graph, AgentAttributes{});
  const NodeId room = addAt(graph, RoomAttributes{});
  const NodeId block = addAt(graph, NavigationAttributes{});
  EXPECT_THROW(graph.connect({EdgeType::kTemporal, agent, 17, {}}), Error);
  EXPECT_THROW(graph.connect({EdgeType::kTemporal, agent, room, {}}), Error);
  EXPECT_THROW(graph.connect({EdgeType::kTemporal, agent, old_agent, {}}), Error);
  EXPECT_THROW(graph.connect({EdgeType::kContains, agent, room, {}}), Error);
  EXPECT_THROW(graph.connect({EdgeType::kTraversable, block, room, {}}), Error);
  EXPECT_THROW(graph.connect({EdgeType::kNearestFreeSpace, agent, block, {}}), Error);
  EXPECT_THROW(graph.connect({EdgeType::kRoomAdjacency, room, room, {}}), Error);
  EXPECT_EQ(graph.edgeCount(), 0U);
}

TEST(SceneGraph, ARefusalNamesTheEdgeAndItsEnds) {
  SceneGraph graph;
  const NodeId agent = addAt(graph, AgentAttributes{});
  const NodeId room = addAt(graph, RoomAttributes{});
  try {
    graph.connect({EdgeType::kTemporal, agent, room, {}});
    FAIL() << "a temporal edge to a room was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "scene graph: TEMPORAL_LINK edge from 0 to 4000000 joins nodes of the wrong types; "
              "found AGENT and ROOM");
  }
}

TEST(SceneGraph, ATypeWithoutIdsLeftIsRefused) {
  SceneGraph graph;
  graph.skipIdsBefore(NodeType::kObject, firstId(NodeType::kNavigation) - 1);
  EXPECT_EQ(addAt(graph, ObjectAttributes{}), firstId(NodeType::kNavigation) - 1);
  EXPECT_THROW(addAt(graph, ObjectAttributes{}), Error);
  EXPECT_EQ(addAt(graph, NavigationAttributes{}), firstId(NodeType::kNavigation));
}

TEST(SceneGraph, AgentsGoOnBehindTheIdsOfTheOtherTypes) {
  SceneGraph graph;
  graph.skipIdsBefore(NodeType::kAgent, firstId(NodeType::kObject) - 1);
  const NodeId last = addAt(graph, AgentAttributes{});
  EXPECT_EQ(last, firstId(NodeType::kObject) - 1);
  const NodeId further = addAt(graph, AgentAttributes{});
  EXPECT_EQ(further, kFurtherAgents);
  EXPECT_EQ(typeOfId(further), NodeType::kAgent);
  EXPECT_EQ(graph.nextId(NodeType::kAgent), kFurtherAgents + 1);
  graph.connect({EdgeType::kTemporal, last, further, {}});
  SceneGraph restored;
  restored.restore(graph.at(last));
  restored.restore(graph.at(further));
  restored.skipIdsBefore(NodeType::kAgent, graph.nextId(NodeType::kAgent));
  EXPECT_EQ(restored.nextId(NodeType::kAgent), kFurtherAgents + 1);
  EXPECT_NE(restored.find(further), nullptr);
  EXPECT_TRUE(graph.remove(further));
  EXPECT_EQ(graph.find(further), nullptr);
}

}  // namespace
}  // namespace occusg
