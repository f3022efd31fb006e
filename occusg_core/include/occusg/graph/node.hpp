// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "occusg/geometry/cell.hpp"
#include "occusg/geometry/pose.hpp"
#include "occusg/graph/room.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// Type offset plus a counter per type; never used again after a removal.
using NodeId = std::int64_t;

/// In the order of `NodeAttributes` and of `kNodeTypes`.
enum class NodeType { kAgent, kObject, kNavigation, kRoom, kDoor, kStairs };

/// What is the same for all nodes of a type.
struct NodeTypeInfo {
  NodeType type;
  const char* name;  ///< In files and messages.
  NodeId first_id;   ///< A type holds the ids up to the next type's first one.
};

/// Every type of node. CONTRIBUTING says which other files a new one needs.
inline constexpr std::array<NodeTypeInfo, 6> kNodeTypes = {{
    {NodeType::kAgent, "AGENT", 0},
    {NodeType::kObject, "OBJECT", 1'000'000},
    {NodeType::kNavigation, "NAVIGATION", 2'000'000},
    {NodeType::kRoom, "ROOM", 4'000'000},
    {NodeType::kDoor, "DOOR", 5'000'000},
    {NodeType::kStairs, "STAIRS", 5'900'000},
}};
inline constexpr std::size_t kNodeTypeCount = kNodeTypes.size();

/// First id of a type. A type holds the ids up to the next type's first one.
[[nodiscard]] constexpr NodeId firstId(NodeType type) {
  return kNodeTypes[static_cast<std::size_t>(type)].first_id;
}
/// The ids of agents continue here when those below the first id of objects are used up.
inline constexpr NodeId kFurtherAgents = 6'000'000;
/// One past the last id of any type.
inline constexpr NodeId kIdEnd = 2'000'000'000;

/// Whether the id is one of a room.
[[nodiscard]] constexpr bool isRoomId(NodeId id) {
  return id >= firstId(NodeType::kRoom) && id < firstId(NodeType::kDoor);
}
/// The type whose nodes have the id; empty when none has.
[[nodiscard]] std::optional<NodeType> typeOfId(NodeId id);
/// How many ids of the type come before `id`, which is one of the type or follows its last.
[[nodiscard]] NodeId numberOfId(NodeType type, NodeId id);
/// The id of that number.
[[nodiscard]] NodeId idOfNumber(NodeType type, NodeId number);

/// The n of "room_<n>": the n-th room there ever was, counting from 1, because label images keep 0
/// for "no room".
/// @param id id of a room, given out or next.
[[nodiscard]] constexpr int roomNumber(NodeId id) {
  return static_cast<int>(id - firstId(NodeType::kRoom)) + 1;
}

/// "AGENT", "OBJECT", "NAVIGATION", "ROOM", "DOOR" or "STAIRS".
[[nodiscard]] const char* nameOf(NodeType type);

/// The robot at one moment. The agent's frame is the one that whoever drives the pipeline follows:
/// the camera's optical frame in `Pipeline` and `occusg run`, `robot_frame` in the ROS nodes.
struct AgentAttributes {
  Pose T_map_agent = Pose::Identity();
};

/// A thing that was seen; its node is at the mean of the centroids it was seen with.
struct ObjectAttributes {
  std::string class_name;  ///< The one seen most; empty: no class known.
  double score = 0.0;      ///< Mean confidence of the detections, 0..1.
  int observations = 0;    ///< How many detections it is made of.
  /// Upright, along the axes of the map frame [m]; holds all that was seen of it. May be empty.
  Eigen::AlignedBox3d box = Eigen::AlignedBox3d();
  /// Summed confidence of the detections by class.
  std::map<std::string, double> class_histogram = {};
};

/// A block of free space.
struct NavigationAttributes {
  Cell block;          ///< Position in the lattice of blocks, aligned to world zero.
  int free_cells = 0;  ///< Free cells in the block.
};

/// A passage between two rooms; its node is at the midpoint.
struct DoorAttributes {
  Segment2 segment;      ///< From jamb to jamb, map frame [m].
  double width_m = 0.0;  ///< Length of `segment`.
  NodeId room_a = 0;     ///< The rooms it joins; the smaller id first.
  NodeId room_b = 0;
};

/// What leads from one storey to another; its node is halfway up.
struct StairsAttributes {
  StairsKind kind = StairsKind::kStairs;
  std::vector<Eigen::Vector3d> path;  ///< From the lower end to the upper, on the treads [m].
  Ring footprint;                     ///< Convex outline around `path`, map frame [m].
  double rise_m = 0.0;                ///< From end to end of `path`.
  int risers = 0;                     ///< Steps counted along `path`; 0 for a ramp or a lift.
  int lower_storey = 0;
  int upper_storey = 0;
  NodeId lower_room = 0;  ///< The rooms it joins; 0: no room is at this end.
  NodeId upper_room = 0;
};

using NodeAttributes = std::variant<AgentAttributes, ObjectAttributes, NavigationAttributes,
                                    RoomAttributes, DoorAttributes, StairsAttributes>;
static_assert(std::variant_size_v<NodeAttributes> == kNodeTypeCount);

/// A node of the scene graph.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a variant is noexcept where its members are.
struct Node {
  NodeId id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< Map frame [m].
  double created_s = 0.0;
  double last_seen_s = 0.0;
  int floor_id = 0;
  NodeAttributes attributes;

  [[nodiscard]] NodeType type() const { return static_cast<NodeType>(attributes.index()); }
  [[nodiscard]] Point2 groundPosition() const { return {position.x(), position.y()}; }
};

}  // namespace occusg
