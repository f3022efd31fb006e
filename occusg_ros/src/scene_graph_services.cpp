// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg/pipeline/config_file.hpp"
#include "occusg/printable.hpp"
#include "occusg_ros/graph_conversions.hpp"
#include "occusg_ros/grid_conversions.hpp"
#include "occusg_ros/room_path.hpp"
#include "scene_graph_node.hpp"

namespace occusg_ros {
namespace {

constexpr std::size_t kMaxLabelLength = 64;

template <typename Response>
bool answer(Response& response, const std::string& problem, const std::string& success) {
  response.success = problem.empty();
  response.message = problem.empty() ? success : problem;
  return true;
}

/// The storey a height is on, as `occusg::storeyAt` finds it in a graph; none where all rooms are
/// on one storey, whatever the height is.
std::optional<std::int32_t> storeyOf(const occusg::SceneGraphStamped& graph, double z_m) {
  constexpr double kBelowFloor_m = 0.5;
  const occusg::RoomInfo* highest = nullptr;  // of the floors at most half a metre above
  const occusg::RoomInfo* lowest = nullptr;
  bool has_several = false;
  for (const occusg::RoomInfo& room : graph.rooms) {
    has_several = has_several || room.floor_id != graph.rooms.front().floor_id;
    if (!lowest || room.position.z < lowest->position.z) lowest = &room;
    const bool is_below = room.position.z - kBelowFloor_m <= z_m;
    if (is_below && (!highest || room.position.z > highest->position.z)) highest = &room;
  }
  if (!has_several) return std::nullopt;
  return highest ? highest->floor_id : lowest->floor_id;
}

}  // namespace

void SceneGraphNode::advertiseServices() {
  ros::NodeHandle& nh = handles_.services;
  ros::NodeHandle& own = handles_.parameter_services;
  services_ = {nh.advertiseService("get_scene_graph", &SceneGraphNode::onGetSceneGraph, this),
               nh.advertiseService("list_rooms", &SceneGraphNode::onListRooms, this),
               nh.advertiseService("get_room_at", &SceneGraphNode::onGetRoomAt, this),
               nh.advertiseService("get_path", &SceneGraphNode::onGetPath, this),
               nh.advertiseService("set_room_label", &SceneGraphNode::onSetRoomLabel, this),
               nh.advertiseService("set_storey", &SceneGraphNode::onSetStorey, this),
               nh.advertiseService("segment_map", &SceneGraphNode::onSegmentMap, this),
               own.advertiseService("save", &SceneGraphNode::onSave, this),
               own.advertiseService("load", &SceneGraphNode::onLoad, this),
               own.advertiseService("reset", &SceneGraphNode::onReset, this),
               own.advertiseService("pause", &SceneGraphNode::onPause, this)};
}

std::string SceneGraphNode::onWorker(const std::function<void()>& work) {
  // Shared: the work may end after the patience has.
  const auto problem = std::make_shared<std::string>();
  const bool done = worker_->run(
      [work, problem] {
        try {
          work();
        } catch (const std::exception& error) {
          *problem = error.what();
        }
      },
      kServicePatience);
  return done ? *problem : "the scene graph did not answer in time";
}

bool SceneGraphNode::onGetSceneGraph(occusg::GetSceneGraph::Request& /*request*/,
                                     occusg::GetSceneGraph::Response& response) {
  response.graph = *lastGraph();
  return answer(response, response.graph.sequence == 0 ? "there is no graph yet" : "", "");
}

bool SceneGraphNode::onListRooms(occusg::ListRooms::Request& request,
                                 occusg::ListRooms::Response& response) {
  for (const occusg::RoomInfo& room : lastGraph()->rooms)
    if (!(room.area < request.min_area)) response.rooms.push_back(room);
  return answer(response, "", std::to_string(response.rooms.size()) + " rooms");
}

bool SceneGraphNode::onGetRoomAt(occusg::GetRoomAt::Request& request,
                                 occusg::GetRoomAt::Response& response) {
  const std::string& frame = request.point.header.frame_id;
  Eigen::Vector3d point(request.point.point.x, request.point.point.y, request.point.point.z);
  if (!point.allFinite()) return answer(response, "the point is not finite", "");
  if (!frame.empty() && frame != settings_.map_frame) {
    const PoseAnswer pose = poseAt(tf_, settings_.map_frame, frame, request.point.header.stamp);
    if (pose.kind != PoseAnswer::Kind::kFound) return answer(response, pose.problem, "");
    point = pose.T_target_source * point;
  }
  const GraphPtr graph = lastGraph();
  const std::optional<std::int32_t> floor_id = storeyOf(*graph, point.z());
  for (const occusg::RoomInfo& room : graph->rooms) {
    const bool is_on_it = !floor_id || room.floor_id == *floor_id;
    if (!is_on_it || !contains(toPolygon(room.polygon), {point.x(), point.y()})) continue;
    response.room = room;
    return answer(response, "", room.name);
  }
  return answer(response, "no room is there", "");
}

bool SceneGraphNode::onGetPath(occusg::GetPath::Request& request,
                               occusg::GetPath::Response& response) {
  const GraphPtr graph = lastGraph();
  const std::int64_t from = request.from_room == kNone ? graph->current_room : request.from_room;
  if (from == kNone) return answer(response, "the robot is in no room", "");
  const auto way = std::make_shared<RoomPath>();
  const std::string problem = onWorker([this, from, to = request.to_room, way, graph] {
    *way = pathBetween(rooms_->graph(), layers_, from, to, settings_.robot_radius_m, graph->header);
  });
  if (!problem.empty()) return answer(response, problem, "");
  response.rooms = std::move(way->rooms);
  response.doors = std::move(way->doors);
  response.stairs = std::move(way->stairs);
  response.length = way->length_m;
  response.path = std::move(way->path);
  return answer(response, "", std::to_string(response.rooms.size()) + " rooms on the way");
}

bool SceneGraphNode::onSetRoomLabel(occusg::SetRoomLabel::Request& request,
                                    occusg::SetRoomLabel::Response& response) {
  if (request.label.size() > kMaxLabelLength || !occusg::isPrintableUtf8(request.label))
    return answer(response, "a label has at most 64 bytes of printable UTF-8", "");
  const std::string problem = onWorker([this, id = request.room, label = request.label] {
    rooms_->setRoomLabel(occusg::roomWith(rooms_->graph(), id), label);
    publish(lastGraph()->header);
  });
  return answer(response, problem, "the label is set");
}

void SceneGraphNode::enterStorey(int floor_id, double floor_z_m) {
  if (!settings_.mapping_node.empty()) {
    throw occusg::refuse("set_storey", "~mapping_node is '" + settings_.mapping_node + "'",
                         "a node that maps finds the storeys by itself; with finished maps, leave "
                         "~mapping_node empty");
  }
  given_storeys_.enter(floor_id, floor_z_m);
  awaits_map_ = true;
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.clear();
  whole_grid_.reset();
}

bool SceneGraphNode::onSetStorey(occusg::SetStorey::Request& request,
                                 occusg::SetStorey::Response& response) {
  const std::string problem =
      onWorker([this, id = request.floor_id, z_m = request.floor_z] { enterStorey(id, z_m); });
  return answer(response, problem,
                "the next map is taken for storey " + std::to_string(request.floor_id));
}

bool SceneGraphNode::onSegmentMap(occusg::SegmentMap::Request& request,
                                  occusg::SegmentMap::Response& response) {
  std::string assumption;
  try {
    occusg::PipelineConfig config = config_;
    if (!request.decomposer.empty()) {
      config = occusg::configFromYaml("regions.decomposer: " + request.decomposer + "\n",
                                      "decomposer", config);
    }
    const GridReading reading =
        readingOf(request.map.data, {settings_.free_below_percent, occupiedAbove(settings_)});
    const occusg::FreeSpace layer = toFreeSpace(request.map, "map", reading.values);
    assumption = reading.assumption;
    const auto decomposer = occusg::makeDecomposer(config);
    const occusg::Decomposition& found = decomposer->update(layer);
    response.segmented_map = toLabelImage(found, request.map);
    response.regions = toRegionMsgs(found.regions);
    response.doors = toDoorMsgs(found.crossings);
  } catch (const occusg::Error& error) {
    return answer(response, error.what(), "");
  }
  const std::string assumed = assumption.empty() ? "" : "; " + assumption;
  return answer(response, "", std::to_string(response.regions.size()) + " regions" + assumed);
}

bool SceneGraphNode::onPause(std_srvs::SetBool::Request& request,
                             std_srvs::SetBool::Response& response) {
  paused_ = request.data;
  return answer(response, "", request.data ? "paused" : "running");
}

}  // namespace occusg_ros
