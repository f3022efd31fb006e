// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "occusg/geometry/polygon.hpp"
#include "occusg/graph/limits.hpp"

namespace occusg {

/// A storey as files carry it.
struct StoreyRecord {
  int id = 0;
  double floor_z_m = 0.0;             ///< Map frame [m].
  std::optional<double> ceiling_z_m;  ///< Map frame [m]; empty: not known.
};

/// A room as files carry it.
struct RoomRecord {
  int id = 0;
  std::string label;
  Polygon polygon;  ///< Map frame [m].
  int level = 0;    ///< Id of its storey; rooms of different storeys may lie above each other.
  std::vector<Polygon> further_parts = {};  ///< Of a room that is not in one piece.
};

/// Two rooms that meet, and where: a door or an opening.
struct DoorRecord {
  int room_a = 0;
  int room_b = 0;
  Segment2 segment;  ///< Map frame [m].
};

/// A way between two storeys.
struct StairsRecord {
  std::string kind;    ///< "stairs", "ramp" or "lift".
  int lower_room = 0;  ///< 0: no room is at this end.
  int upper_room = 0;
  int lower_storey = 0;
  int upper_storey = 0;
  int risers = 0;  ///< 0 when it has none.
  Ring footprint;  ///< Map frame [m].
};

/// `rooms.json`, prediction and ground truth alike:
/// {"scene", "frame", "floor_z", "rooms": [{"id", "label", "polygon": [[x, y], ...], "holes"}],
/// "doors": [{"rooms": [id, id], "segment": [[x, y], [x, y]]}]}. A room may also have "storey" (or
/// "level"), the id of its storey, and "further_parts", a list of {"polygon", "holes"}. The file of
/// a building with several storeys lists them, "storeys": [{"id", "floor_z", "ceiling_z"}], and the
/// ways between them, "stairs": [{"kind", "rooms", "storeys", "risers", "footprint"}], the lower
/// end first. Stairs are written and not read.
struct RoomsFile {
  std::string scene;
  std::string frame = "map";
  double floor_z_m = 0.0;             ///< Of the lowest storey.
  std::vector<StoreyRecord> storeys;  ///< From the lowest up; empty: the file names none.
  std::vector<RoomRecord> rooms;
  std::vector<DoorRecord> doors;
  std::vector<StairsRecord> stairs = {};
};

/// Limits of what is read. The rooms of every graph that can be written can be read.
inline constexpr std::size_t kMaxRoomVertices = kMaxGraphVertices;  ///< Of all rooms together.
inline constexpr std::size_t kMaxRooms = kMaxRoomVertices / 3;
inline constexpr double kMaxRoomCoordinate_m = 1e6;

/// Which way round the rings of a file come out.
enum class RingOrder {
  kOriented,   ///< As `Polygon` asks for.
  kAsWritten,  ///< As in the file, for what depends on where a ring starts and how it runs.
};

/// Reads the text of a `rooms.json`. Only "rooms", and in it "id" and "polygon", are required;
/// other keys may be absent, and keys not named above are ignored. Rings come out without a
/// repeated last vertex; they are not checked to be simple.
/// @param where opens every sentence; the file's path.
/// @throws Error naming the room and the value that cannot be used.
[[nodiscard]] RoomsFile parseRooms(const std::string& text, const std::string& where,
                                   RingOrder order = RingOrder::kOriented);

/// @throws Error as `parseRooms`, or when the file cannot be read or exceeds 64 MiB.
[[nodiscard]] RoomsFile readRooms(const std::string& path, RingOrder order = RingOrder::kOriented);

/// The text of a `rooms.json`: coordinates rounded to 1e-4 m, one room a line, keys of a room
/// sorted.
/// @throws Error when a coordinate is not finite.
[[nodiscard]] std::string toJson(const RoomsFile& rooms);

}  // namespace occusg
