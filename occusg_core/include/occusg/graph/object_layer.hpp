// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "occusg/graph/scene_graph.hpp"
#include "occusg/graph/seen_apart.hpp"
#include "occusg/graph/spatial_index.hpp"
#include "occusg/parameter.hpp"
#include "occusg/perception/detection.hpp"

namespace octomap {
class OcTree;
}

namespace occusg {

enum class ObjectMemory {
  /// An object keeps what was first seen of it; later detections are only counted (paper,
  /// Sec. 3.4).
  kFirstSight,
  /// Detections of overlapping boxes make up one object: mean place, common box, class histogram.
  kRunning,
};

enum class GhostRemoval {
  kNever,
  kSeenThrough,  ///< An object goes when the space it filled has been seen to be free.
};

struct ObjectLayerConfig {
  ObjectMemory memory = ObjectMemory::kRunning;
  double merge_distance_m =
      0.75;  ///< kFirstSight: objects of one class nearer than this are one [m], 3D.
  double flicker_distance_m =
      0.15;  ///< kFirstSight: objects of any class nearer than this are one [m].
  /// kRunning: same class with so much of the smaller box in common is one object, 0..1.
  double min_common_box = 0.3;
  GhostRemoval ghosts = GhostRemoval::kSeenThrough;
  int ghost_checks = 3;              ///< So many looks in a row must find the space free.
  double max_link_distance_m = 1.0;  ///< To the nearest navigation node [m].
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(ObjectLayerConfig& config);

/// Most detections taken from one frame; those of the best score.
inline constexpr std::size_t kMaxDetectionsPerFrame = 300;

struct ObjectCounts {
  std::size_t detections = 0;  ///< Taken.
  std::size_t refused = 0;     ///< A NaN, an empty box, or a score outside 0..1.
  std::size_t over_limit = 0;  ///< Beyond `kMaxDetectionsPerFrame`.
  std::size_t merged = 0;      ///< Objects found to be one with another.
  std::size_t ghosts = 0;      ///< Objects removed because their space is free.
};

/// What the layer knows that neither the graph nor later frames tell it again.
struct ObjectLayerState {
  SeenApart::Pairs seen_apart;        ///< Of objects in the graph.
  std::map<NodeId, int> free_checks;  ///< How often in a row an object's space was found free.
  NodeId last_checked = 0;            ///< The object last looked at, whether it is a ghost.
};

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
