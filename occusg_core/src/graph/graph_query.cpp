// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/graph_query.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "graph/class_key.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr double kLargestRoomOfAFlat_m2 = 150.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A floor so little above a height is the one that a foot at that height stands on.
constexpr double kFloorAbove_m = 0.5;

bool isOn(const Node& node, const std::optional<int>& storey) {
  return !storey || node.floor_id == *storey;
}

std::optional<NodeId> nodeFor(const SceneGraph& graph, const Place& place, double max_reach_m) {
  const std::optional<NodeId> room = roomAt(graph, place);
  const std::optional<int> storey = storeyAt(graph, place);
  const auto inRoom = [&](const Node& node) { return graph.roomOf(node.id) == room; };
  if (room) {
    const auto node = graph.nearest(NodeType::kNavigation, place.point, max_reach_m, inRoom);
    if (node) return node;
  }
  return graph.nearest(NodeType::kNavigation, place.point, max_reach_m,
                       [&](const Node& node) { return isOn(node, storey); });
}

Point2 placeOf(const SceneGraph& graph, NodeId id) { return graph.at(id).groundPosition(); }

/// Nodes from `from` to `to`; empty when no way leads there.
std::vector<NodeId> shortestWay(const SceneGraph& graph, NodeId from, NodeId to) {
  struct Reached {
    double length_m = kInfinity;
    NodeId before = 0;
  };
  const Point2 goal = placeOf(graph, to);
  std::unordered_map<NodeId, Reached> reached;
  using Open = std::tuple<double, NodeId, double>;  // least possible length, node, length so far
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  reached[from] = {0.0, from};
  open.emplace(distance(placeOf(graph, from), goal), from, 0.0);
  while (!open.empty()) {
    const auto [bound_m, id, length_m] = open.top();
    open.pop();
    if (length_m > reached[id].length_m) continue;
    if (id == to) break;
    const Point2 at = placeOf(graph, id);
    for (const NodeId next : graph.targets(EdgeType::kTraversable, id)) {
      const Point2 there = placeOf(graph, next);
      const double next_m = length_m + distance(at, there);
      Reached& entry = reached[next];
      if (next_m >= entry.length_m) continue;
      entry = {next_m, id};
      open.emplace(next_m + distance(there, goal), next, next_m);
    }
  }
  std::vector<NodeId> way;
  if (reached.count(to) == 0) return way;
  for (NodeId id = to; id != from; id = reached[id].before) way.push_back(id);
  way.push_back(from);
  std::reverse(way.begin(), way.end());
  return way;
}

std::optional<NodeId> doorBetween(const SceneGraph& graph, NodeId a, NodeId b, const Point2& at) {
  const NodeId first = std::min(a, b);
  const NodeId second = std::max(a, b);
  return graph.nearest(NodeType::kDoor, at, kInfinity, [&](const Node& node) {
    const auto& door = std::get<DoorAttributes>(node.attributes);
    return door.room_a == first && door.room_b == second;
  });
}

std::optional<NodeId> stairsBetween(const SceneGraph& graph, NodeId a, NodeId b) {
  for (const auto& [id, node] : graph.nodes(NodeType::kStairs)) {
    const auto& stairs = std::get<StairsAttributes>(node.attributes);
    if (std::minmax(stairs.lower_room, stairs.upper_room) == std::minmax(a, b)) return id;
  }
  return std::nullopt;
}

double distanceBetween(const Node& a, const Node& b) { return (a.position - b.position).norm(); }

/// The way leads into `room`, at `crossing`.
void enter(const SceneGraph& graph, NodeId room, const Point2& crossing, Route& route) {
  if (!route.rooms.empty()) {
    if (const auto door = doorBetween(graph, route.rooms.back(), room, crossing))
      route.doors.push_back(*door);
    if (const auto stairs = stairsBetween(graph, route.rooms.back(), room))
      route.stairs.push_back(*stairs);
  }
  route.rooms.push_back(room);
}

/// "its rooms are 1, 2 and 5", for a sentence.
std::string roomsIn(const SceneGraph& graph) {
  constexpr std::size_t kShown = 20;
  std::string text;
  std::size_t shown = 0;
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    if (++shown > kShown) return "its rooms are " + text + ", ...";
    text += (text.empty() ? "" : ", ") + std::to_string(roomNumber(id));
  }
  return text.empty() ? "it has no rooms" : "its rooms are " + text;
}

}  // namespace

std::optional<int> storeyAt(const SceneGraph& graph, const Place& place) {
  if (!place.z_m) return std::nullopt;
  const Node* best = nullptr;
  const Node* lowest = nullptr;
  for (const auto& [id, room] : graph.nodes(NodeType::kRoom)) {
    const double floor_z_m = room.position.z();
    if (lowest == nullptr || floor_z_m < lowest->position.z()) lowest = &room;
    if (floor_z_m > *place.z_m + kFloorAbove_m) continue;
    if (best == nullptr || floor_z_m > best->position.z()) best = &room;
  }
  if (best == nullptr) best = lowest;
  return best == nullptr ? std::nullopt : std::optional(best->floor_id);
}

std::optional<NodeId> roomAt(const SceneGraph& graph, const Place& place, double tolerance_m) {
  const Point2& point = place.point;
  const std::optional<int> storey = storeyAt(graph, place);
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
  // Inside comes first, then the smaller room; outside the nearer one.
  std::optional<std::tuple<bool, double, NodeId>> best;
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const auto& room = std::get<RoomAttributes>(node.attributes);
    if (room.polygon.outer.empty()) continue;
    if (!isOn(node, storey)) continue;
    const double distance_m = distance(room.polygon, point);
    if (!(distance_m <= tolerance_m)) continue;
    const bool is_outside = distance_m > 0.0;
    const std::tuple<bool, double, NodeId> candidate{is_outside,
                                                     is_outside ? distance_m : room.area_m2, id};
    if (!best || candidate < *best) best = candidate;
  }
  if (!best) return std::nullopt;
  return std::get<2>(*best);
}

NodeId roomWith(const SceneGraph& graph, std::int64_t id_or_number) {
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom))
    if (id == id_or_number || roomNumber(id) == id_or_number) return id;
  throw refuse("scene graph", "has no room of id or number " + std::to_string(id_or_number),
               roomsIn(graph));
}

NodeId roomNamed(const SceneGraph& graph, const std::string& name) {
  constexpr std::size_t kMostDigits = 18;
  const bool is_number = !name.empty() && name.size() <= kMostDigits &&
                         name.find_first_not_of("0123456789") == std::string::npos;
  if (is_number) return roomWith(graph, std::stoll(name));
  std::vector<NodeId> labelled;
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const auto& room = std::get<RoomAttributes>(node.attributes);
    if (!name.empty() && room.name == name) return id;
    if (classKey(room.label) == classKey(name)) labelled.push_back(id);
  }
  if (labelled.size() == 1) return labelled.front();
  if (labelled.empty()) throw refuse("scene graph", "has no room '" + name + "'", roomsIn(graph));
  std::string numbers;
  for (const NodeId id : labelled)
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(roomNumber(id));
  throw refuse("scene graph", "has several rooms '" + name + "' (" + numbers + ")",
               "the number of one is needed");
}

std::vector<NodeId> objectsIn(const SceneGraph& graph, NodeId room) {
  std::vector<NodeId> objects;
  for (const NodeId member : graph.targets(EdgeType::kContains, room))
    if (graph.at(member).type() == NodeType::kObject) objects.push_back(member);
  return objects;
}

std::optional<NodeId> nearestObject(const SceneGraph& graph, const std::string& class_name,
                                    const Place& place) {
  const std::string key = classKey(class_name);
  const std::optional<int> storey = storeyAt(graph, place);
  return graph.nearest(NodeType::kObject, place.point, kInfinity, [&](const Node& node) {
    return isOn(node, storey) &&
           classKey(std::get<ObjectAttributes>(node.attributes).class_name) == key;
  });
}

std::vector<AdjacentRoom> adjacentRooms(const SceneGraph& graph, NodeId room) {
  std::map<NodeId, std::vector<NodeId>> doors_to;
  for (const NodeId beside : graph.targets(EdgeType::kRoomAdjacency, room)) doors_to[beside];
  for (const auto& [id, node] : graph.nodes(NodeType::kDoor)) {
    const auto& door = std::get<DoorAttributes>(node.attributes);
    if (door.room_a != room && door.room_b != room) continue;
    const auto to = doors_to.find(door.room_a == room ? door.room_b : door.room_a);
    if (to != doors_to.end()) to->second.push_back(id);
  }
  std::vector<AdjacentRoom> rooms;
  rooms.reserve(doors_to.size());
  for (auto& [beside, doors] : doors_to) rooms.push_back({beside, std::move(doors)});
  return rooms;
}

RoomsOnTheWay roomsAlong(const SceneGraph& graph, const std::vector<Place>& places) {
  RoomsOnTheWay way;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::optional<NodeId> room = roomAt(graph, places[i]);
    if (!room || (!way.rooms.empty() && way.rooms.back() == *room)) continue;
    if (!way.rooms.empty()) {
      const Point2 crossing = midpoint({places[i - 1].point, places[i].point});
      if (const auto door = doorBetween(graph, way.rooms.back(), *room, crossing))
        way.doors.push_back(*door);
    }
    way.rooms.push_back(*room);
  }
  return way;
}

std::string doubtOnLargestRoom(const SceneGraph& graph) {
  const RoomAttributes* largest = nullptr;
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) {
    const auto& room = std::get<RoomAttributes>(node.attributes);
    if (!largest || room.area_m2 > largest->area_m2) largest = &room;
  }
  if (!largest || largest->area_m2 <= kLargestRoomOfAFlat_m2) return "";
  return largest->name + " has " + std::to_string(std::lround(largest->area_m2)) +
         " m2, more than any room of a flat: if the building has no such hall, check the unit of "
         "the depth images or the resolution of the map";
}

std::optional<Route> shortestRoute(const SceneGraph& graph, const Place& from, const Place& to,
                                   double max_reach_m) {
  const std::optional<NodeId> first = nodeFor(graph, from, max_reach_m);
  const std::optional<NodeId> last = nodeFor(graph, to, max_reach_m);
  if (!first || !last) return std::nullopt;
  Route route;
  route.nodes = shortestWay(graph, *first, *last);
  if (route.nodes.empty()) return std::nullopt;
  const Node* before = nullptr;
  for (const NodeId id : route.nodes) {
    const Node& node = graph.at(id);
    const Point2 at = before == nullptr ? from.point : before->groundPosition();
    route.length_m += before == nullptr ? distance(from.point, node.groundPosition())
                                        : distanceBetween(*before, node);
    const std::optional<NodeId> room = graph.roomOf(id);
    if (room && (route.rooms.empty() || route.rooms.back() != *room)) {
      enter(graph, *room, midpoint({at, node.groundPosition()}), route);
    }
    before = &node;
  }
  // Both places are beside one node: nobody walks there first.
  route.length_m = route.nodes.size() == 1
                       ? distance(from.point, to.point)
                       : route.length_m + distance(before->groundPosition(), to.point);
  return route;
}

}  // namespace occusg
