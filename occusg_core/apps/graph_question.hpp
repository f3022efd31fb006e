// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>

#include "occusg/geometry/polygon.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg::apps {

struct RoomAtQuestion {
  Point2 point;
};
struct WayQuestion {
  Point2 from;
  Point2 to;
};
struct ContentsQuestion {
  std::string room;  ///< Its number, id, name or label.
};
struct NearestQuestion {
  std::string class_name;
  Point2 point;
};
struct AdjacentQuestion {
  std::string room;  ///< Its number, id, name or label.
};
using GraphQuestion =
    std::variant<RoomAtQuestion, WayQuestion, ContentsQuestion, NearestQuestion, AdjacentQuestion>;

/// The questions as a user writes them, for help texts.
inline constexpr const char* kGraphQuestions =
    "  room at X Y            the room that holds this point [m, map frame], or 'none'\n"
    "  way X Y to X Y         the shortest way: its length, its rooms, and the doors between them\n"
    "  contents of ROOM       the objects in a room: its number, id, name (room_3) or label\n"
    "  nearest CLASS at X Y   the object of a class that is nearest to a point, or 'none'\n"
    "  adjacent to ROOM       the rooms beside a room, and the doors to them\n";

/// @throws UsageError when it is none of `kGraphQuestions`.
[[nodiscard]] GraphQuestion questionIn(const std::string& text);

/// The answer as lines of text.
/// @throws Error when the graph has no such room.
[[nodiscard]] std::string answerTo(const GraphQuestion& question, const SceneGraph& graph);

/// Fit for a terminal and a column: files may hold anything.
[[nodiscard]] std::string cell(const std::string& text);

}  // namespace occusg::apps
