// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/graph/scene_graph.hpp"
#include "occusg/parameter.hpp"

namespace occusg {

/// The published system says "sampled"; these are the values it was run with.
struct AgentLayerConfig {
  double min_distance_m = 0.5;   ///< A pose so far from the last agent becomes one [m], 3D.
  double max_interval_s = 10.0;  ///< A pose this much later than the last agent becomes one [s].
  /// Of older agents only the last at each place stays [s], positive.
  double recent_s = 3600.0;
  double old_spacing_m = 1.0;  ///< Side of the cubes that are one place for them [m], positive.
  int max_agents = 20'000;     ///< Beyond it the oldest go, [2, kMaxGraphNodes / 2].
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(AgentLayerConfig& config);

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
