// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/rooms_file.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "io/polygon_json.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxRoomsFileBytes = std::size_t{64} << 20U;

RoomRecord roomOf(const json& value, const std::string& file, std::size_t index,
                  RingReader& rings) {
  RoomRecord room;
  const std::string at_index = file + ": rooms[" + std::to_string(index) + "]";
  room.id = integerOf(member(value, "id", at_index), at_index + " id");
  const std::string where = file + ": room " + std::to_string(room.id);
  if (const json* label = optionalMember(value, "label", where); label != nullptr)
    room.label = stringOf(*label, where + " label");
  room.polygon = rings.polygonOf(value, where);
  for (const char* name : {"level", "storey"}) {
    if (const json* level = optionalMember(value, name, where); level != nullptr)
      room.level = integerOf(*level, where + " " + name);
  }
  const json* parts = optionalMember(value, "further_parts", where);
  if (parts == nullptr) return room;
  for (const json& part : arrayOf(*parts, where + " further_parts"))
    room.further_parts.push_back(rings.polygonOf(part, where + " further part"));
  return room;
}

std::vector<RoomRecord> roomsOf(const json& values, const std::string& file, RingOrder order) {
  if (arrayOf(values, file + ": rooms").size() > kMaxRooms) {
    throw refuse(file, "has " + std::to_string(values.size()) + " rooms",
                 "at most " + std::to_string(kMaxRooms) + " are read");
  }
  std::vector<RoomRecord> rooms;
  rooms.reserve(values.size());
  std::set<int> ids;
  RingReader rings(file, order);
  for (std::size_t i = 0; i < values.size(); ++i) {
    rooms.push_back(roomOf(values[i], file, i, rings));
    if (!ids.insert(rooms.back().id).second) {
      throw refuse(file, "room id " + std::to_string(rooms.back().id) + " appears twice",
                   "ids must be different");
    }
  }
  return rooms;
}

std::vector<StoreyRecord> storeysOf(const json& values, const std::string& file) {
  constexpr std::size_t kMaxStoreys = 1000;
  if (arrayOf(values, file + ": storeys").size() > kMaxStoreys) {
    throw refuse(file, "has " + std::to_string(values.size()) + " storeys",
                 "at most " + std::to_string(kMaxStoreys) + " are read");
  }
  std::vector<StoreyRecord> storeys;
  std::set<int> ids;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string where = file + ": storeys[" + std::to_string(i) + "]";
    StoreyRecord storey;
    storey.id = integerOf(member(values[i], "id", where), where + " id");
    storey.floor_z_m = coordinateOf(member(values[i], "floor_z", where), where + " floor_z");
    if (const json* ceiling = optionalMember(values[i], "ceiling_z", where); ceiling != nullptr)
      storey.ceiling_z_m = coordinateOf(*ceiling, where + " ceiling_z");
    if (!ids.insert(storey.id).second) {
      throw refuse(file, "storey id " + std::to_string(storey.id) + " appears twice",
                   "ids must be different");
    }
    storeys.push_back(storey);
  }
  return storeys;
}

json jsonOf(const std::vector<StoreyRecord>& storeys) {
  json values = json::array();
  for (const StoreyRecord& storey : storeys) {
    json value = {{"id", storey.id}, {"floor_z", rounded(storey.floor_z_m)}};
    if (storey.ceiling_z_m) value["ceiling_z"] = rounded(*storey.ceiling_z_m);
    values.push_back(std::move(value));
  }
  return values;
}

json jsonOf(const std::vector<StairsRecord>& stairs) {
  json values = json::array();
  for (const StairsRecord& one : stairs) {
    values.push_back({{"kind", one.kind},
                      {"rooms", json::array({one.lower_room, one.upper_room})},
                      {"storeys", json::array({one.lower_storey, one.upper_storey})},
                      {"risers", one.risers},
                      {"footprint", jsonOf(one.footprint)}});
  }
  return values;
}

json jsonOf(const Polygon& polygon) {
  return {{"polygon", jsonOf(polygon.outer)}, {"holes", holesOf(polygon)}};
}

DoorRecord doorOf(const json& value, const std::string& where, const std::set<int>& room_ids) {
  DoorRecord door;
  const json& pair = arrayOf(member(value, "rooms", where), where + " rooms");
  if (pair.size() != 2) {
    throw refuse(where, "joins " + std::to_string(pair.size()) + " rooms",
                 "two room ids are needed");
  }
  door.room_a = integerOf(pair[0], where + " rooms[0]");
  door.room_b = integerOf(pair[1], where + " rooms[1]");
  for (const int id : {door.room_a, door.room_b}) {
    if (room_ids.count(id) == 0) {
      throw refuse(where, "names room " + std::to_string(id),
                   "ids of rooms in the file are needed");
    }
  }
  door.segment = segmentOf(member(value, "segment", where), where + " segment");
  return door;
}

std::vector<DoorRecord> doorsOf(const json& values, const std::string& file,
                                const std::vector<RoomRecord>& rooms) {
  constexpr std::size_t kMaxDoors = kMaxGraphEdges;
  if (arrayOf(values, file + ": doors").size() > kMaxDoors) {
    throw refuse(file, "has " + std::to_string(values.size()) + " doors",
                 "at most " + std::to_string(kMaxDoors) + " are read");
  }
  std::set<int> ids;
  for (const RoomRecord& room : rooms) ids.insert(room.id);
  std::vector<DoorRecord> doors;
  doors.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    doors.push_back(doorOf(values[i], file + ": doors[" + std::to_string(i) + "]", ids));
  return doors;
}

}  // namespace

RoomsFile parseRooms(const std::string& text, const std::string& where, RingOrder order) {
  const json document = parseJson(text, where, kMaxGraphValues);
  RoomsFile file;
  if (const json* scene = optionalMember(document, "scene", where); scene != nullptr)
    file.scene = stringOf(*scene, where + ": scene");
  if (const json* frame = optionalMember(document, "frame", where); frame != nullptr)
    file.frame = stringOf(*frame, where + ": frame");
  if (const json* floor = optionalMember(document, "floor_z", where); floor != nullptr)
    file.floor_z_m = coordinateOf(*floor, where + ": floor_z");
  if (const json* storeys = optionalMember(document, "storeys", where); storeys != nullptr)
    file.storeys = storeysOf(*storeys, where);
  file.rooms = roomsOf(member(document, "rooms", where), where, order);
  if (const json* doors = optionalMember(document, "doors", where); doors != nullptr)
    file.doors = doorsOf(*doors, where, file.rooms);
  return file;
}

RoomsFile readRooms(const std::string& path, RingOrder order) {
  return parseRooms(readFile(path, kMaxRoomsFileBytes), path, order);
}

std::string toJson(const RoomsFile& file) {
  json rooms = json::array();
  for (const RoomRecord& room : file.rooms) {
    json object = jsonOf(room.polygon);
    object["id"] = room.id;
    object["label"] = room.label;
    if (!file.storeys.empty()) {
      object["storey"] = room.level;
    } else if (room.level != 0) {
      object["level"] = room.level;
    }
    for (const Polygon& part : room.further_parts) object["further_parts"].push_back(jsonOf(part));
    rooms.push_back(std::move(object));
  }
  json doors = json::array();
  for (const DoorRecord& door : file.doors) {
    doors.push_back({{"rooms", json::array({door.room_a, door.room_b})},
                     {"segment", jsonOf(Ring{door.segment.a, door.segment.b})}});
  }
  std::vector<std::pair<std::string, json>> members = {
      {"scene", file.scene}, {"frame", file.frame}, {"floor_z", rounded(file.floor_z_m)}};
  if (!file.storeys.empty()) members.emplace_back("storeys", jsonOf(file.storeys));
  members.emplace_back("rooms", std::move(rooms));
  members.emplace_back("doors", std::move(doors));
  if (!file.stairs.empty()) members.emplace_back("stairs", jsonOf(file.stairs));
  return jsonDocument(members);
}

}  // namespace occusg
