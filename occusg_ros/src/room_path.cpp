// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/room_path.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

using geometry_msgs::Point;

double between(const Point& a, const Point& b) { return std::hypot(b.x - a.x, b.y - a.y); }

Point middleOf(const occusg::DoorInfo& door) {
  Point middle;
  middle.x = 0.5 * (door.ends[0].x + door.ends[1].x);
  middle.y = 0.5 * (door.ends[0].y + door.ends[1].y);
  return middle;
}

/// How a room was reached.
struct Step {
  double length_m = 0.0;
  std::int64_t from = 0;
  const occusg::DoorInfo* door = nullptr;  ///< Null: the start.
};

/// Steps to every room that can be reached.
std::map<std::int64_t, Step> stepsFrom(const occusg::SceneGraphStamped& graph, std::int64_t start,
                                       const std::map<std::int64_t, Point>& places) {
  std::map<std::int64_t, Step> steps = {{start, {}}};
  std::set<std::pair<double, std::int64_t>> open = {{0.0, start}};
  while (!open.empty()) {
    const std::int64_t room = open.begin()->second;
    open.erase(open.begin());
    for (const occusg::DoorInfo& door : graph.doors) {
      if (door.room_a != room && door.room_b != room) continue;
      const std::int64_t next = door.room_a == room ? door.room_b : door.room_a;
      const auto place = places.find(next);
      if (place == places.end()) continue;
      const Point middle = middleOf(door);
      const double length_m =
          steps[room].length_m + between(places.at(room), middle) + between(middle, place->second);
      const auto known = steps.find(next);
      if (known != steps.end() && known->second.length_m <= length_m) continue;
      if (known != steps.end()) open.erase({known->second.length_m, next});
      steps[next] = {length_m, room, &door};
      open.insert({length_m, next});
    }
  }
  return steps;
}

void append(nav_msgs::Path& path, const Point& point) {
  geometry_msgs::PoseStamped pose;
  pose.header = path.header;
  pose.pose.position = point;
  pose.pose.orientation.w = 1.0;
  path.poses.push_back(std::move(pose));
}

}  // namespace

RoomPath pathBetween(const occusg::SceneGraphStamped& graph, std::int64_t from, std::int64_t to) {
  std::map<std::int64_t, Point> places;
  for (const occusg::RoomInfo& room : graph.rooms) places[room.id] = room.position;
  for (const std::int64_t id : {from, to}) {
    if (places.count(id) == 0) {
      throw occusg::refuse("path", "there is no room of id " + std::to_string(id),
                           "list_rooms tells the ids");
    }
  }
  const std::map<std::int64_t, Step> steps = stepsFrom(graph, from, places);
  const auto goal = steps.find(to);
  if (goal == steps.end()) {
    throw occusg::refuse(
        "path",
        "no door leads from room " + std::to_string(from) + " to room " + std::to_string(to),
        "drive there once, so that the way is seen");
  }
  RoomPath way;
  way.length_m = goal->second.length_m;
  way.rooms = {to};
  for (const Step* step = &goal->second; step->door != nullptr; step = &steps.at(step->from)) {
    way.rooms.push_back(step->from);
    way.doors.push_back(*step->door);
  }
  std::reverse(way.rooms.begin(), way.rooms.end());
  std::reverse(way.doors.begin(), way.doors.end());
  way.path.header = graph.header;
  append(way.path, places.at(from));
  for (std::size_t i = 0; i < way.doors.size(); ++i) {
    append(way.path, middleOf(way.doors[i]));
    append(way.path, places.at(way.rooms[i + 1]));
  }
  return way;
}

}  // namespace occusg_ros
