// SPDX-License-Identifier: BSD-3-Clause
#include "io/rooms_geojson.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/json_text.hpp"

namespace occusg {
namespace {

using nlohmann::json;

json closedRing(const Ring& ring) {
  json points = jsonOf(ring);
  if (!ring.empty()) points.push_back(jsonOf(ring.front()));
  return points;
}

json feature(const char* geometry_type, json coordinates, json properties) {
  return {{"type", "Feature"},
          {"geometry", {{"type", geometry_type}, {"coordinates", std::move(coordinates)}}},
          {"properties", std::move(properties)}};
}

/// The storey's place from the lowest up, as indoor maps number levels; empty in a file that names
/// no storeys.
std::optional<std::size_t> levelOf(const RoomRecord& room, const RoomsFile& file) {
  for (std::size_t i = 0; i < file.storeys.size(); ++i)
    if (file.storeys[i].id == room.level) return i;
  return std::nullopt;
}

json featureOf(const RoomRecord& room, const RoomsFile& file) {
  json rings = json::array({closedRing(room.polygon.outer)});
  for (const Ring& hole : room.polygon.holes) rings.push_back(closedRing(hole));
  json properties = {{"kind", "room"},
                     {"id", room.id},
                     {"label", room.label},
                     {"area_m2", rounded(area(room.polygon))}};
  if (const auto level = levelOf(room, file)) {
    properties["level"] = *level;
    properties["storey"] = room.level;
  }
  return feature("Polygon", std::move(rings), std::move(properties));
}

json featureOf(const DoorRecord& door) {
  return feature("LineString", jsonOf(Ring{door.segment.a, door.segment.b}),
                 {{"kind", "door"}, {"rooms", json::array({door.room_a, door.room_b})}});
}

}  // namespace

std::string toGeoJson(const RoomsFile& rooms) {
  json features = json::array();
  for (const RoomRecord& room : rooms.rooms) features.push_back(featureOf(room, rooms));
  for (const DoorRecord& door : rooms.doors) features.push_back(featureOf(door));
  return jsonDocument({{"type", "FeatureCollection"},
                       {"name", rooms.scene},
                       {"note", "coordinates are metres in the frame \"" + rooms.frame +
                                    "\", x and y, not longitude and latitude"},
                       {"features", std::move(features)}});
}

}  // namespace occusg
