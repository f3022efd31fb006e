// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>

#include "occusg/geometry/polygon.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg::apps {

struct RoomAtQuestion {
  Place place;
};
struct WayQuestion {
  Place from;
  Place to;
};
struct ContentsQuestion {
  std::string room;  ///< Its number, id, name or label.
};
struct NearestQuestion {
  std::string class_name;
  Place place;
};
struct AdjacentQuestion {
  std::string room;  ///< Its number, id, name or label.
};
using GraphQuestion =
    std::variant<RoomAtQuestion, WayQuestion, ContentsQuestion, NearestQuestion, AdjacentQuestion>;

/// The questions as a user writes them, for help texts.
inline constexpr const char* kGraphQuestions =
    "  room at X Y [Z]        the room that holds this point [m, map frame], or 'none'\n"
    "  way X Y [Z] to X Y [Z] the shortest way: its length, its rooms, and the doors and stairs "
    "between them\n"
    "  contents of ROOM       the objects in a room: its number, id, name (room_3) or label\n"
    "  nearest CLASS at X Y [Z]  the object of a class that is nearest to a point, or 'none'\n"
    "  adjacent to ROOM       the rooms beside a room, and the doors to them\n"
    "In a building with storeys the height Z says on which storey a point is.\n";

/// @throws UsageError when it is none of `kGraphQuestions`.
[[nodiscard]] GraphQuestion questionIn(const std::string& text);

/// The answer as lines of text.
/// @throws Error when the graph has no such room.
[[nodiscard]] std::string answerTo(const GraphQuestion& question, const SceneGraph& graph);

/// Fit for a terminal and a column: files may hold anything.
[[nodiscard]] std::string cell(const std::string& text);

}  // namespace occusg::apps
