// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/agent_layer.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "occusg/error.hpp"
#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::poseAt;

TEST(AgentLayer, Row17TenMetresMakeTwentyOneAgentsAndThirtySecondsThreeMore) {
  SceneGraph graph;
  AgentLayer layer(AgentLayerConfig{});
  double stamp_s = 100.0;
  // 0.1 m is no binary fraction, so half a metre is reached only up to rounding.
  for (int step = 0; step <= 100; ++step, stamp_s += 0.1)
    layer.observe(graph, poseAt(0.1 * step, 0.3), stamp_s);
  EXPECT_EQ(graph.nodes(NodeType::kAgent).size(), 21U);
  EXPECT_EQ(graph.edges(EdgeType::kTemporal).size(), 20U);

  stamp_s -= 0.1;
  for (int tick = 1; tick <= 300; ++tick)
    layer.observe(graph, poseAt(10.0, 0.3), stamp_s + 0.1 * tick);
  EXPECT_EQ(graph.nodes(NodeType::kAgent).size(), 24U);
  EXPECT_EQ(graph.edges(EdgeType::kTemporal).size(), 23U);
}

TEST(AgentLayer, SinglePrecisionStepsCountAsWell) {
  SceneGraph graph;
  AgentLayer layer(AgentLayerConfig{});
  for (int step = 0; step <= 100; ++step)
    layer.observe(graph, poseAt(1.0F + 0.1F * static_cast<float>(step), 0.0), 0.1 * step);
  EXPECT_EQ(graph.nodes(NodeType::kAgent).size(), 21U);
}

TEST(AgentLayer, TheFirstPoseIsAlwaysAnAgent) {
  SceneGraph graph;
  AgentLayer layer(AgentLayerConfig{});
  EXPECT_EQ(layer.observe(graph, poseAt(5.0, 5.0, 1.5), 7.0), NodeId{0});
  EXPECT_EQ(graph.at(0).position.z(), 1.5);
  EXPECT_EQ(graph.at(0).created_s, 7.0);
  EXPECT_FALSE(layer.observe(graph, poseAt(5.0, 5.0, 1.5), 7.0));
}

TEST(AgentLayer, ClimbingCountsAsDistance) {
  SceneGraph graph;
  AgentLayer layer(AgentLayerConfig{});
  layer.observe(graph, poseAt(0.0, 0.0, 0.0), 0.0);
  EXPECT_FALSE(layer.observe(graph, poseAt(0.0, 0.0, 0.49), 0.1));
  EXPECT_TRUE(layer.observe(graph, poseAt(0.0, 0.0, 0.5), 0.2));
}

TEST(AgentLayer, TimeGoingBackIsRefusedAndCounted) {
  SceneGraph graph;
  AgentLayer layer(AgentLayerConfig{});
  layer.observe(graph, poseAt(0.0, 0.0), 10.0);
  EXPECT_FALSE(layer.observe(graph, poseAt(5.0, 0.0), 9.9));
  EXPECT_EQ(layer.posesBackInTime(), 1U);
  EXPECT_TRUE(layer.observe(graph, poseAt(5.0, 0.0), 10.0));
  EXPECT_EQ(layer.posesBackInTime(), 1U);
}

TEST(AgentLayer, APoseOrStampThatIsNotFiniteIsAnError) {
  SceneGraph graph;
  AgentLayer layer(AgentLayerConfig{});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(layer.observe(graph, poseAt(nan, 0.0), 0.0), Error);
  EXPECT_THROW(layer.observe(graph, poseAt(0.0, 0.0), nan), Error);
  EXPECT_EQ(graph.nodeCount(), 0U);
}

}  // namespace
}  // namespace occusg
