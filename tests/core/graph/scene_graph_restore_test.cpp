// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "error_sentence.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;

constexpr NodeId kFirstRoom = firstId(NodeType::kRoom);

Node roomOf(NodeId id) {
  Node node;
  node.id = id;
  node.attributes = RoomAttributes{};
  return node;
}

TEST(SceneGraphRestore, NodeKeepsItsIdAndTheNextGetsALaterOne) {
  SceneGraph graph;
  EXPECT_EQ(graph.restore(roomOf(kFirstRoom + 4)).id, kFirstRoom + 4);
  EXPECT_EQ(graph.nodes(NodeType::kRoom).size(), 1U);
  EXPECT_EQ(graph.add({0, 0, 0}, 0.0, RoomAttributes{}).id, kFirstRoom + 5);
  EXPECT_EQ(graph.changesSince(0).added_nodes.size(), 2U);
}

TEST(SceneGraphRestore, IdsUsedBeforeOrOfAnotherTypeAreRefused) {
  SceneGraph graph;
  graph.restore(roomOf(kFirstRoom + 4));
  for (const NodeId id : {kFirstRoom + 4, kFirstRoom + 3, firstId(NodeType::kDoor), NodeId{0}})
    EXPECT_TRUE(tells(sentenceOf([&] { graph.restore(roomOf(id)); }), {"no place for ROOM node"}));
  EXPECT_EQ(graph.nodeCount(), 1U);
}

TEST(SceneGraphRestore, SkippedIdsAreNeverGivenOut) {
  SceneGraph graph;
  graph.skipIdsBefore(NodeType::kRoom, kFirstRoom + 7);
  graph.skipIdsBefore(NodeType::kRoom, kFirstRoom + 2);
  EXPECT_EQ(graph.nextId(NodeType::kRoom), kFirstRoom + 7);
  EXPECT_TRUE(tells(sentenceOf([&] { graph.skipIdsBefore(NodeType::kRoom, 3); }),
                    {"3 is no id of type ROOM"}));
}

}  // namespace
}  // namespace occusg
