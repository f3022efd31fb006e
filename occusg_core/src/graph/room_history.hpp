// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Counts how often a room lost its id: a confirmed room was removed, and a room of another id came
/// into being on at least half of the union of both footprints. A room that merged into one that
/// was there already, or whose space is gone, lost nothing.
class RoomHistory {
 public:
  /// Looks at the rooms that changed. Always to be called with the same graph.
  void update(const SceneGraph& graph);

  [[nodiscard]] std::size_t idSwitches() const { return id_switches_; }

 private:
  struct Known {
    RoomAttributes room;
    bool was_confirmed = false;
  };

  [[nodiscard]] bool wasReplaced(const SceneGraph& graph, NodeId id,
                                 const RoomAttributes& room) const;
  void noteRemoved(const SceneGraph& graph, NodeId id);
  void noteAdded(const RoomAttributes& room);

  std::map<NodeId, Known> rooms_;        ///< As last seen.
  std::vector<RoomAttributes> removed_;  ///< Confirmed once, and not replaced since; the last few.
  std::size_t id_switches_ = 0;
  Revision revision_ = 0;
};

}  // namespace occusg
