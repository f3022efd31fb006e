// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/change_log.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {
namespace {

using Ids = std::vector<NodeId>;
using Edges = std::vector<EdgeKey>;

NodeId objectAt(SceneGraph& graph, double x) {
  return graph.add({x, 0.0, 0.0}, 1.0, ObjectAttributes{"chair", 0.5}).id;
}

TEST(ChangeLog, TellsWhatWasAddedChangedAndRemovedSinceARevision) {
  SceneGraph graph;
  const NodeId kept = objectAt(graph, 0.0);
  const NodeId gone = objectAt(graph, 1.0);
  const Revision before = graph.revision();
  const NodeId fresh = objectAt(graph, 2.0);
  graph.update(graph.at(kept));
  graph.remove(gone);
  const GraphChanges changes = graph.changesSince(before);
  EXPECT_TRUE(changes.complete);
  EXPECT_EQ(changes.added_nodes, Ids{fresh});
  EXPECT_EQ(changes.changed_nodes, Ids{kept});
  EXPECT_EQ(changes.removed_nodes, Ids{gone});
  EXPECT_TRUE(graph.changesSince(graph.revision()).added_nodes.empty());
}

TEST(ChangeLog, WhatCameAndWentAgainIsNoChange) {
  SceneGraph graph;
  const Revision before = graph.revision();
  const NodeId object = objectAt(graph, 0.0);
  graph.update(graph.at(object));
  graph.remove(object);
  const GraphChanges changes = graph.changesSince(before);
  EXPECT_TRUE(changes.added_nodes.empty());
  EXPECT_TRUE(changes.changed_nodes.empty());
  EXPECT_TRUE(changes.removed_nodes.empty());
}

TEST(ChangeLog, FollowsEdgesAndThoseThatGoWithANode) {
  SceneGraph graph;
  const NodeId room = graph.add({0, 0, 0}, 1.0, RoomAttributes{}).id;
  const NodeId other_room = graph.add({0, 0, 0}, 1.0, RoomAttributes{}).id;
  const NodeId object = objectAt(graph, 0.0);
  graph.connect({EdgeType::kContains, room, object, {}});
  const Revision before = graph.revision();
  graph.connect({EdgeType::kContains, other_room, object, {}});
  GraphChanges changes = graph.changesSince(before);
  EXPECT_EQ(changes.added_edges, (Edges{{EdgeType::kContains, other_room, object}}));
  EXPECT_EQ(changes.removed_edges, (Edges{{EdgeType::kContains, room, object}}));

  const Revision later = graph.revision();
  graph.connect({EdgeType::kContains, other_room, object, {}});
  EXPECT_EQ(graph.changesSince(later).changed_edges.size(), 1U);
  graph.remove(object);
  changes = graph.changesSince(later);
  EXPECT_EQ(changes.removed_edges, (Edges{{EdgeType::kContains, other_room, object}}));
  EXPECT_FALSE(graph.disconnect(EdgeType::kContains, room, object));
}

TEST(ChangeLog, KnowsTheRevisionOfAStamp) {
  SceneGraph graph;
  graph.setStamp(1.0);
  objectAt(graph, 0.0);
  graph.setStamp(3.0);
  const NodeId late = objectAt(graph, 1.0);
  graph.setStamp(2.0);
  const NodeId later = objectAt(graph, 2.0);
  EXPECT_EQ(graph.revisionAt(0.5), 0U);
  EXPECT_EQ(graph.revisionAt(1.0), 1U);
  EXPECT_EQ(graph.changesSince(graph.revisionAt(2.5)).added_nodes, (Ids{late, later}))
      << "the stamp of changes does not go back";
  EXPECT_EQ(graph.revisionAt(3.0), 3U);
  EXPECT_THROW(graph.setStamp(std::numeric_limits<double>::quiet_NaN()), Error);
}

TEST(ChangeLog, ForgetsTheOldestAndSaysSo) {
  SceneGraph graph;
  const NodeId object = objectAt(graph, 0.0);
  for (std::size_t i = 0; i < ChangeLog::kCapacity; ++i) graph.update(graph.at(object));
  EXPECT_FALSE(graph.changesSince(0).complete);
  EXPECT_TRUE(graph.changesSince(1).complete);
  EXPECT_EQ(graph.changesSince(1).changed_nodes, Ids{object});
  EXPECT_FALSE(graph.changesSince(graph.revision() + 1).complete) << "of another graph";
}

TEST(SceneGraph, FindsNodesByPlace) {
  SceneGraph graph;
  const NodeId near = objectAt(graph, 1.0);
  const NodeId far = objectAt(graph, 5.0);
  graph.add({1.1, 0.0, 0.0}, 1.0, AgentAttributes{});
  EXPECT_EQ(graph.nearest(NodeType::kObject, {0.0, 0.0}, 9.0), near);
  EXPECT_EQ(graph.nearest(NodeType::kObject, {0.0, 0.0}, 9.0,
                          [&](const Node& node) { return node.id != near; }),
            far);
  EXPECT_EQ(graph.withinRadius(NodeType::kObject, {4.0, 0.0}, 3.0), (Ids{far, near}));
  EXPECT_EQ(graph.inBox(NodeType::kObject, {{0.0, -1.0}, {2.0, 1.0}}), Ids{near});

  Node moved = graph.at(near);
  moved.position.x() = 20.0;
  graph.update(moved);
  EXPECT_EQ(graph.nearest(NodeType::kObject, {0.0, 0.0}, 9.0), far);
  graph.remove(far);
  EXPECT_EQ(graph.nearest(NodeType::kObject, {0.0, 0.0}, 9.0), std::nullopt);
}

TEST(SceneGraph, ACopyStandsAlone) {
  SceneGraph graph;
  const NodeId object = objectAt(graph, 1.0);
  const SceneGraph copy = graph;
  graph.remove(object);
  EXPECT_EQ(graph.find(object), nullptr);
  ASSERT_NE(copy.find(object), nullptr);
  EXPECT_EQ(copy.find(object), &copy.nodes(NodeType::kObject).at(object));
  SceneGraph moved = std::move(graph);
  moved = copy;
  EXPECT_EQ(moved.find(object), &moved.nodes(NodeType::kObject).at(object));
  EXPECT_EQ(moved.nearest(NodeType::kObject, {0.0, 0.0}, 2.0), object);
}

TEST(SceneGraph, KeepsTheFloorOfANode) {
  SceneGraph graph;
  EXPECT_EQ(graph.add({0, 0, 0}, 1.0, ObjectAttributes{}).floor_id, 0);
  EXPECT_EQ(graph.add({0, 0, 0}, 1.0, ObjectAttributes{}, -1).floor_id, -1);
}

}  // namespace
}  // namespace occusg
