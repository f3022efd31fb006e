// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "occusg/geometry/pose.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// The published system says "sampled"; these are the values it was run with.
struct AgentLayerConfig {
  double min_distance_m = 0.5;   ///< A pose so far from the last agent becomes one [m], 3D.
  double max_interval_s = 10.0;  ///< So does a pose so long after it [s].
};

/// Samples the trajectory: agent nodes, each joined to the one before by a temporal edge (paper,
/// Sec. 3.4). The first pose is always an agent.
class AgentLayer {
 public:
  explicit AgentLayer(const AgentLayerConfig& config);

  /// The new agent, or empty when the pose adds nothing. A pose older than the one before is
  /// refused and counted.
  /// @throws Error when the pose or the stamp is not finite.
  std::optional<NodeId> observe(SceneGraph& graph, const Pose& T_map_camera, double stamp_s);

  /// Goes on after the last agent of `graph`.
  /// @param stamp_s of the last pose seen.
  void restore(const SceneGraph& graph, double stamp_s);

  [[nodiscard]] std::size_t posesBackInTime() const { return poses_back_in_time_; }

 private:
  struct Sample {
    NodeId agent = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double stamp_s = 0.0;
  };

  AgentLayerConfig config_;
  std::optional<Sample> last_agent_;
  double last_stamp_s_ = 0.0;  ///< Of the last pose seen, once there is an agent.
  std::size_t poses_back_in_time_ = 0;
};

}  // namespace occusg
