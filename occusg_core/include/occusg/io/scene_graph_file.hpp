// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/graph/scene_graph.hpp"
#include "occusg/io/rooms_file.hpp"

namespace occusg {

/// Version of `scene_graph.json`; counts up when a reader of the old one would misread the new one.
inline constexpr int kSceneGraphFileVersion = 1;

/// The text of a `scene_graph.json`: {"format": "occusg-scene-graph", "version", "scene", "frame",
/// "nodes", "edges"}, a node or edge a line.
///
/// A node has "id", "type" (`nameOf(NodeType)`), "position" [x, y, z] in metres, "created_s",
/// "last_seen_s", "floor_id", and by type: AGENT "orientation" [qx, qy, qz, qw] of the camera's
/// optical frame; OBJECT "class", "score", "observations", "class_histogram" {class: sum of
/// scores}, "box" [[min], [max]] if there is one; NAVIGATION "block" [x, y], "free_cells"; ROOM
/// "name", "state" (confirmed, partial), "frontier_share", "label", "label_score", "label_source"
/// (automatic, person), "region_id", "reason", "area_m2", "polygon", "holes", and
/// "unsupported_since_s" while its region is missing; DOOR "segment", "width_m", "rooms" [id, id].
/// An edge has "type", "source", "target"; ROOM_ADJACENCY
/// also "crossings". Nodes are ordered by id, edges by type, source, target. Lengths are rounded to
/// 1e-4 m, stamps and orientations to 1e-6.
/// @throws Error when a value is not finite.
[[nodiscard]] std::string toJson(const SceneGraph& graph, const std::string& scene,
                                 const std::string& frame = "map");

/// The graph's rooms as a `RoomsFile`: id = n of "room_<n>", the n-th room there ever was,
/// doors = the crossings of adjacent rooms.
[[nodiscard]] RoomsFile roomsOf(const SceneGraph& graph, const std::string& scene,
                                double floor_z_m);

}  // namespace occusg
