// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// The text of a `scene_graph.graphml` (graphml.graphdrawing.org), for networkx, Gephi and yEd. A
/// node is "n<id>" with "type", "x", "y", "z" in metres, "floor_id", "name" (of a room), "label"
/// (of a room, an object's class), "area_m2" (of a room) and "width_m" (of a door). All edges are
/// directed, with "type"; an undirected one is written once, from the smaller id.
/// @throws Error when a value is not finite.
[[nodiscard]] std::string toGraphMl(const SceneGraph& graph, const std::string& scene);
/// The same, node by node.
void writeGraphMl(const SceneGraph& graph, const std::string& scene, std::ostream& out);

}  // namespace occusg
