// SPDX-License-Identifier: BSD-3-Clause
#include "io/session_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "io/building_json.hpp"
#include "io/graph_json.hpp"
#include "io/json_text.hpp"
#include "io/polygon_json.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/io/session_folder.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "occusg-session";
constexpr std::size_t kMaxTracks = 100'000;

json stampOf(double stamp_s) { return rounded(stamp_s, kStampDigits); }

json optionalStampOf(const std::optional<double>& stamp_s) {
  return stamp_s ? stampOf(*stamp_s) : json(nullptr);
}

json poseOf(const Pose& pose) {
  const Eigen::Quaterniond q = canonicalRotation(pose);
  const Eigen::Vector3d t = pose.translation();
  return json::array(
      {rounded(t.x(), 6), rounded(t.y(), 6), rounded(t.z(), 6), q.x(), q.y(), q.z(), q.w()});
}

json filesOf(const std::map<std::string, FileMark>& files) {
  json members = json::object();
  for (const auto& [name, mark] : files)
    members[name] = {{"bytes", mark.bytes}, {"fnv1a", std::to_string(mark.checksum)}};
  return members;
}

json tracksOf(const RegionTrackerState& tracker) {
  if (tracker.tracks.size() > kMaxTracks) {
    throw refuse("session", "has " + std::to_string(tracker.tracks.size()) + " regions",
                 "at most " + std::to_string(kMaxTracks) + " can be read back");
  }
  json tracks = json::array();
  for (const RegionTrackerState::Track& track : tracker.tracks) {
    tracks.push_back({{"id", track.id},
                      {"missed_updates", track.missed_updates},
                      {"polygon", jsonOf(track.polygon.outer)},
                      {"holes", holesOf(track.polygon)}});
  }
  return tracks;
}

/// [[key, value], ...]
template <typename Key, typename Value>
json pairsOf(const std::map<Key, Value>& values) {
  json pairs = json::array();
  for (const auto& [key, value] : values) pairs.push_back(json::array({key, value}));
  return pairs;
}

/// [[object, object, frames], ...]
json seenApartOf(const ObjectPairCounts& pairs) {
  json list = json::array();
  for (const auto& [ids, frames] : pairs)
    list.push_back(json::array({ids.first, ids.second, frames}));
  return list;
}

json nextIdsOf(const SceneGraph& graph) {
  json ids = json::object();
  for (std::size_t i = 0; i < kNodeTypeCount; ++i) {
    const auto type = static_cast<NodeType>(i);
    ids[nameOf(type)] = graph.nextId(type);
  }
  return ids;
}

std::optional<double> optionalStamp(const json& document, const char* key,
                                    const std::string& where) {
  const json& value = member(document, key, where);
  if (value.is_null()) return std::nullopt;
  return numberOf(value, where + ": " + key);
}

Pose poseIn(const json& value, const std::string& where) {
  if (arrayOf(value, where).size() != 7)
    throw refuse(where, "has " + std::to_string(value.size()) + " values", "7 are needed");
  std::array<double, 7> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = numberOf(value[i], where);
  }
  const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
  if (std::abs(q.norm() - 1.0) > kUnitQuaternionTolerance) {
    throw refuse(where, "has a rotation of norm " + toText(q.norm()),
                 "a unit quaternion is needed");
  }
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  return pose;
}

std::map<std::string, FileMark> filesIn(const json& value, const std::string& where,
                                        std::size_t storeys) {
  std::map<std::string, FileMark> files;
  std::vector<std::string> names;
  for (std::size_t storey = 0; storey < storeys; ++storey) names.push_back(graphFileOf(storey));
  if (value.is_object() && value.contains("map.ot")) names.emplace_back("map.ot");
  for (const std::string& name : names) {
    std::string place = where;
    place.append(" ").append(name);
    const json& mark = member(value, name, where);
    const json& bytes = member(mark, "bytes", place);
    const std::string checksum = stringOf(member(mark, "fnv1a", place), place + " fnv1a");
    FileMark& read = files[name];
    if (!bytes.is_number_unsigned() || !parseChecksum(checksum, read.checksum))
      throw refuse(place, "has no size and checksum", "a whole session is needed");
    read.bytes = bytes.get<std::size_t>();
  }
  return files;
}

void checkCount(const json& list, const std::string& where) {
  if (arrayOf(list, where).size() <= kMaxTracks) return;
  throw refuse(where, "are " + std::to_string(list.size()),
               "at most " + std::to_string(kMaxTracks) + " are read");
}

RegionTrackerState trackerIn(const json& document, const std::string& where) {
  RegionTrackerState tracker;
  tracker.next_id =
      integerOf(member(document, "next_region_id", where), where + ": next_region_id");
  const json& tracks = member(document, "regions", where);
  checkCount(tracks, where + ": regions");
  RingReader rings(where);
  for (const json& value : tracks) {
    RegionTrackerState::Track track;
    track.id = integerOf(member(value, "id", where + ": regions"), where + ": region id");
    const std::string place = where + ": region " + std::to_string(track.id);
    const int previous = tracker.tracks.empty() ? 0 : tracker.tracks.back().id;
    if (track.id <= previous || track.id >= tracker.next_id) {
      throw refuse(place, "comes after region " + std::to_string(previous),
                   "ids must rise and stay below " + std::to_string(tracker.next_id));
    }
    track.missed_updates =
        integerOf(member(value, "missed_updates", place), place + " missed_updates");
    track.polygon = rings.polygonOf(value, place);
    tracker.tracks.push_back(std::move(track));
  }
  return tracker;
}

/// Reads [[key, value], ...]; `valueOf` reads a value.
template <typename Key, typename Value, typename ValueOf>
std::map<Key, Value> pairsIn(const json& list, const std::string& where, const ValueOf& valueOf) {
  checkCount(list, where);
  std::map<Key, Value> values;
  for (const json& pair : list) {
    if (arrayOf(pair, where).size() != 2)
      throw refuse(where, "has an entry that is no pair", "[key, value] is needed");
    values[integerOf(pair[0], where)] = valueOf(pair[1], where);
  }
  return values;
}

int countOf(const json& value, const std::string& where) {
  const int count = integerOf(value, where);
  if (count < 1)
    throw refuse(where, "has a count of " + std::to_string(count), "it must be positive");
  return count;
}

ObjectPairCounts seenApartIn(const json& list, const std::string& where) {
  checkCount(list, where);
  ObjectPairCounts pairs;
  for (const json& entry : list) {
    if (arrayOf(entry, where).size() != 3)
      throw refuse(where, "has an entry that is no triple", "[object, object, frames] is needed");
    const NodeId low = integerOf(entry[0], where);
    const NodeId high = integerOf(entry[1], where);
    if (low >= high) {
      throw refuse(where, "names object " + std::to_string(low) + " before " + std::to_string(high),
                   "the smaller id comes first");
    }
    pairs[{low, high}] = countOf(entry[2], where);
  }
  return pairs;
}

/// A session of a version that did not save them has none of these members.
ObjectLayerState objectsIn(const json& document, const std::string& where) {
  ObjectLayerState objects;
  if (const json* apart = optionalMember(document, "objects_seen_apart", where))
    objects.seen_apart = seenApartIn(*apart, where + ": objects_seen_apart");
  if (const json* checks = optionalMember(document, "object_free_checks", where))
    objects.free_checks = pairsIn<NodeId, int>(*checks, where + ": object_free_checks", countOf);
  if (const json* last = optionalMember(document, "last_checked_object", where))
    objects.last_checked = integerOf(*last, where + ": last_checked_object");
  return objects;
}

std::map<NodeType, NodeId> nextIdsIn(const json& value, const std::string& where) {
  std::map<NodeType, NodeId> ids;
  for (std::size_t i = 0; i < kNodeTypeCount; ++i) {
    const auto type = static_cast<NodeType>(i);
    ids[type] = integerOf(member(value, nameOf(type), where), where + " " + nameOf(type));
  }
  return ids;
}

void checkSessionKind(const json& document, const std::string& where) {
  const std::string format = stringOf(member(document, "format", where), where + ": format");
  if (format != kFormat) {
    throw refuse(where, "has the format \"" + shown(format) + "\"",
                 std::string("\"") + kFormat + "\" is needed");
  }
  const int version = integerOf(member(document, "version", where), where + ": version");
  if (version != kSessionVersion && version != kStoreysSessionVersion) {
    throw refuse(where, "has version " + std::to_string(version),
                 "version " + std::to_string(kSessionVersion) + " or " +
                     std::to_string(kStoreysSessionVersion) + " is read");
  }
}

using JsonMembers = std::vector<std::pair<std::string, json>>;

/// What one storey's rooms follow from.
JsonMembers membersOf(const RoomPipelineState& rooms) {
  return {{"last_room_update_s", optionalStampOf(rooms.last_room_update_s)},
          {"last_graph_update_s", optionalStampOf(rooms.graph.last_update_s)},
          {"last_maintenance_s", stampOf(rooms.graph.last_maintenance_s)},
          {"next_ids", nextIdsOf(rooms.graph.graph)},
          {"next_region_id", rooms.tracker.next_id},
          {"regions", tracksOf(rooms.tracker)},
          {"region_first_seen_s", pairsOf(rooms.graph.rooms.first_seen_s)},
          {"former_room_of_region", pairsOf(rooms.graph.rooms.former_room_of_region)},
          {"objects_seen_apart", seenApartOf(rooms.graph.objects.seen_apart)},
          {"object_free_checks", pairsOf(rooms.graph.objects.free_checks)},
          {"last_checked_object", rooms.graph.objects.last_checked}};
}

RoomPipelineState roomsIn(const json& document, const std::string& where) {
  RoomPipelineState rooms;
  rooms.last_room_update_s = optionalStamp(document, "last_room_update_s", where);
  rooms.graph.last_update_s = optionalStamp(document, "last_graph_update_s", where);
  rooms.graph.last_maintenance_s =
      numberOf(member(document, "last_maintenance_s", where), where + ": last_maintenance_s");
  rooms.tracker = trackerIn(document, where);
  rooms.graph.rooms.first_seen_s = pairsIn<int, double>(
      member(document, "region_first_seen_s", where), where + ": region_first_seen_s", numberOf);
  rooms.graph.rooms.former_room_of_region =
      pairsIn<int, NodeId>(member(document, "former_room_of_region", where),
                           where + ": former_room_of_region", integerOf);
  rooms.graph.objects = objectsIn(document, where);
  return rooms;
}

/// Whether there is anything to tell: a floor was seen, or there are storeys without a sensor.
bool isKnown(const Building& building) {
  return building.storeys.size() > 1 || building.sensor_height_m > 0.0;
}

}  // namespace

std::string graphFileOf(std::size_t storey) {
  return storey == 0 ? "scene_graph.json" : "scene_graph_" + std::to_string(storey) + ".json";
}

std::string toSessionJson(const SessionState& state, const std::map<std::string, FileMark>& files) {
  const int version = state.further_storeys.empty() ? kSessionVersion : kStoreysSessionVersion;
  JsonMembers members = {{"format", kFormat},
                         {"version", version},
                         {"scene", state.scene},
                         {"files", filesOf(files)},
                         {"stamp_s", stampOf(state.stamp_s)},
                         {"pose", poseOf(state.T_map_agent)}};
  for (auto& member : membersOf(state)) members.push_back(std::move(member));
  if (isKnown(state.building)) members.emplace_back("building", jsonOf(state.building));
  if (!state.further_storeys.empty()) {
    json further = json::array();
    for (const RoomPipelineState& rooms : state.further_storeys) {
      json storey = json::object();
      for (auto& [key, value] : membersOf(rooms)) storey[key] = std::move(value);
      further.push_back(std::move(storey));
    }
    members.emplace_back("further_storeys", std::move(further));
  }
  return jsonDocument(members);
}

SessionJson parseSessionJson(const std::string& text, const std::string& where) {
  const json document = parseJson(text, where);
  checkSessionKind(document, where);
  SessionJson session;
  SessionState& state = session.state;
  state.scene = stringOf(member(document, "scene", where), where + ": scene");
  state.stamp_s = numberOf(member(document, "stamp_s", where), where + ": stamp_s");
  state.T_map_agent = poseIn(member(document, "pose", where), where + ": pose");
  static_cast<RoomPipelineState&>(state) = roomsIn(document, where);
  session.next_ids = {nextIdsIn(member(document, "next_ids", where), where + ": next_ids")};
  if (const json* building = optionalMember(document, "building", where))
    state.building = buildingIn(*building, where + ": building");
  if (const json* further = optionalMember(document, "further_storeys", where)) {
    const std::string place = where + ": further_storeys";
    for (const json& rooms : arrayOf(*further, place)) {
      session.next_ids.push_back(nextIdsIn(member(rooms, "next_ids", place), place + ": next_ids"));
      state.further_storeys.push_back(roomsIn(rooms, place));
    }
  }
  const std::size_t storeys = std::max<std::size_t>(1, state.building.storeys.size());
  if (session.storeyCount() != storeys) {
    throw refuse(where, "has the rooms of " + std::to_string(session.storeyCount()) + " storeys",
                 "the building has " + std::to_string(storeys));
  }
  session.files = filesIn(member(document, "files", where), where + ": files", storeys);
  return session;
}

}  // namespace occusg
