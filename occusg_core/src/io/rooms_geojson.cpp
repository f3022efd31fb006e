// SPDX-License-Identifier: BSD-3-Clause
#include "io/rooms_geojson.hpp"

#include <nlohmann/json.hpp>
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

json featureOf(const RoomRecord& room) {
  json rings = json::array({closedRing(room.polygon.outer)});
  for (const Ring& hole : room.polygon.holes) rings.push_back(closedRing(hole));
  return feature("Polygon", std::move(rings),
                 {{"kind", "room"},
                  {"id", room.id},
                  {"label", room.label},
                  {"area_m2", rounded(area(room.polygon))}});
}

json featureOf(const DoorRecord& door) {
  return feature("LineString", jsonOf(Ring{door.segment.a, door.segment.b}),
                 {{"kind", "door"}, {"rooms", json::array({door.room_a, door.room_b})}});
}

}  // namespace

std::string toGeoJson(const RoomsFile& rooms) {
  json features = json::array();
  for (const RoomRecord& room : rooms.rooms) features.push_back(featureOf(room));
  for (const DoorRecord& door : rooms.doors) features.push_back(featureOf(door));
  return jsonDocument({{"type", "FeatureCollection"},
                       {"name", rooms.scene},
                       {"note", "coordinates are metres in the frame \"" + rooms.frame +
                                    "\", x and y, not longitude and latitude"},
                       {"features", std::move(features)}});
}

}  // namespace occusg
