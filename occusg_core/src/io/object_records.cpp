// SPDX-License-Identifier: BSD-3-Clause
#include "io/object_records.hpp"

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "io/json_text.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

using nlohmann::json;

const json& listOf(const json& value, const std::string& where) {
  if (arrayOf(value, where).size() > kMaxObjects * 10) {
    throw refuse(where, "has " + std::to_string(value.size()) + " elements",
                 "at most " + std::to_string(kMaxObjects * 10) + " are read");
  }
  return value;
}

Point2 pointOf(const json& value, const std::string& where) {
  if (arrayOf(value, where).size() != 3)
    throw refuse(where, "has " + std::to_string(value.size()) + " numbers", "[x, y, z] is needed");
  return {numberOf(value[0], where + " x"), numberOf(value[1], where + " y")};
}

std::set<int> unseenObjects(const std::string& text, const std::string& where) {
  const json document = parseJson(text, where);
  std::set<int> unseen;
  for (const json& object : listOf(document, where)) {
    const int id = integerOf(member(object, "id", where), where + " id");
    if (numberOf(member(object, "pixels", where), where + " pixels") <= 0.0) unseen.insert(id);
  }
  return unseen;
}

ObjectRecord truthObject(const json& value, const std::string& file) {
  ObjectRecord object;
  object.id = integerOf(member(value, "id", file + ": objects"), file + ": objects id");
  const std::string where = file + ": object " + std::to_string(object.id);
  object.label = stringOf(member(value, "label", where), where + " label");
  const json& box = arrayOf(member(value, "bbox", where), where + " bbox");
  if (box.size() != 2) {
    throw refuse(where + " bbox", "has " + std::to_string(box.size()) + " corners",
                 "two are needed");
  }
  const Point2 low = pointOf(box[0], where + " bbox[0]");
  const Point2 high = pointOf(box[1], where + " bbox[1]");
  object.position = midpoint({low, high});
  const json* room = optionalMember(value, "room", where);
  if (room != nullptr && !room->is_null()) object.room_id = integerOf(*room, where + " room");
  return object;
}

/// n of "room_<n>", the id in rooms.json.
int roomIdOf(const json& node, const std::string& where) {
  const std::string name = stringOf(member(node, "name", where), where + " name");
  const std::string head = "room_";
  const std::string digits = name.size() > head.size() ? name.substr(head.size()) : "";
  if (name.compare(0, head.size(), head) != 0 || digits.empty() || digits.size() > 9 ||
      digits.find_first_not_of("0123456789") != std::string::npos)
    throw refuse(where + " name", "is '" + name + "'", "'room_<number>' is needed");
  return std::stoi(digits);
}

/// Ids of nodes are numbers or texts; as text they compare either way.
std::string nodeId(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

std::vector<ObjectRecord> parseTruthObjects(const std::string& rooms_text, const std::string& where,
                                            const std::optional<std::string>& seen) {
  const json document = parseJson(rooms_text, where);
  const json* objects = optionalMember(document, "objects", where);
  if (objects == nullptr) return {};
  const std::set<int> unseen =
      seen ? unseenObjects(*seen, where + ": seen objects") : std::set<int>{};
  std::vector<ObjectRecord> records;
  for (const json& object : listOf(*objects, where + ": objects")) {
    ObjectRecord record = truthObject(object, where);
    if (unseen.count(record.id) == 0) records.push_back(std::move(record));
  }
  return records;
}

std::vector<ObjectRecord> parseGraphObjects(const std::string& text, const std::string& where) {
  const json document = parseJson(text, where);
  std::map<std::string, int> rooms;
  std::map<std::string, std::size_t> index_of;
  std::vector<ObjectRecord> objects;
  for (const json& node : listOf(member(document, "nodes", where), where + ": nodes")) {
    const std::string id = nodeId(member(node, "id", where + ": nodes"));
    std::string at = where;
    at += ": node " + id;
    const std::string type = stringOf(member(node, "type", at), at + " type");
    if (type == "ROOM") rooms[id] = roomIdOf(node, at);
    if (type != "OBJECT") continue;
    index_of[id] = objects.size();
    objects.push_back({static_cast<int>(objects.size()) + 1,
                       stringOf(member(node, "class", at), at + " class"),
                       pointOf(member(node, "position", at), at + " position"), std::nullopt});
  }
  for (const json& edge : listOf(member(document, "edges", where), where + ": edges")) {
    const std::string at = where + ": edges";
    if (stringOf(member(edge, "type", at), at + " type") != "ROOM_CONTAINS") continue;
    const auto room = rooms.find(nodeId(member(edge, "source", at)));
    const auto object = index_of.find(nodeId(member(edge, "target", at)));
    if (room != rooms.end() && object != index_of.end())
      objects[object->second].room_id = room->second;
  }
  return objects;
}

}  // namespace occusg
