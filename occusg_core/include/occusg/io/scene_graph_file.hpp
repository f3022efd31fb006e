// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "occusg/graph/limits.hpp"
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
/// also "crossings". Nodes are ordered by type and id, edges by type, source, target. Lengths are
/// rounded to 1e-4 m, stamps and orientations to 1e-6.
/// @throws Error when a value is not finite.
[[nodiscard]] std::string toJson(const SceneGraph& graph, const std::string& scene,
                                 const std::string& frame = "map");
/// The same, node by node: a large graph's text never stands in memory.
/// @throws Error as `toJson`, or when the graph is beyond what `parseSceneGraph` reads
/// (limits.hpp).
void writeJson(const SceneGraph& graph, const std::string& scene, const std::string& frame,
               std::ostream& out);

/// What a `scene_graph.json` holds.
struct SceneGraphFile {
  std::string scene;
  std::string frame;
  SceneGraph graph;
};

/// Reads the text of a `scene_graph.json`. Nodes keep their ids; keys not named above are ignored,
/// those that came after the first files of this version may be absent.
/// @param where opens every sentence; the file's path.
/// @throws Error naming the node or edge and the value that cannot be used: another version, a node
/// twice or of an id that is not its type's, an end that is not there, an edge twice, that joins
/// the wrong types or leads back in time (which is what a cycle would need), a node in two rooms,
/// two rooms on one region, a number that is not finite, nesting deeper than 32 levels.
[[nodiscard]] SceneGraphFile parseSceneGraph(const std::string& text, const std::string& where);

/// @throws Error as `parseSceneGraph`, or when the file cannot be read or exceeds 256 MiB.
[[nodiscard]] SceneGraphFile readSceneGraph(const std::string& path);

/// The graph's rooms as a `RoomsFile`: id = n of "room_<n>", the n-th room there ever was,
/// doors = the crossings of adjacent rooms.
[[nodiscard]] RoomsFile roomsOf(const SceneGraph& graph, const std::string& scene,
                                double floor_z_m);

}  // namespace occusg
