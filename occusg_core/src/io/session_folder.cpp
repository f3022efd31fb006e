// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/session_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <system_error>
#include <utility>

#include "io/file_bytes.hpp"
#include "io/folder_exchange.hpp"
#include "io/part_file.hpp"
#include "io/session_json.hpp"
#include "io/session_parts.hpp"
#include "occusg/error.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/scene_graph_file.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;

/// The folder's path without the slash at its end: what stands beside it is named after it.
fs::path placeOf(const std::string& folder) {
  fs::path place = fs::path(folder).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();
  if (!place.has_filename() || place.filename() == "." || place.filename() == "..")
    throw refuse(folder, "is no name for a session", "the name of a folder is needed");
  return place;
}

/// Removes what is at the path at the end of the scope.
class Leftover {
 public:
  explicit Leftover(fs::path path) : path_(std::move(path)) { clear(); }
  Leftover(const Leftover&) = delete;
  Leftover(Leftover&&) = delete;
  Leftover& operator=(const Leftover&) = delete;
  Leftover& operator=(Leftover&&) = delete;
  ~Leftover() { clear(); }

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  void clear() const {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path path_;
};

/// Holds the folder that is being written against being taken for stale.
class HeldFolder {
 public:
  explicit HeldFolder(const fs::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ >= 0) lockPart(descriptor_);
  }
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder(HeldFolder&&) = delete;
  HeldFolder& operator=(const HeldFolder&) = delete;
  HeldFolder& operator=(HeldFolder&&) = delete;
  ~HeldFolder() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

 private:
  int descriptor_;
};

std::string checkedFile(const fs::path& folder, const std::string& name, const FileMark& wanted) {
  const std::string path = (folder / name).string();
  std::string bytes = readFile(path, kMaxPartBytes);
  const FileMark found = markOf(bytes);
  if (found.bytes != wanted.bytes) {
    throw refuse(path, "is " + std::to_string(found.bytes) + " bytes long",
                 "the session was saved with " + std::to_string(wanted.bytes));
  }
  if (found.checksum != wanted.checksum)
    throw refuse(path, "is not what the session was saved with", "an undamaged session is needed");
  return bytes;
}

using Parts = std::map<std::string, std::function<void(std::ostream&)>>;

void saveParts(const std::string& folder, const Parts& parts, const SessionState& state) {
  checkSessionPlace(folder);
  const fs::path place = placeOf(folder);
  fs::path parent = place.parent_path();
  if (parent.empty()) parent = ".";
  const OutputFolder beside(parent.string());
  const Leftover fresh(partPath(parent.string(), place.filename().string()));
  const OutputFolder written(fresh.path().string());
  const HeldFolder held(fresh.path());
  std::map<std::string, FileMark> marks;
  for (const auto& [name, writer] : parts) marks[name] = written.write(name, writer, kMaxPartBytes);
  const std::string index = toSessionJson(state, marks);
  const auto write_index = [&](std::ostream& out) { out << index; };
  (void)written.write(kSessionFile, write_index, kMaxSessionBytes);
  putInPlace(fresh.path(), parent / place.filename());
}

void checkRooms(const RoomPipelineState& state, const std::string& where) {
  for (const auto& [region, room] : state.graph.rooms.former_room_of_region) {
    const Node* node = state.graph.graph.find(room);
    if (node != nullptr && node->type() == NodeType::kRoom) continue;
    throw refuse(where,
                 "names room " + std::to_string(room) + " of region " + std::to_string(region),
                 "a room of the session's graph is needed");
  }
}

void checkObject(const RoomPipelineState& state, NodeId object, const std::string& where) {
  const Node* node = state.graph.graph.find(object);
  if (node != nullptr && node->type() == NodeType::kObject) return;
  throw refuse(where, "names object " + std::to_string(object),
               "an object of the session's graph is needed");
}

void checkObjects(const RoomPipelineState& state, const std::string& where) {
  for (const auto& item : state.graph.objects.seen_apart) {
    checkObject(state, item.first.first, where);
    checkObject(state, item.first.second, where);
  }
  for (const auto& item : state.graph.objects.free_checks) checkObject(state, item.first, where);
}

}  // namespace

std::filesystem::path sessionAt(const std::string& folder) {
  std::error_code failed;
  if (fs::exists(folder, failed)) return folder;
  const fs::path standing = standingFolder(placeOf(folder));
  return fs::exists(standing, failed) ? standing : fs::path(folder);
}

void addGraph(SessionJson& session, std::size_t storey, SceneGraph graph,
              const std::string& where) {
  RoomPipelineState& state = session.roomsOf(storey);
  state.graph.graph = std::move(graph);
  for (const auto& [type, id] : session.next_ids[storey]) {
    try {
      state.graph.graph.skipIdsBefore(type, id);
    } catch (const Error& error) {
      throw Error(where + ": " + error.what());
    }
  }
  checkRooms(state, where);
  checkObjects(state, where);
}

void checkSessionPlace(const std::string& folder) {
  const fs::path place = placeOf(folder);
  std::error_code failed;
  if (!fs::exists(place, failed)) return;
  if (!fs::is_directory(place, failed)) throw refuse(folder, "is a file", "a folder is needed");
  if (fs::is_empty(place, failed) || fs::exists(place / kSessionFile, failed)) return;
  throw refuse(folder, "holds something else than a session",
               "a new or a session's folder is needed");
}

namespace {

/// The parts of a session that hold its graphs.
/// @param state outlives them.
Parts graphsOf(const SessionState& state) {
  Parts parts;
  const auto add = [&](std::size_t storey, const RoomPipelineState& rooms) {
    parts[graphFileOf(storey)] = [&rooms, &state](std::ostream& out) {
      writeJson(rooms.graph.graph, state.scene, "map", out);
    };
  };
  add(0, state);
  for (std::size_t i = 0; i < state.further_storeys.size(); ++i)
    add(i + 1, state.further_storeys[i]);
  return parts;
}

}  // namespace

void saveSession(const std::string& folder, const octomap::OcTree& map, const SessionState& state) {
  Parts parts = graphsOf(state);
  parts[kMapFile] = [&](std::ostream& out) { writeOctomap(map, OctomapEncoding::kFull, out); };
  saveParts(folder, parts, state);
}

void saveSession(const std::string& folder, const SessionState& state) {
  saveParts(folder, graphsOf(state), state);
}

Session loadSession(const std::string& folder, const OccupancyMapConfig& config) {
  const fs::path place = sessionAt(folder);
  const std::string path = (place / kSessionFile).string();
  SessionJson session = parseSessionJson(readFile(path, kMaxSessionBytes), path);
  std::optional<OccupancyMap> map;
  if (const auto mark = session.files.find(kMapFile); mark != session.files.end()) {
    (void)checkedFile(place, kMapFile, mark->second);
    map = readOctomap((place / kMapFile).string(), config);
  }
  for (std::size_t storey = 0; storey < session.storeyCount(); ++storey) {
    const std::string name = graphFileOf(storey);
    const std::string bytes = checkedFile(place, name, session.files.at(name));
    addGraph(session, storey, parseSceneGraph(bytes, (place / name).string()).graph, path);
  }
  return {std::move(map), std::move(session.state)};
}

}  // namespace occusg
