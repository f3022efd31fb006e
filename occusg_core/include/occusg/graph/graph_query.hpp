// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Questions to a scene graph. Ties go to the smaller id.

/// A place in the map frame [m]. Without a height it may be on any storey; with one it is on the
/// storey with the highest floor that lies at most half a metre above the height.
struct Place {
  Place(const Point2& at) : point(at) {}  // NOLINT(google-explicit-constructor): points are places
  Place(double x, double y) : point{x, y} {}
  Place(double x, double y, double z) : point{x, y}, z_m(z) {}

  Point2 point;
  std::optional<double> z_m = std::nullopt;
};

/// The storey of a place, as `Node::floor_id` names it; empty for a place without a height, or when
/// there is no room.
[[nodiscard]] std::optional<int> storeyAt(const SceneGraph& graph, const Place& place);

/// The room whose polygon holds the place, the smallest of nested ones; else the nearest one at
/// most `tolerance_m` away.
[[nodiscard]] std::optional<NodeId> roomAt(const SceneGraph& graph, const Place& place,
                                           double tolerance_m = 0.0);

/// The room of an id, or of a number: ids of rooms begin far above the highest number.
/// @throws Error when there is none.
[[nodiscard]] NodeId roomWith(const SceneGraph& graph, std::int64_t id_or_number);

/// The room of a number ("3"), an id ("4000002"), a name ("room_3"), or a label that only one room
/// has ("kitchen"; compared by `classKey`).
/// @throws Error when there is none, or several rooms have the label.
[[nodiscard]] NodeId roomNamed(const SceneGraph& graph, const std::string& name);

/// The objects in a room, by id. Empty when there is no such room.
[[nodiscard]] std::vector<NodeId> objectsIn(const SceneGraph& graph, NodeId room);

/// The object of the class (compared by `classKey`) nearest to `place` in the ground plane.
[[nodiscard]] std::optional<NodeId> nearestObject(const SceneGraph& graph,
                                                  const std::string& class_name,
                                                  const Place& place);

/// A room beside another.
struct AdjacentRoom {
  NodeId room = 0;
  std::vector<NodeId> doors;  ///< That lead there, by id.
};

/// The rooms beside a room and the doors to them, by id. Empty when there is no such room.
[[nodiscard]] std::vector<AdjacentRoom> adjacentRooms(const SceneGraph& graph, NodeId room);

/// What looks wrong with the largest room, as a sentence: no room of a flat has more than 150 m2,
/// so either the building has a hall or the unit of its measurements is wrong. Empty when no room
/// is that large.
[[nodiscard]] std::string doubtOnLargestRoom(const SceneGraph& graph);

/// What a way leads through.
struct RoomsOnTheWay {
  std::vector<NodeId> rooms;  ///< In the order they are entered.
  std::vector<NodeId> doors;  ///< Between rooms that are joined by one, in order.
};

/// The rooms and doors on the way over `places` of one storey.
[[nodiscard]] RoomsOnTheWay roomsAlong(const SceneGraph& graph, const std::vector<Place>& places);

/// A way through free space.
struct Route {
  std::vector<NodeId> nodes;        ///< Navigation nodes in the order of travel.
  std::vector<NodeId> rooms;        ///< In the order they are entered; the first holds the start.
  std::vector<NodeId> doors;        ///< Passed between rooms that are joined by one, in order.
  std::vector<NodeId> stairs = {};  ///< Passed between rooms of two storeys, in order.
  double length_m = 0.0;            ///< From point to point, heights included [m].
};

/// The shortest way over the traversable edges, from the navigation node nearest to `from` to the
/// one nearest to `to` (A*, Hart et al. 1968); a node of the room the point is in goes before a
/// nearer one behind a wall. Empty when a point has no node within `max_reach_m`, or no way leads
/// from the one to the other.
[[nodiscard]] std::optional<Route> shortestRoute(const SceneGraph& graph, const Place& from,
                                                 const Place& to, double max_reach_m = 2.0);

}  // namespace occusg
