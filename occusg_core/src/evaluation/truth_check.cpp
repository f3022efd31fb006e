// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/truth_check.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <optional>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/geometry/polygon_overlap.hpp"

namespace occusg {
namespace {

/// Two rooms are one drawn twice from this intersection over union on.
constexpr double kDuplicateIou = 0.99;

struct LevelledRoom {
  EvaluatedRoom room;
  int level = 0;
};

std::string named(int id) { return "room " + std::to_string(id); }

std::string inSquareMetres(double area_m2) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m2", area_m2);
  return text;
}

class TruthRepair {
 public:
  explicit TruthRepair(std::string where) : where_(std::move(where)) {}

  void add(const TruthRoom& annotated) {
    std::optional<EvaluatedRoom> room = roomFrom(annotated.id, annotated.polygon, where_);
    if (!room) {
      note(annotated.id, "encloses no area and is left out");
      return;
    }
    if (!isSound(annotated.polygon)) keepMainPiece(*room);
    for (const Polygon& polygon : annotated.further_parts) {
      auto part = roomFrom(annotated.id, polygon, where_);
      if (part) std::move(part->parts.begin(), part->parts.end(), std::back_inserter(room->parts));
    }
    rooms_.push_back({*std::move(room), annotated.level});
  }

  void separate() {
    for (std::size_t i = 0; i < rooms_.size(); ++i) {
      for (std::size_t j = i + 1; j < rooms_.size();) {
        if (rooms_[i].level == rooms_[j].level && isDuplicate(i, j)) {
          note(rooms_[j].room.id, "is " + named(rooms_[i].room.id) + " again and is left out");
          rooms_.erase(rooms_.begin() + static_cast<std::ptrdiff_t>(j));
        } else {
          ++j;
        }
      }
    }
    for (std::size_t i = 0; i < rooms_.size(); ++i) {
      for (std::size_t j = i + 1; j < rooms_.size(); ++j)
        if (rooms_[i].level == rooms_[j].level) separate(rooms_[i].room, rooms_[j].room);
    }
  }

  [[nodiscard]] SoundTruth result() && {
    SoundTruth truth{{}, std::move(notes_)};
    for (LevelledRoom& levelled : rooms_) truth.rooms.push_back(std::move(levelled.room));
    return truth;
  }

 private:
  void note(int id, const std::string& what) {
    notes_.push_back(where_ + ": " + named(id) + " " + what);
  }

  void keepMainPiece(EvaluatedRoom& room) {
    const double whole = area(room);
    if (area(room.parts.front()) < kTruthMainPieceShare * whole) {
      throw refuse(where_ + ": " + named(room.id),
                   "crosses itself and falls apart into " + std::to_string(room.parts.size()) +
                       " pieces, the largest of " + inSquareMetres(area(room.parts.front())),
                   "an outline that does not cross itself is needed");
    }
    note(room.id, "crosses itself; its main piece is kept, " +
                      inSquareMetres(whole - area(room.parts.front())) + " are left out");
    room.parts.resize(1);
  }

  [[nodiscard]] bool isDuplicate(std::size_t i, std::size_t j) const {
    const EvaluatedRoom& a = rooms_[i].room;
    const EvaluatedRoom& b = rooms_[j].room;
    const double common = intersectionArea(a, b);
    return common > 0.0 && common >= kDuplicateIou * (area(a) + area(b) - common);
  }

  void separate(EvaluatedRoom& a, EvaluatedRoom& b) {
    const double common = intersectionArea(a, b);
    EvaluatedRoom& smaller = area(b) <= area(a) ? b : a;
    EvaluatedRoom& larger = area(b) <= area(a) ? a : b;
    // A room smaller than the tolerance can still lie within another.
    const bool inside = common > 0.0 && common >= kTruthInsideShare * area(smaller);
    if (!inside && common <= kTruthOverlapTolerance_m2) return;
    if (!inside) {
      throw refuse(where_ + ": " + named(b.id),
                   "overlaps " + named(a.id) + " by " + inSquareMetres(common),
                   "rooms of one storey must not overlap, or one must lie within the other");
    }
    std::vector<Polygon> rest;
    for (const Polygon& part : larger.parts)
      for (Polygon& piece : difference(part, smaller.parts)) rest.push_back(std::move(piece));
    larger.parts = std::move(rest);
    note(smaller.id, "lies within " + named(larger.id) + " and is cut out of it");
  }

  std::string where_;
  std::vector<LevelledRoom> rooms_;
  std::vector<std::string> notes_;
};

}  // namespace

SoundTruth soundTruth(const std::vector<TruthRoom>& rooms, const std::string& where) {
  TruthRepair repair(where);
  for (const TruthRoom& room : rooms) {
    checkCoordinates(room.polygon, where + ": " + named(room.id));
    for (const Polygon& part : room.further_parts)
      checkCoordinates(part, where + ": " + named(room.id));
    repair.add(room);
  }
  repair.separate();
  return std::move(repair).result();
}

}  // namespace occusg
