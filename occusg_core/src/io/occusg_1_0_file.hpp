// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// The graph in schema "1.0" of the published system, for the evaluation scripts that read it:
/// {"schema_version": "1.0", "metadata", "nodes", "edges"}. A node has "id", "type", "layer",
/// "pose", "created_at", "last_seen", "active", "attributes", "geometry", "semantic"; points of
/// rings are {"x", "y"}. Adjacency and navigable edges are written in both directions, as there.
/// Door nodes are unknown to it and left out; holes are beside its keys, as "holes".
/// @throws Error when a value is not finite.
[[nodiscard]] std::string toOccusg10(const SceneGraph& graph, const std::string& scene,
                                     const std::string& frame = "map");

}  // namespace occusg
