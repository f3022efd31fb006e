// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/graph/scene_graph.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// The graph of one storey.
struct StoreyGraph {
  const SceneGraph* graph = nullptr;  ///< Never null.
  Storey storey;
};

/// The graph of a building: the nodes and edges of all storeys under their own ids. Nodes carry
/// their storey as `floor_id`; rooms, doors and navigation nodes lie at the height of its floor,
/// agents and objects are on the storey that their height says. The agents of all storeys are one
/// trajectory.
/// Every passage is a node that names the rooms at its ends; a traversable edge joins the
/// navigation nodes there.
/// @param storeys whose graphs have no id in common.
/// @param floor_z_m the height that the storeys' graphs give rooms, doors and navigation nodes.
[[nodiscard]] SceneGraph buildingGraph(const std::vector<StoreyGraph>& storeys,
                                       const std::vector<StoreyPassage>& passages,
                                       double floor_z_m);

}  // namespace occusg
