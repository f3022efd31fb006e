// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// The text of a `scene_graph.dsg.json`, which Spark-DSG 1.1 opens (`DynamicSceneGraph.load`).
///
/// Layers: objects 2, agents 2 in partition 'a', places (navigation nodes) 3, rooms 4, buildings 5
/// (empty). Symbols O(n), a(n), p(n), R(n) with n counting from 0 within a type. A room has its
/// name, colour, centre, the box around its polygon, and as metadata "polygon", "holes", "area_m2",
/// "label", "region_id". Room edges lead to the room's members; an object in no room hangs from its
/// navigation node. Temporal, traversable and adjacency edges stay within their layer, the last
/// with "crossings" as metadata. Door nodes have no layer there and are left out.
/// @throws Error when a value is not finite.
[[nodiscard]] std::string toSparkDsg(const SceneGraph& graph, const std::string& scene,
                                     const std::string& frame = "map");
/// The same, node by node.
void writeSparkDsg(const SceneGraph& graph, const std::string& scene, const std::string& frame,
                   std::ostream& out);

}  // namespace occusg
