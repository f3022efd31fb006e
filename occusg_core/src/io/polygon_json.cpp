// SPDX-License-Identifier: BSD-3-Clause
#include "io/polygon_json.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/json_text.hpp"
#include "occusg/error.hpp"

namespace occusg {

using nlohmann::json;

double coordinateOf(const json& value, const std::string& where) {
  const double coordinate = numberOf(value, where);
  if (std::abs(coordinate) > kMaxRoomCoordinate_m) {
    throw refuse(where, "is " + toText(coordinate) + " m",
                 "coordinates must lie within 1e6 m of the origin");
  }
  return coordinate;
}

Point2 pointOf(const json& value, const std::string& where) {
  if (arrayOf(value, where).size() != 2)
    throw refuse(where, "has " + std::to_string(value.size()) + " numbers", "[x, y] is needed");
  return {coordinateOf(value[0], where + " x"), coordinateOf(value[1], where + " y")};
}

Segment2 segmentOf(const json& value, const std::string& where) {
  if (arrayOf(value, where).size() != 2) {
    throw refuse(where, "has " + std::to_string(value.size()) + " points", "two are needed");
  }
  return {pointOf(value[0], where + "[0]"), pointOf(value[1], where + "[1]")};
}

Ring RingReader::read(const json& value, const std::string& where) {
  vertices_ += arrayOf(value, where).size();
  if (vertices_ > max_vertices_) {
    throw refuse(file_, "has more than " + std::to_string(max_vertices_) + " vertices",
                 "fewer are needed");
  }
  Ring ring;
  ring.reserve(value.size());
  for (std::size_t i = 0; i < value.size(); ++i)
    ring.push_back(pointOf(value[i], where + " vertex " + std::to_string(i)));
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (ring.size() < 3) {
    throw refuse(where, "has " + std::to_string(ring.size()) + " vertices",
                 "at least 3 different ones are needed");
  }
  return ring;
}

Ring RingReader::wound(Ring ring, Winding winding) const {
  const bool is_wrong = signedArea(ring) * static_cast<int>(winding) < 0.0;
  if (order_ == RingOrder::kOriented && is_wrong) std::reverse(ring.begin(), ring.end());
  return ring;
}

Polygon RingReader::polygonOf(const json& value, const std::string& where) {
  Polygon polygon;
  polygon.outer = wound(read(member(value, "polygon", where), where + " polygon"), Winding::kOuter);
  const json* holes = optionalMember(value, "holes", where);
  if (holes == nullptr) return polygon;
  const std::size_t count = arrayOf(*holes, where + " holes").size();
  for (std::size_t i = 0; i < count; ++i) {
    polygon.holes.push_back(
        wound(read((*holes)[i], where + " hole " + std::to_string(i)), Winding::kHole));
  }
  return polygon;
}

}  // namespace occusg
