// SPDX-License-Identifier: BSD-3-Clause
#include "graph/agent_layer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "occusg/error.hpp"
#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::poseAt;

TEST(AgentLayer, TenMetresMakeTwentyOneAgentsAndThirtySecondsThreeMore) {
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

/// A robot that goes round a circle of 40 places, a step a second.
Pose roundTheCircle(int step) {
  const double angle = 2.0 * M_PI * (step % 40) / 40.0;
  return poseAt(6.4 * std::cos(angle), 6.4 * std::sin(angle));
}

TEST(AgentLayer, OfOldAgentsTheLastAtEachPlaceStaysAndTheTrajectoryStaysConnected) {
  AgentLayerConfig config;
  config.recent_s = 100.0;
  SceneGraph graph;
  AgentLayer layer(config);
  for (int step = 0; step < 1000; ++step)
    ASSERT_TRUE(layer.observe(graph, roundTheCircle(step), 1.0 * step));
  const auto& agents = graph.nodes(NodeType::kAgent);
  EXPECT_GE(agents.size(), 120U);  // 100 recent ones, and one at each place
  EXPECT_LE(agents.size(), 140U);
  EXPECT_GT(agents.begin()->second.created_s, 850.0) << "the last visit of a place stays";
  EXPECT_EQ(agents.rbegin()->first, NodeId{999});
  EXPECT_EQ(graph.edges(EdgeType::kTemporal).size(), agents.size() - 1);
  auto next = std::next(agents.begin());
  for (const auto& [ends, edge] : graph.edges(EdgeType::kTemporal)) {
    EXPECT_EQ(ends.second, next->first) << "each agent leads to the next that is left";
    ++next;
  }
}

TEST(AgentLayer, RestoredTrajectoryIsThinnedAsOneThatWasNot) {
  AgentLayerConfig config;
  config.recent_s = 100.0;
  SceneGraph graph;
  AgentLayer layer(config);
  for (int step = 0; step < 500; ++step) layer.observe(graph, roundTheCircle(step), 1.0 * step);
  SceneGraph other = graph;
  AgentLayer resumed(config);
  resumed.restore(other, 499.0);
  for (int step = 500; step < 1000; ++step) {
    layer.observe(graph, roundTheCircle(step), 1.0 * step);
    resumed.observe(other, roundTheCircle(step), 1.0 * step);
  }
  const auto idsOf = [](const SceneGraph& of) {
    std::vector<NodeId> ids;
    for (const auto& item : of.nodes(NodeType::kAgent)) ids.push_back(item.first);
    return ids;
  };
  EXPECT_EQ(idsOf(graph), idsOf(other));
}

// FailureMode: a month of driving. Ids before the first object's last for a million agents.
TEST(AgentLayer, MoreThanAMillionAgentsOfAMonthStayWithinTheCap) {
  AgentLayerConfig config;
  config.recent_s = 1e9;
  config.max_agents = 1000;
  SceneGraph graph;
  AgentLayer layer(config);
  constexpr int kOffered = 1'000'100;
  for (int step = 0; step < kOffered; ++step)
    ASSERT_TRUE(layer.observe(graph, poseAt(1.0 * (step % 1000), 0.0), 2.5 * step));
  const auto& agents = graph.nodes(NodeType::kAgent);
  EXPECT_EQ(agents.size(), 1000U);
  EXPECT_EQ(agents.rbegin()->first, kFurtherAgents + 99);
  EXPECT_EQ(graph.nodes(NodeType::kAgent).size(), 1000U);
  EXPECT_EQ(graph.edges(EdgeType::kTemporal).size(), 999U);
  EXPECT_NE(graph.find(kFurtherAgents), nullptr);
}

TEST(AgentLayer, PoseTooFarAwayForAGraphMakesNoAgent) {
  SceneGraph graph;
  AgentLayer layer(AgentLayerConfig{});
  EXPECT_FALSE(layer.observe(graph, poseAt(691000.0, 5334000.0), 1.0));
  EXPECT_EQ(layer.posesOutOfReach(), 1U);
  EXPECT_TRUE(layer.observe(graph, poseAt(1.0, 2.0), 2.0));
}

}  // namespace
}  // namespace occusg
