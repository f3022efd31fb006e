// SPDX-License-Identifier: BSD-3-Clause
#include "io/building_json.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "io/graph_json.hpp"
#include "io/json_text.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/graph/limits.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxStoreys = 200;
constexpr std::size_t kMaxPassages = 10'000;
constexpr std::size_t kMaxPathPoints = 100'000;

const json& listOf(const json& value, const char* key, const std::string& where, std::size_t most) {
  const std::string place = where + ": " + key;
  const json& list = arrayOf(member(value, key, where), place);
  if (list.size() > most) {
    throw refuse(place, "are " + std::to_string(list.size()),
                 "at most " + std::to_string(most) + " are read");
  }
  return list;
}

double heightOf(const json& value, const std::string& where) {
  const double z_m = numberOf(value, where);
  if (!(std::abs(z_m) <= kMaxGraphCoordinate_m))
    throw refuse(where, "is " + toText(z_m), "a height of at most 1e6 m is needed");
  return z_m;
}

StairsKind kindIn(const json& value, const std::string& where) {
  const std::string name = stringOf(value, where);
  for (const StairsKind kind : {StairsKind::kStairs, StairsKind::kRamp, StairsKind::kLift})
    if (name == nameOf(kind)) return kind;
  throw refuse(where, "is \"" + shown(name) + "\"", "stairs, ramp or lift is needed");
}

Eigen::Vector3d pointIn(const json& value, const std::string& where) {
  if (arrayOf(value, where).size() != 3) {
    throw refuse(where, "has a point of " + std::to_string(value.size()) + " values",
                 "[x, y, z] is needed");
  }
  return {heightOf(value[0], where), heightOf(value[1], where), heightOf(value[2], where)};
}

/// Index of a storey.
int storeyIn(const json& value, const std::string& where, std::size_t storeys) {
  const int storey = integerOf(value, where);
  if (storey < 0 || static_cast<std::size_t>(storey) >= storeys) {
    throw refuse(where, "names storey " + std::to_string(storey),
                 "there are " + std::to_string(storeys) + ", counted from 0");
  }
  return storey;
}

StoreyPassage passageIn(const json& value, const std::string& where, std::size_t storeys) {
  StoreyPassage passage;
  passage.kind = kindIn(member(value, "kind", where), where + ": kind");
  const json& ends = listOf(value, "storeys", where, 2);
  if (ends.size() != 2) throw refuse(where, "has not two storeys", "[lower, upper] is needed");
  passage.lower_storey = storeyIn(ends[0], where + ": storeys", storeys);
  passage.upper_storey = storeyIn(ends[1], where + ": storeys", storeys);
  passage.risers = integerOf(member(value, "risers", where), where + ": risers");
  for (const json& point : listOf(value, "path", where, kMaxPathPoints))
    passage.path.push_back(pointIn(point, where + ": path"));
  if (passage.path.size() < 2)
    throw refuse(where, "has a path of one point or none", "two points at least are needed");
  return passage;
}

}  // namespace

json jsonOf(const Building& building) {
  json storeys = json::array();
  for (const Storey& storey : building.storeys)
    storeys.push_back({{"floor_z", rounded(storey.floor_z_m)}});
  json stairs = json::array();
  for (const StoreyPassage& passage : building.passages) {
    json path = json::array();
    for (const Eigen::Vector3d& feet : passage.path) path.push_back(jsonOf(feet));
    stairs.push_back({{"kind", nameOf(passage.kind)},
                      {"storeys", json::array({passage.lower_storey, passage.upper_storey})},
                      {"risers", passage.risers},
                      {"path", std::move(path)}});
  }
  return {{"current_storey", building.current},
          {"sensor_height_m", rounded(building.sensor_height_m)},
          {"storeys", std::move(storeys)},
          {"stairs", std::move(stairs)}};
}

Building buildingIn(const json& value, const std::string& where) {
  Building building;
  for (const json& storey : listOf(value, "storeys", where, kMaxStoreys)) {
    const std::string place = where + ": storeys";
    const double floor_z_m = heightOf(member(storey, "floor_z", place), place + ": floor_z");
    building.storeys.push_back({static_cast<int>(building.storeys.size()), floor_z_m, {}});
  }
  if (building.storeys.empty()) throw refuse(where, "has no storeys", "one at least is needed");
  divideHeights(building.storeys);
  const std::size_t count = building.storeys.size();
  building.current = static_cast<std::size_t>(
      storeyIn(member(value, "current_storey", where), where + ": current_storey", count));
  building.sensor_height_m =
      numberOf(member(value, "sensor_height_m", where), where + ": sensor_height_m");
  for (const json& passage : listOf(value, "stairs", where, kMaxPassages))
    building.passages.push_back(passageIn(passage, where + ": stairs", count));
  return building;
}

}  // namespace occusg
