// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/storey_conversions.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

#include "occusg/error.hpp"
#include "occusg_ros/graph_conversions.hpp"
#include "occusg_ros/shown_text.hpp"

namespace occusg_ros {
namespace {

using occusg::StairsKind;

const char* nameOf(StairsKind kind) {
  switch (kind) {
    case StairsKind::kStairs:
      return "stairs";
    case StairsKind::kRamp:
      return "ramp";
    case StairsKind::kLift:
      return "lift";
  }
  return "unknown";
}

StairsKind kindOf(const std::string& name, const std::string& where) {
  for (const StairsKind kind : {StairsKind::kStairs, StairsKind::kRamp, StairsKind::kLift})
    if (name == nameOf(kind)) return kind;
  throw occusg::refuse(where, "has the kind '" + shownName(name) + "'",
                       "stairs, ramp or lift is needed");
}

std::vector<geometry_msgs::Point> pathMsg(const std::vector<Eigen::Vector3d>& path) {
  std::vector<geometry_msgs::Point> points;
  points.reserve(path.size());
  for (const Eigen::Vector3d& feet : path)
    points.push_back(toPointMsg({feet.x(), feet.y()}, feet.z()));
  return points;
}

int storeyOf(std::int32_t floor_id, std::size_t storeys, const std::string& where) {
  if (floor_id >= 0 && static_cast<std::size_t>(floor_id) < storeys) return floor_id;
  throw occusg::refuse(where, "names the floor_id " + std::to_string(floor_id),
                       "there are " + std::to_string(storeys) + " storeys, counted from 0");
}

double finite(double value, const std::string& where) {
  if (std::isfinite(value)) return value;
  throw occusg::refuse(where, "has a number that is not finite", "metres are needed");
}

occusg::StoreyPassage passageOf(const occusg::StairsInfo& msg, std::size_t storeys,
                                const std::string& where) {
  occusg::StoreyPassage passage;
  passage.kind = kindOf(msg.kind, where);
  passage.lower_storey = storeyOf(msg.floor_ids[0], storeys, where);
  passage.upper_storey = storeyOf(msg.floor_ids[1], storeys, where);
  passage.risers = static_cast<int>(msg.risers & 0xFFFFU);
  if (msg.path.size() < 2)
    throw occusg::refuse(where, "has stairs with a path of one point or none", "two are needed");
  for (const geometry_msgs::Point& feet : msg.path)
    passage.path.emplace_back(finite(feet.x, where), finite(feet.y, where), finite(feet.z, where));
  return passage;
}

}  // namespace

occusg::StoreyArray toStoreyArray(const occusg::Building& building,
                                  const std_msgs::Header& header) {
  occusg::StoreyArray msg;
  msg.header = header;
  msg.current = static_cast<std::int32_t>(building.current);
  msg.sensor_height = building.sensor_height_m;
  for (const occusg::Storey& storey : building.storeys) {
    occusg::StoreyInfo info;
    info.floor_id = storey.id;
    info.floor_z = storey.floor_z_m;
    msg.storeys.push_back(info);
  }
  for (const occusg::StoreyPassage& passage : building.passages) {
    occusg::StairsInfo info;
    info.id = kNone;
    info.kind = nameOf(passage.kind);
    info.floor_ids = {passage.lower_storey, passage.upper_storey};
    info.rooms = {kNone, kNone};
    info.risers = static_cast<std::uint32_t>(passage.risers);
    info.path = pathMsg(passage.path);
    msg.stairs.push_back(std::move(info));
  }
  return msg;
}

occusg::Building toBuilding(const occusg::StoreyArray& msg, const std::string& where) {
  if (msg.storeys.empty()) throw occusg::refuse(where, "has no storeys", "one at least is needed");
  occusg::Building building;
  for (const occusg::StoreyInfo& storey : msg.storeys) {
    const int id = static_cast<int>(building.storeys.size());
    if (storey.floor_id != id) {
      throw occusg::refuse(
          where,
          "has the floor_id " + std::to_string(storey.floor_id) + " in place " + std::to_string(id),
          "storeys come in the order of their floor_id, counted from 0");
    }
    building.storeys.push_back({id, finite(storey.floor_z, where), {}});
  }
  divideHeights(building.storeys);
  const std::size_t count = building.storeys.size();
  building.current = static_cast<std::size_t>(storeyOf(msg.current, count, where));
  building.sensor_height_m = finite(msg.sensor_height, where);
  for (const occusg::StairsInfo& stairs : msg.stairs)
    building.passages.push_back(passageOf(stairs, count, where));
  return building;
}

occusg::StairsInfo toStairsMsg(const occusg::SceneGraph& graph, occusg::NodeId stairs) {
  const auto& attributes = std::get<occusg::StairsAttributes>(graph.at(stairs).attributes);
  const auto room = [](occusg::NodeId id) { return id == 0 ? kNone : std::int64_t{id}; };
  occusg::StairsInfo msg;
  msg.id = stairs;
  msg.kind = nameOf(attributes.kind);
  msg.floor_ids = {attributes.lower_storey, attributes.upper_storey};
  msg.rooms = {room(attributes.lower_room), room(attributes.upper_room)};
  msg.risers = static_cast<std::uint32_t>(attributes.risers);
  msg.path = pathMsg(attributes.path);
  return msg;
}

std::vector<occusg::StairsInfo> toStairsMsgs(const occusg::SceneGraph& graph) {
  std::vector<occusg::StairsInfo> msgs;
  for (const auto& entry : graph.nodes(occusg::NodeType::kStairs))
    msgs.push_back(toStairsMsg(graph, entry.first));
  return msgs;
}

}  // namespace occusg_ros
