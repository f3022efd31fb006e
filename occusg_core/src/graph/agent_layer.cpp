// SPDX-License-Identifier: BSD-3-Clause
#include "graph/agent_layer.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/graph/limits.hpp"

namespace occusg {
namespace {

// Steps of exactly the threshold must count although sums of them round: single precision poses
// are good to a micrometre, stamps of this century to less than a microsecond.
constexpr double kRounding = 1e-6;

/// Removes an agent; the one before it leads to the one after it.
void removeFromTrajectory(SceneGraph& graph, NodeId agent) {
  const std::vector<NodeId> before = graph.sources(EdgeType::kTemporal, agent);
  const std::vector<NodeId> after = graph.targets(EdgeType::kTemporal, agent);
  graph.remove(agent);
  if (!before.empty() && !after.empty())
    graph.connect({EdgeType::kTemporal, before.front(), after.front(), {}});
}

}  // namespace

AgentLayer::AgentLayer(const AgentLayerConfig& config) : config_(checked(config)) {}

std::optional<NodeId> AgentLayer::observe(SceneGraph& graph, const Pose& T_map_agent,
                                          double stamp_s) {
  if (!isFinite(T_map_agent) || !std::isfinite(stamp_s)) {
    throw refuse("pose", "the pose or its stamp is not finite",
                 "metres in the map frame and seconds are expected");
  }
  if (last_agent_ && stamp_s < last_stamp_s_) {
    ++poses_back_in_time_;
    return std::nullopt;
  }
  last_stamp_s_ = stamp_s;
  const Eigen::Vector3d position = T_map_agent.translation();
  if (!isWithinGraph(position)) {
    ++poses_out_of_reach_;
    return std::nullopt;
  }
  if (last_agent_) {
    const double moved_m = (position - last_agent_->position).norm();
    const double elapsed_s = stamp_s - last_agent_->stamp_s;
    if (moved_m < config_.min_distance_m - kRounding &&
        elapsed_s < config_.max_interval_s - kRounding)
      return std::nullopt;
  }
  const NodeId agent = graph.add(position, stamp_s, AgentAttributes{T_map_agent}).id;
  if (last_agent_) graph.connect({EdgeType::kTemporal, last_agent_->agent, agent, {}});
  last_agent_ = Sample{agent, position, stamp_s};
  thin(graph, stamp_s);
  return agent;
}

AgentLayer::Place AgentLayer::placeOf(const Node& agent) const {
  Place place{};
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::floor(agent.position(axis) / config_.old_spacing_m);
    place[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(std::clamp<double>(cell, -2e9, 2e9));
  }
  return place;
}

void AgentLayer::thin(SceneGraph& graph, double now_s) {
  const auto& agents = graph.nodes(NodeType::kAgent);
  while (true) {
    const auto next = agents.lower_bound(first_recent_);
    if (next == agents.end() || next->second.created_s > now_s - config_.recent_s) break;
    const NodeId agent = next->first;
    const auto [kept, is_first] = of_place_.try_emplace(placeOf(next->second), agent);
    const NodeId replaced = kept->second;
    kept->second = agent;
    first_recent_ = agent + 1;
    if (!is_first) removeFromTrajectory(graph, replaced);
  }
  while (agents.size() > static_cast<std::size_t>(config_.max_agents)) {
    const Node& oldest = agents.begin()->second;
    const auto kept = of_place_.find(placeOf(oldest));
    if (kept != of_place_.end() && kept->second == oldest.id) of_place_.erase(kept);
    removeFromTrajectory(graph, oldest.id);
  }
}

void AgentLayer::restore(const SceneGraph& graph, double stamp_s) {
  *this = AgentLayer(config_);
  const auto& agents = graph.nodes(NodeType::kAgent);
  if (agents.empty()) return;
  const Node& last = agents.rbegin()->second;
  last_agent_ = Sample{last.id, last.position, last.created_s};
  last_stamp_s_ = stamp_s;
}

}  // namespace occusg
