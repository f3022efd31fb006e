// SPDX-License-Identifier: BSD-3-Clause
#include "io/house_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

#include "io/file_bytes.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/geometry/polygon_overlap.hpp"

namespace occusg {
namespace {

/// Normals steeper than this make a floor or a ceiling.
constexpr double kVerticalNormal = 0.85;

struct Surface {
  int region = 0;
  bool is_horizontal = false;
  Ring vertices;  ///< In file order, in the ground plane.
};

struct Region {
  int level = 0;
  std::string label;
};

struct Portal {
  int region_a = 0;
  int region_b = 0;
  Segment2 segment;
};

struct House {
  std::map<int, Region> regions;
  std::map<int, Surface> surfaces;
  std::vector<Portal> portals;
};

/// The words of one line, read with sentences that name it.
class Record {
 public:
  Record(const std::string& line, std::string where)
      : words_(wordsOf(line)), where_(std::move(where)) {}

  [[nodiscard]] bool empty() const { return words_.empty(); }
  [[nodiscard]] const std::string& where() const { return where_; }

  [[nodiscard]] const std::string& word(std::size_t i) const {
    if (i >= words_.size()) {
      throw refuse(where_, "has " + std::to_string(words_.size()) + " words",
                   "a " + shown(words_.front()) + " record has more");
    }
    return words_[i];
  }
  [[nodiscard]] double number(std::size_t i) const {
    const auto value = numberIn(word(i));
    if (!value || std::abs(*value) > kMaxRoomCoordinate_m) {
      throw refuse(where_, "word " + std::to_string(i + 1) + " is '" + shown(word(i)) + "'",
                   "a number within 1e6 is needed");
    }
    return *value;
  }
  [[nodiscard]] bool isInteger(std::size_t i) const {
    const auto value = i < words_.size() ? numberIn(words_[i]) : std::nullopt;
    return value && *value == std::floor(*value) && std::abs(*value) < 1e9;
  }
  [[nodiscard]] int integer(std::size_t i) const {
    if (!isInteger(i)) {
      throw refuse(where_, "word " + std::to_string(i + 1) + " is '" + shown(word(i)) + "'",
                   "an integer is needed");
    }
    return static_cast<int>(*numberIn(words_[i]));
  }

 private:
  std::vector<std::string> words_;
  std::string where_;
};

template <typename T>
void requireRoom(const std::map<int, T>& values, std::size_t limit, const Record& record) {
  if (values.size() < limit) return;
  throw refuse(record.where(), "is one more than " + std::to_string(limit) + " of its kind",
               "a smaller house is needed");
}

void readRegion(const Record& record, House& house) {
  requireRoom(house.regions, kMaxHouseRegions, record);
  const int index = record.integer(1);
  if (index < 0) throw refuse(record.where(), "region " + std::to_string(index), "must be >= 0");
  if (!house.regions.emplace(index, Region{record.integer(2), record.word(5)}).second) {
    throw refuse(record.where(), "region " + std::to_string(index) + " appears twice",
                 "indices must be different");
  }
}

void readSurface(const Record& record, House& house) {
  requireRoom(house.surfaces, kMaxHouseSurfaces, record);
  const std::string& label = record.word(4);
  const bool horizontal =
      label == "F" || label == "f" || std::abs(record.number(10)) > kVerticalNormal;
  house.surfaces[record.integer(1)] = {record.integer(2), horizontal, {}};
}

void readVertex(const Record& record, House& house) {
  const auto surface = house.surfaces.find(record.integer(2));
  if (surface == house.surfaces.end()) {
    throw refuse(record.where(), "names surface " + std::to_string(record.integer(2)),
                 "a surface above it is needed");
  }
  surface->second.vertices.push_back({record.number(4), record.number(5)});
}

/// Its opening is the longer middle line of its box; a panorama is a P record with a name.
void readPortal(const Record& record, House& house) {
  if (!record.isInteger(1)) return;
  const Point2 low{record.number(5), record.number(6)};
  const Point2 high{record.number(8), record.number(9)};
  const Point2 middle = midpoint({low, high});
  const bool along_x = std::abs(high.x - low.x) >= std::abs(high.y - low.y);
  const Segment2 segment = along_x ? Segment2{{low.x, middle.y}, {high.x, middle.y}}
                                   : Segment2{{middle.x, low.y}, {middle.x, high.y}};
  house.portals.push_back({record.integer(2), record.integer(3), segment});
}

House houseIn(const std::string& text, const std::string& where) {
  House house;
  std::istringstream lines(text);
  std::size_t vertices = 0;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    const Record record(line, where + ":" + std::to_string(++number));
    if (record.empty()) continue;
    const std::string& kind = record.word(0);
    if (kind == "R") readRegion(record, house);
    if (kind == "S") readSurface(record, house);
    if (kind == "P") readPortal(record, house);
    if (kind != "V") continue;
    if (++vertices > kMaxHouseVertices) {
      throw refuse(record.where(), "more than " + std::to_string(kMaxHouseVertices) + " vertices",
                   "a smaller house is needed");
    }
    readVertex(record, house);
  }
  return house;
}

/// Names of Matterport3D's region codes, as its documentation gives them.
std::string labelNamed(const std::string& code) {
  static const std::map<std::string, std::string> kNames{
      {"a", "bathroom"},     {"b", "bedroom"},      {"c", "closet"},    {"d", "dining_room"},
      {"e", "entryway"},     {"f", "family_room"},  {"g", "garage"},    {"h", "hallway"},
      {"i", "library"},      {"j", "laundry_room"}, {"k", "kitchen"},   {"l", "living_room"},
      {"m", "meeting_room"}, {"n", "lounge"},       {"o", "office"},    {"p", "porch"},
      {"r", "game_room"},    {"s", "stairs"},       {"t", "toilet"},    {"u", "utility_room"},
      {"v", "tv_room"},      {"w", "gym"},          {"x", "outdoor"},   {"y", "balcony"},
      {"z", "other_room"},   {"B", "bar"},          {"C", "classroom"}, {"D", "dining_booth"},
      {"S", "spa"},          {"Z", "junk"}};
  const auto name = kNames.find(code);
  return name == kNames.end() ? "unknown" : name->second;
}

std::vector<Polygon> footprintOf(const std::vector<const Surface*>& surfaces) {
  std::vector<Polygon> faces;
  Ring all;
  for (const Surface* surface : surfaces) {
    all.insert(all.end(), surface->vertices.begin(), surface->vertices.end());
    if (!surface->is_horizontal || surface->vertices.size() < 3) continue;
    for (Polygon& face : repaired({surface->vertices, {}})) faces.push_back(std::move(face));
  }
  std::vector<Polygon> footprint = united(faces);
  if (!footprint.empty()) return footprint;
  Polygon hull{convexHull(all), {}};
  if (hull.outer.size() >= 3 && area(hull) > 0.0) footprint.push_back(std::move(hull));
  return footprint;
}

std::map<int, std::vector<const Surface*>> surfacesByRegion(const House& house) {
  std::map<int, std::vector<const Surface*>> by_region;
  for (const auto& [index, surface] : house.surfaces) by_region[surface.region].push_back(&surface);
  return by_region;
}

}  // namespace

HouseTruth parseHouse(const std::string& text, const std::string& where,
                      const std::optional<int>& level) {
  const House house = houseIn(text, where);
  if (house.regions.empty())
    throw refuse(where, "has no region (R record)", "a Matterport3D .house file is needed");
  auto surfaces = surfacesByRegion(house);
  HouseTruth truth;
  for (const auto& [index, region] : house.regions) {
    if (level && region.level != *level) continue;
    std::vector<Polygon> footprint = footprintOf(surfaces[index]);
    if (footprint.empty()) {
      truth.notes.push_back(where + ": region " + std::to_string(index) +
                            " has no footprint and is left out");
      continue;
    }
    RoomRecord room{
        index + 1, labelNamed(region.label), std::move(footprint.front()), region.level, {}};
    std::move(footprint.begin() + 1, footprint.end(), std::back_inserter(room.further_parts));
    truth.rooms.rooms.push_back(std::move(room));
  }
  if (truth.rooms.rooms.empty()) {
    throw refuse(where,
                 level ? "level " + std::to_string(*level) + " has no region with a footprint"
                       : "no region has a footprint",
                 "at least one is needed");
  }
  const auto isKept = [&](int region) {
    const auto& rooms = truth.rooms.rooms;
    return std::any_of(rooms.begin(), rooms.end(),
                       [region](const RoomRecord& room) { return room.id == region + 1; });
  };
  for (const Portal& portal : house.portals) {
    if (isKept(portal.region_a) && isKept(portal.region_b))
      truth.rooms.doors.push_back({portal.region_a + 1, portal.region_b + 1, portal.segment});
  }
  return truth;
}

HouseTruth readHouse(const std::string& path, const std::optional<int>& level) {
  HouseTruth truth = parseHouse(readFile(path, kMaxHouseBytes), path, level);
  truth.rooms.scene = std::filesystem::path(path).stem().string();
  return truth;
}

}  // namespace occusg
