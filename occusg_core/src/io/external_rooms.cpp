// SPDX-License-Identifier: BSD-3-Clause
#include "io/external_rooms.hpp"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20U;

bool hasIntegerId(const json& room) {
  const auto id = room.is_object() ? room.find("id") : room.end();
  return !room.is_object() || (id != room.end() && id->is_number());
}

}  // namespace

RoomsFile readExternalRooms(const std::string& path, RingOrder order) {
  const std::string text = readFile(path, kMaxFileBytes);
  json document = parseJson(text, path);
  const json& rooms = arrayOf(member(document, "rooms", path), path + ": rooms");
  if (std::all_of(rooms.begin(), rooms.end(), hasIntegerId)) return parseRooms(text, path, order);
  int next = 1;
  for (json& room : document["rooms"])
    if (room.is_object()) room["id"] = next++;
  document.erase("doors");
  return parseRooms(document.dump(-1, ' ', true, json::error_handler_t::replace), path, order);
}

}  // namespace occusg
