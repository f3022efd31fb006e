// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <occusg/CurrentRoom.h>
#include <occusg/DetectionArray.h>
#include <occusg/PolygonWithHoles.h>
#include <occusg/RegionArray.h>
#include <occusg/RoomArray.h>
#include <occusg/SceneGraphStamped.h>
#include <occusg/SceneGraphUpdate.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "occusg/graph/scene_graph.hpp"
#include "occusg/perception/detection.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg_ros {

/// In place of an id: there is none.
inline constexpr std::int64_t kNone = -1;

/// A graph as messages present it.
struct GraphView {
  const occusg::SceneGraph& graph;
  std::optional<occusg::NodeId> current_room;
  std::string scene;
  std::uint64_t sequence = 0;
  std_msgs::Header header;
  int floor_id = 0;  ///< Of the storey the robot is on.
};

[[nodiscard]] geometry_msgs::Point toPointMsg(const occusg::Point2& point, double z_m = 0.0);
[[nodiscard]] occusg::PolygonWithHoles toPolygonMsg(const occusg::Polygon& polygon,
                                                    double z_m = 0.0);
[[nodiscard]] occusg::Polygon toPolygon(const occusg::PolygonWithHoles& polygon);

/// The regions of one storey, which a building numbers apart from those of the others.
struct StoreyRegions {
  const occusg::TrackedRegions& regions;
  int floor_id = 0;
  double floor_z_m = 0.0;
};

[[nodiscard]] std::vector<occusg::RegionInfo> toRegionMsgs(
    const std::vector<occusg::Region>& regions, int floor_id = 0, double floor_z_m = 0.0);
/// @param storeys in the order of their ids.
[[nodiscard]] occusg::RegionArray toRegionArray(const std::vector<StoreyRegions>& storeys,
                                                std::uint64_t sequence,
                                                const std_msgs::Header& header);

/// @pre `id` is a room of the graph.
[[nodiscard]] occusg::RoomInfo toRoomMsg(const occusg::SceneGraph& graph, occusg::NodeId id);
/// The doors between the rooms of a graph, or between the regions of a decomposition.
[[nodiscard]] std::vector<occusg::DoorInfo> toDoorMsgs(const occusg::SceneGraph& graph);
/// @param door a door node of the graph.
[[nodiscard]] occusg::DoorInfo toDoorMsg(const occusg::SceneGraph& graph, occusg::NodeId door);
[[nodiscard]] std::vector<occusg::DoorInfo> toDoorMsgs(
    const std::vector<occusg::Crossing>& crossings);

[[nodiscard]] occusg::RoomArray toRoomArray(const GraphView& view);
[[nodiscard]] occusg::CurrentRoom toCurrentRoom(const GraphView& view);
[[nodiscard]] occusg::SceneGraphStamped toGraphMsg(const GraphView& view);

/// What leads from `before` to `after`.
[[nodiscard]] occusg::SceneGraphUpdate difference(const occusg::SceneGraphStamped& before,
                                                  const occusg::SceneGraphStamped& after);

/// Whether nothing changed.
[[nodiscard]] bool isEmpty(const occusg::SceneGraphUpdate& update);

[[nodiscard]] occusg::DetectionArray toDetectionMsg(
    const std::vector<occusg::Detection>& detections, const std_msgs::Header& header);

/// Detections taken from one message at most.
inline constexpr std::size_t kMaxDetections = 1000;

/// The usable detections of a message, and one sentence for each kind of refusal.
struct ReceivedDetections {
  std::vector<occusg::Detection> detections;
  std::size_t refused = 0;
  std::string first_refusal;  ///< Empty when nothing was refused.
};

/// Takes at most `kMaxDetections`; one with a number that is not finite, a score outside 0..1, a
/// box that is inside out or a class name of more than 200 bytes is refused and counted.
[[nodiscard]] ReceivedDetections toDetections(const occusg::DetectionArray& msg);

}  // namespace occusg_ros
