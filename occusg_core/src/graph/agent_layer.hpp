// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "occusg/geometry/pose.hpp"
#include "occusg/graph/graph_config.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Samples the trajectory and thins it with age, so that it does not grow for ever: agent nodes,
/// each joined to the one before by a temporal edge (paper, Sec. 3.4). The first pose is always an
/// agent. Where an agent goes, those before and after it are joined.
class AgentLayer {
 public:
  explicit AgentLayer(const AgentLayerConfig& config);

  /// The new agent, or empty when the pose adds nothing. A pose older than the one before, or too
  /// far away for a graph (`kMaxGraphCoordinate_m`), is refused and counted.
  /// @throws Error when the pose or the stamp is not finite.
  std::optional<NodeId> observe(SceneGraph& graph, const Pose& T_map_agent, double stamp_s);

  /// Goes on after the last agent of `graph`.
  /// @param stamp_s of the last pose seen.
  void restore(const SceneGraph& graph, double stamp_s);

  [[nodiscard]] std::size_t posesBackInTime() const { return poses_back_in_time_; }
  [[nodiscard]] std::size_t posesOutOfReach() const { return poses_out_of_reach_; }

 private:
  struct Sample {
    NodeId agent = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double stamp_s = 0.0;
  };

  using Place = std::array<std::int32_t, 3>;

  [[nodiscard]] Place placeOf(const Node& agent) const;
  void thin(SceneGraph& graph, double now_s);

  AgentLayerConfig config_;
  std::optional<Sample> last_agent_;
  double last_stamp_s_ = 0.0;         ///< Of the last pose seen, once there is an agent.
  NodeId first_recent_ = 0;           ///< Agents before it are old.
  std::map<Place, NodeId> of_place_;  ///< The old agent that stays at each place.
  std::size_t poses_back_in_time_ = 0;
  std::size_t poses_out_of_reach_ = 0;
};

}  // namespace occusg
