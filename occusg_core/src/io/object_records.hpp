// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// An object of a scene as files carry it.
struct ObjectRecord {
  int id = 0;
  std::string label;
  Point2 position;             ///< Centre, map frame [m].
  std::optional<int> room_id;  ///< The room that holds it, as in `rooms.json`.
};

inline constexpr std::size_t kMaxObjects = 100'000;

/// The annotated objects of a recording: "objects" of `rooms.json`, a list of {"id", "label",
/// "bbox": [[x, y, z], [x, y, z]], "room"}; none when there is no such key. With the text of an
/// `objects.json` (a list of {"id", "pixels"}) objects of no pixel are left out: nobody saw them.
/// @param where opens every sentence; the file's path.
/// @throws Error naming the object and the value that cannot be used.
[[nodiscard]] std::vector<ObjectRecord> parseTruthObjects(const std::string& rooms_text,
                                                          const std::string& where,
                                                          const std::optional<std::string>& seen);

/// The objects of a `scene_graph.json`: nodes of type OBJECT, each in the room a ROOM_CONTAINS edge
/// leads from.
/// @throws Error naming the node or edge and the value that cannot be used.
[[nodiscard]] std::vector<ObjectRecord> parseGraphObjects(const std::string& text,
                                                          const std::string& where);

}  // namespace occusg
