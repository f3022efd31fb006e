// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/io/rooms_file.hpp"

namespace occusg {

/// The rooms and doors as a GeoJSON FeatureCollection (RFC 7946 geometry). Coordinates are metres
/// in the map frame, not longitude and latitude: a "note" says so, and there is no "crs". A room is
/// a Polygon with "kind": "room", "id", "label", "area_m2"; a door a LineString with
/// "kind": "door", "rooms".
/// @throws Error when a coordinate is not finite.
[[nodiscard]] std::string toGeoJson(const RoomsFile& rooms);

}  // namespace occusg
