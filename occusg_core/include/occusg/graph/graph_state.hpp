// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "occusg/graph/node.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Most detections taken from one frame; those of the best score.
inline constexpr std::size_t kMaxDetectionsPerFrame = 300;

/// What became of the detections.
struct ObjectCounts {
  std::size_t detections = 0;  ///< Taken.
  std::size_t refused = 0;     ///< A NaN, an empty box, or a score outside 0..1.
  std::size_t over_limit = 0;  ///< Beyond `kMaxDetectionsPerFrame`.
  std::size_t merged = 0;      ///< Objects found to be one with another.
  std::size_t ghosts = 0;      ///< Objects removed because their space is free.
};

/// What the room layer knows that neither the graph nor the next regions tell it again.
struct RoomLayerState {
  std::map<int, double> first_seen_s;  ///< By region.
  /// Rooms that moved away from a region the tracker may still bring back.
  std::map<int, NodeId> former_room_of_region;
};

/// In how many frames two objects were seen as two things; the smaller id first.
using ObjectPairCounts = std::map<std::pair<NodeId, NodeId>, int>;

/// What the object layer knows that neither the graph nor later frames tell it again.
struct ObjectLayerState {
  ObjectPairCounts seen_apart;
  std::map<NodeId, int> free_checks;  ///< How often in a row an object's space was found free.
  NodeId last_checked = 0;            ///< The object last looked at, whether it is a ghost.
};

/// Everything a builder knows that the next update does not tell it again.
struct GraphBuilderState {
  SceneGraph graph;
  RoomLayerState rooms;
  std::optional<double> last_update_s;
  double last_maintenance_s = 0.0;
  ObjectLayerState objects;
};

}  // namespace occusg
