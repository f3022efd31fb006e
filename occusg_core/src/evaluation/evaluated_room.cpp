// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/evaluated_room.hpp"

#include <algorithm>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/geometry/polygon_overlap.hpp"

namespace occusg {
namespace {

Ring withoutRepetitions(Ring ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

Polygon withoutRepetitions(const Polygon& polygon) {
  Polygon clean{withoutRepetitions(polygon.outer), {}};
  for (const Ring& hole : polygon.holes) {
    Ring kept = withoutRepetitions(hole);
    if (kept.size() >= 3) clean.holes.push_back(std::move(kept));
  }
  return clean;
}

}  // namespace

bool isSound(const Polygon& polygon) { return isSimple(withoutRepetitions(polygon)); }

std::optional<EvaluatedRoom> roomFrom(int id, const Polygon& polygon, const std::string& where) {
  const std::string room_name = where + ": room " + std::to_string(id);
  checkCoordinates(polygon, room_name);
  Polygon clean = withoutRepetitions(polygon);
  EvaluatedRoom room{id, {}};
  if (isSimple(clean)) {
    room.parts.push_back(std::move(clean));
  } else {
    try {
      room.parts = repaired(clean);
    } catch (const Error& error) {
      throw Error(room_name + ": " + error.what());
    }
  }
  if (!(area(room) > 0.0)) return std::nullopt;
  return room;
}

double area(const EvaluatedRoom& room) {
  double sum = 0.0;
  for (const Polygon& part : room.parts) sum += area(part);
  return sum;
}

Point2 centroid(const EvaluatedRoom& room) {
  if (room.parts.size() == 1) return centroid(room.parts.front());
  Point2 sum;
  double total = 0.0;
  for (const Polygon& part : room.parts) {
    const double weight = area(part);
    const Point2 center = centroid(part);
    sum = {sum.x + weight * center.x, sum.y + weight * center.y};
    total += weight;
  }
  return total > 0.0 ? Point2{sum.x / total, sum.y / total} : Point2{};
}

double intersectionArea(const EvaluatedRoom& a, const EvaluatedRoom& b) {
  double sum = 0.0;
  for (const Polygon& part_a : a.parts)
    for (const Polygon& part_b : b.parts) sum += intersectionArea(part_a, part_b);
  return sum;
}

EvaluatedRoom translated(const EvaluatedRoom& room, const Point2& shift) {
  EvaluatedRoom moved{room.id, {}};
  moved.parts.reserve(room.parts.size());
  for (const Polygon& part : room.parts) moved.parts.push_back(translated(part, shift.x, shift.y));
  return moved;
}

void check(const std::vector<EvaluatedRoom>& rooms, const std::string& what) {
  for (const EvaluatedRoom& room : rooms) {
    const std::string where = what + " " + std::to_string(room.id);
    if (room.parts.empty()) throw refuse(where, "no polygon", "must have at least one");
    for (const Polygon& part : room.parts) {
      if (part.outer.empty()) throw refuse(where, "polygon without vertices", "must have three");
      checkCoordinates(part, where);
    }
  }
}

}  // namespace occusg
