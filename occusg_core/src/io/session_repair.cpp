// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/session_repair.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "io/session_parts.hpp"
#include "occusg/error.hpp"
#include "occusg/graph/limits.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/scene_graph_file.hpp"

namespace occusg {
namespace {

using nlohmann::json;
using Repairs = std::vector<std::string>;

/// @return whether `visit` changed a stamp.
bool visitStamps(Node& node, const std::function<void(double&)>& visit) {
  bool is_changed = false;
  const auto visited = [&](double& stamp_s) {
    const double before_s = stamp_s;
    visit(stamp_s);
    is_changed |= stamp_s != before_s;
  };
  visited(node.created_s);
  visited(node.last_seen_s);
  auto* room = std::get_if<RoomAttributes>(&node.attributes);
  if (room != nullptr && room->unsupported_since_s) visited(*room->unsupported_since_s);
  return is_changed;
}

/// Calls `visit` with every stamp of the rooms of a storey that may be changed.
void forEachStamp(RoomPipelineState& state, const std::function<void(double&)>& visit) {
  if (state.last_room_update_s) visit(*state.last_room_update_s);
  if (state.graph.last_update_s) visit(*state.graph.last_update_s);
  visit(state.graph.last_maintenance_s);
  for (auto& item : state.graph.rooms.first_seen_s) visit(item.second);
  SceneGraph& graph = state.graph.graph;
  for (std::size_t type = 0; type < kNodeTypeCount; ++type) {
    std::vector<Node> changed;
    for (const auto& item : graph.nodes(static_cast<NodeType>(type))) {
      Node node = item.second;
      if (visitStamps(node, visit)) changed.push_back(std::move(node));
    }
    for (Node& node : changed) graph.update(std::move(node));
  }
}

void forEachStamp(SessionState& state, const std::function<void(double&)>& visit) {
  visit(state.stamp_s);
  forEachStamp(static_cast<RoomPipelineState&>(state), visit);
  for (RoomPipelineState& rooms : state.further_storeys) forEachStamp(rooms, visit);
}

bool isMisplaced(const json& node) {
  const auto position = node.find("position");
  if (position == node.end() || !position->is_array()) return false;
  return std::any_of(position->begin(), position->end(), [](const json& value) {
    return value.is_number() && !(std::abs(value.get<double>()) <= kMaxGraphCoordinate_m);
  });
}

/// Removes the elements of a list of objects that `is_wrong` finds; how many.
std::size_t removeIf(json& list, const std::function<bool(const json&)>& is_wrong) {
  if (!list.is_array()) return 0;
  json kept = json::array();
  for (json& element : list)
    if (!element.is_object() || !is_wrong(element)) kept.push_back(std::move(element));
  const std::size_t removed = list.size() - kept.size();
  list = std::move(kept);
  return removed;
}

/// The text of a graph without the nodes that are too far away, and without their edges.
std::string withoutMisplaced(const std::string& text, const std::string& where, Repairs& repairs) {
  json document = parseJson(text, where, kMaxGraphValues);
  if (!document.is_object() || !document.contains("nodes") || !document.contains("edges"))
    return text;
  std::set<json> gone;
  const std::size_t removed = removeIf(document["nodes"], [&](const json& node) {
    if (!isMisplaced(node)) return false;
    gone.insert(node.value("id", json(nullptr)));
    return true;
  });
  if (removed == 0) return text;
  removeIf(document["edges"], [&](const json& edge) {
    return gone.count(edge.value("source", json(nullptr))) > 0 ||
           gone.count(edge.value("target", json(nullptr))) > 0;
  });
  repairs.push_back(where + ": " + std::to_string(removed) +
                    " nodes farther than 1e6 m from the origin are left out");
  return document.dump();
}

std::string partOf(const std::filesystem::path& file, const FileMark& wanted, Repairs& repairs) {
  std::string bytes = readFile(file.string(), kMaxPartBytes);
  if (!(markOf(bytes) == wanted))
    repairs.push_back(file.string() + ": is not what was saved, and is taken as it is");
  return bytes;
}

std::optional<OccupancyMap> mapIn(const std::filesystem::path& file, const FileMark& wanted,
                                  const OccupancyMapConfig& config, Repairs& repairs) {
  try {
    (void)partOf(file, wanted, repairs);
    OccupancyMap map = readOctomap(file.string(), config);
    if (!map.cutIslands().none())
      repairs.push_back(file.string() + ": " + sentenceOn(map.cutIslands()));
    return map;
  } catch (const Error& error) {
    repairs.push_back(std::string("the map is left out: ") + error.what());
    return std::nullopt;
  }
}

void repairPose(SessionState& state, Repairs& repairs) {
  if (isWithinGraph(state.T_map_agent.translation())) return;
  const auto& agents = state.graph.graph.nodes(NodeType::kAgent);
  state.T_map_agent =
      agents.empty() ? Pose::Identity()
                     : std::get<AgentAttributes>(agents.rbegin()->second.attributes).T_map_agent;
  repairs.emplace_back("the last pose was farther than 1e6 m from the origin");
}

}  // namespace

std::size_t repairStamps(SessionState& state, double latest_s) {
  double credible_s = -std::numeric_limits<double>::infinity();
  std::size_t wrong = 0;
  forEachStamp(state, [&](double& stamp_s) {
    if (stamp_s > latest_s) {
      ++wrong;
    } else {
      credible_s = std::max(credible_s, stamp_s);
    }
  });
  if (wrong == 0) return 0;
  if (!std::isfinite(credible_s)) credible_s = latest_s;
  forEachStamp(state, [&](double& stamp_s) {
    if (stamp_s > latest_s) stamp_s = credible_s;
  });
  return wrong;
}

RepairedSession readForRepair(const std::string& folder, const OccupancyMapConfig& config,
                              double latest_s) {
  Repairs repairs;
  const std::filesystem::path place = sessionAt(folder);
  if (place != std::filesystem::path(folder)) {
    repairs.push_back(folder + ": is missing; " + place.string() +
                      ", which a save that was killed had set aside, takes its place");
  }
  const std::string path = (place / kSessionFile).string();
  SessionJson session = parseSessionJson(readFile(path, kMaxSessionBytes), path);
  std::optional<OccupancyMap> map;
  if (const auto mark = session.files.find(kMapFile); mark != session.files.end())
    map = mapIn(place / kMapFile, mark->second, config, repairs);
  for (std::size_t storey = 0; storey < session.storeyCount(); ++storey) {
    const std::string name = graphFileOf(storey);
    const std::string graph_path = (place / name).string();
    const std::string text = partOf(place / name, session.files.at(name), repairs);
    addGraph(session, storey,
             parseSceneGraph(withoutMisplaced(text, graph_path, repairs), graph_path).graph, path);
  }
  repairPose(session.state, repairs);
  if (const std::size_t stamps = repairStamps(session.state, latest_s); stamps > 0)
    repairs.push_back(std::to_string(stamps) + " stamps were from the future");
  return {{std::move(map), std::move(session.state)}, std::move(repairs)};
}

}  // namespace occusg
