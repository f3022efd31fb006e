// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/agent_layer.hpp"

#include <cmath>

#include "occusg/error.hpp"

namespace occusg {
namespace {

// Steps of exactly the threshold must count although sums of them round: single precision poses
// are good to a micrometre, stamps of this century to less than a microsecond.
constexpr double kRounding = 1e-6;

}  // namespace

AgentLayer::AgentLayer(const AgentLayerConfig& config) : config_(config) {}

std::optional<NodeId> AgentLayer::observe(SceneGraph& graph, const Pose& T_map_camera,
                                          double stamp_s) {
  if (!isFinite(T_map_camera) || !std::isfinite(stamp_s)) {
    throw refuse("pose", "the pose or its stamp is not finite",
                 "metres in the map frame and seconds are expected");
  }
  if (last_agent_ && stamp_s < last_stamp_s_) {
    ++poses_back_in_time_;
    return std::nullopt;
  }
  last_stamp_s_ = stamp_s;
  const Eigen::Vector3d position = T_map_camera.translation();
  if (last_agent_) {
    const double moved_m = (position - last_agent_->position).norm();
    const double elapsed_s = stamp_s - last_agent_->stamp_s;
    if (moved_m < config_.min_distance_m - kRounding &&
        elapsed_s < config_.max_interval_s - kRounding)
      return std::nullopt;
  }
  const NodeId agent = graph.add(position, stamp_s, AgentAttributes{T_map_camera}).id;
  if (last_agent_) graph.connect({EdgeType::kTemporal, last_agent_->agent, agent, {}});
  last_agent_ = Sample{agent, position, stamp_s};
  return agent;
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
