// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/seen_apart.hpp"
#include "occusg/graph/graph_config.hpp"
#include "occusg/graph/graph_state.hpp"
#include "occusg/graph/scene_graph.hpp"
#include "occusg/graph/spatial_index.hpp"
#include "occusg/perception/detection.hpp"

namespace octomap {
class OcTree;
}

namespace occusg {

/// Detections -> object nodes.
class ObjectLayer {
 public:
  explicit ObjectLayer(const ObjectLayerConfig& config);

  /// Takes the detections of a frame. What cannot be used is counted and left out. kRunning: an
  /// object takes one detection of a frame, unless two are the same thing twice.
  void observe(SceneGraph& graph, const std::vector<Detection>& detections, double stamp_s);

  /// Looks for ghosts among the objects within `radius_m` of `center`, some at each call in turn,
  /// so that the cost of a call is bounded.
  void removeGhosts(SceneGraph& graph, const octomap::OcTree& map, const Point2& center,
                    double radius_m);

  [[nodiscard]] ObjectLayerState state() const;
  /// Goes on with the objects of `graph`.
  void restore(const SceneGraph& graph, const ObjectLayerState& state);

  [[nodiscard]] const ObjectCounts& counts() const { return counts_; }

 private:
  using Frame = std::vector<const Detection*>;         ///< The usable detections of a frame.
  using Objects = std::vector<std::optional<NodeId>>;  ///< The object of each detection.

  [[nodiscard]] std::optional<NodeId> matchAtFirstSight(const SceneGraph& graph,
                                                        const Detection& detection) const;
  void observeAtFirstSight(SceneGraph& graph, const Frame& frame, double stamp_s);
  void observeRunning(SceneGraph& graph, const Frame& frame, double stamp_s);
  [[nodiscard]] Objects matchByBox(const SceneGraph& graph, const Frame& frame) const;
  NodeId add(SceneGraph& graph, const Detection& detection, double stamp_s);
  void absorb(SceneGraph& graph, NodeId object, const Detection& detection, double stamp_s);
  void noteApart(const SceneGraph& graph, const Frame& frame, const Objects& object_of);
  [[nodiscard]] bool areOne(const Node& object, const Node& other) const;
  void mergeDuplicates(SceneGraph& graph, NodeId object);
  NodeId merge(SceneGraph& graph, NodeId object, NodeId other);
  void remove(SceneGraph& graph, NodeId object);

  ObjectLayerConfig config_;
  SpatialIndex boxes_;  ///< Of the objects, in the ground plane.
  SeenApart apart_;
  std::map<NodeId, int> free_checks_;  ///< How often in a row an object's space was found free.
  NodeId last_checked_ = 0;
  ObjectCounts counts_;
};

}  // namespace occusg
