// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/graph/graph_config.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Label of a room nobody can name.
inline constexpr const char* kUnknownLabel = "unknown";
inline constexpr std::size_t kMaxLabelLength = 200;  ///< [bytes]

struct RoomLabel {
  std::string label = kUnknownLabel;
  double score = 0.0;  ///< Share of the evidence that speaks for the label, 0..1.
};

/// The kind of room the objects make it: the label with the greatest sum of weights, an object
/// class counting twice at most. Unknown when the sum is below 0.5, or when the second best has
/// more than two thirds of it. The score is the sum over all labels' sums plus 0.5.
[[nodiscard]] RoomLabel labelFor(const std::vector<std::string>& object_classes,
                                 const RoomLabelTable& table);

/// Labels rooms by the objects in them. A label a person gave stays.
class RoomLabeler {
 public:
  explicit RoomLabeler(RoomLabelTable table);

  /// Looks at the rooms whose objects changed. Always to be called with the same graph.
  void update(SceneGraph& graph);

 private:
  void label(SceneGraph& graph, NodeId room) const;

  RoomLabelTable table_;
  Revision revision_ = 0;
};

/// Gives the room a label that stays, or with an empty one returns to the automatic label.
/// @throws Error when there is no such room, or the label is too long or holds control characters.
void setLabelByPerson(SceneGraph& graph, NodeId room, const std::string& label);

}  // namespace occusg
