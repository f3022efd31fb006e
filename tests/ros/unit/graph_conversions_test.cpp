// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/graph_conversions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "occusg_ros/markers.hpp"

namespace occusg_ros {
namespace {

using occusg::EdgeType;
using occusg::NodeId;
using occusg::NodeType;

occusg::Polygon square(double x, double y, double side = 2.0) {
  return {{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}};
}

NodeId addRoom(occusg::SceneGraph& graph, double x, double y) {
  occusg::RoomAttributes room;
  room.name = "room_" + std::to_string(occusg::roomNumber(graph.nextId(NodeType::kRoom)));
  room.polygon = square(x, y);
  room.area_m2 = 4.0;
  return graph.add({x + 1.0, y + 1.0, 0.0}, 1.0, room).id;
}

// Three rooms in a row, joined by doors at x = 2 and x = 4; the robot's two poses in the first.
struct Row {
  occusg::SceneGraph graph;
  NodeId rooms[3] = {};

  Row() {
    for (int i = 0; i < 3; ++i) rooms[i] = addRoom(graph, 2.0 * i, 0.0);
    for (int i = 0; i < 2; ++i)
      graph.connect({EdgeType::kRoomAdjacency,
                     rooms[i],
                     rooms[i + 1],
                     {{{2.0 * i + 2.0, 0.5}, {2.0 * i + 2.0, 1.5}}}});
    const NodeId first = graph.add({0.5, 0.5, 1.0}, 1.0, occusg::AgentAttributes{}).id;
    const NodeId second = graph.add({1.0, 1.0, 1.0}, 2.0, occusg::AgentAttributes{}).id;
    graph.connect({EdgeType::kTemporal, first, second, {}});
    graph.connect({EdgeType::kContains, rooms[0], first, {}});
  }

  [[nodiscard]] GraphView view(std::uint64_t sequence = 1) const {
    return {graph, rooms[0], "row", sequence, {}};
  }
};

TEST(GraphConversions, MessageHoldsTheWholeGraph) {
  const Row row;
  const occusg::SceneGraphStamped msg = toGraphMsg(row.view());
  ASSERT_EQ(msg.rooms.size(), 3U);
  EXPECT_EQ(msg.rooms[1].adjacent, (std::vector<std::int64_t>{row.rooms[0], row.rooms[2]}));
  EXPECT_EQ(msg.rooms[0].number, 1U);
  EXPECT_EQ(msg.rooms[0].polygon.outer.points.size(), 4U);
  ASSERT_EQ(msg.doors.size(), 2U);
  EXPECT_DOUBLE_EQ(msg.doors[0].width, 1.0);
  EXPECT_EQ(msg.doors[0].room_b, row.rooms[1]);
  ASSERT_EQ(msg.agents.size(), 2U);
  EXPECT_EQ(msg.agents[0].room, row.rooms[0]);
  EXPECT_EQ(msg.agents[1].room, kNone);
  EXPECT_EQ(msg.edges.size(), 4U);
  EXPECT_EQ(msg.current_room, row.rooms[0]);
}

TEST(GraphConversions, UpdateSaysWhatChangedAndNothingElse) {
  Row row;
  const occusg::SceneGraphStamped before = toGraphMsg(row.view(1));
  EXPECT_TRUE(isEmpty(difference(before, toGraphMsg(row.view(2)))));

  const NodeId added = addRoom(row.graph, 0.0, 5.0);
  row.graph.remove(row.rooms[2]);
  const occusg::SceneGraphUpdate update = difference(before, toGraphMsg(row.view(2)));
  EXPECT_EQ(update.previous_sequence, 1U);
  EXPECT_EQ(update.sequence, 2U);
  ASSERT_EQ(update.rooms.size(), 2U) << "the new room, and the one that lost a neighbour";
  EXPECT_EQ(update.rooms[0].id, row.rooms[1]);
  EXPECT_EQ(update.rooms[1].id, added);
  EXPECT_EQ(update.removed_nodes, std::vector<std::int64_t>{row.rooms[2]});
  EXPECT_TRUE(update.doors_changed);
  EXPECT_EQ(update.doors.size(), 1U);
  ASSERT_EQ(update.removed_edges.size(), 1U);
  EXPECT_EQ(update.removed_edges[0].type, occusg::EdgeInfo::ROOM_ADJACENCY);
  EXPECT_TRUE(update.agents.empty());
  EXPECT_FALSE(update.room_changed);
}

TEST(GraphConversions, PolygonSurvivesTheWayThroughAMessage) {
  occusg::Polygon polygon = square(0.25, 0.5, 4.0);
  polygon.holes = {{{1.0, 1.0}, {1.0, 2.0}, {2.0, 2.0}}};
  const occusg::Polygon back = toPolygon(toPolygonMsg(polygon));
  EXPECT_EQ(back.outer, polygon.outer);
  EXPECT_EQ(back.holes, polygon.holes);
}

TEST(GraphConversions, FailureMode12DetectionsThatCannotBeUsedAreRefusedOneByOne) {
  occusg::DetectionArray msg;
  occusg::DetectionInfo good;
  good.class_name = "chair";
  good.score = 0.9;
  good.box_max.x = good.box_max.y = good.box_max.z = 1.0;
  msg.detections = {good, good, good, good, good};
  msg.detections[1].centroid.x = std::numeric_limits<double>::quiet_NaN();
  msg.detections[2].score = 1.5;
  msg.detections[3].box_min.z = 2.0;
  const ReceivedDetections received = toDetections(msg);
  EXPECT_EQ(received.detections.size(), 2U);
  EXPECT_EQ(received.refused, 3U);
  EXPECT_NE(received.first_refusal.find("detection 1"), std::string::npos);
}

TEST(GraphConversions, FailureMode12DetectionsAreCappedPerMessage) {
  occusg::DetectionArray msg;
  msg.detections.resize(100'000);
  const ReceivedDetections received = toDetections(msg);
  EXPECT_EQ(received.detections.size(), kMaxDetections);
  EXPECT_EQ(received.refused, 100'000U - kMaxDetections);
}

TEST(GraphConversions, DetectionsSurviveTheWayThroughAMessage) {
  occusg::Detection detection;
  detection.class_id = 3;
  detection.class_name = "bed";
  detection.score = 0.5;
  detection.centroid = {1.0, 2.0, 3.0};
  detection.box = Eigen::AlignedBox3d(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(2, 3, 4));
  detection.point_count = 77;
  const ReceivedDetections back = toDetections(toDetectionMsg({detection}, {}));
  ASSERT_EQ(back.detections.size(), 1U);
  EXPECT_EQ(back.detections[0].class_name, "bed");
  EXPECT_EQ(back.detections[0].centroid, detection.centroid);
  EXPECT_TRUE(back.detections[0].box.isApprox(detection.box));
  EXPECT_EQ(back.detections[0].point_count, 77U);
}

MarkerSet drawn(const Row& row) {
  MarkerLayout layout;
  std_msgs::Header header;
  header.frame_id = "map";
  return drawGraph(row.graph, {}, layout, header);
}

TEST(Markers, EveryLayerHasANamespaceAndRoomsKeepTheirColour) {
  Row row;
  const MarkerSet set = drawn(row);
  std::set<std::string> layers;
  for (const auto& entry : set) layers.insert(entry.first.first);
  for (const char* layer :
       {"room_floors", "room_outlines", "rooms", "room_labels", "adjacency", "doors", "trajectory"})
    EXPECT_EQ(layers.count(layer), 1U) << layer;
  const auto id = static_cast<std::int32_t>(row.rooms[1]);
  const std_msgs::ColorRGBA color = set.at({"rooms", id}).color;
  row.graph.remove(row.rooms[0]);
  EXPECT_EQ(drawn(row).at({"rooms", id}).color, color);
  EXPECT_FALSE(set.at({"rooms", id}).color == set.at({"rooms", id + 1}).color);
}

TEST(Markers, ChangesAddWhatIsNewAndDeleteWhatVanished) {
  Row row;
  const MarkerSet before = drawn(row);
  EXPECT_EQ(markerChanges({}, before).markers.size(), before.size());
  EXPECT_TRUE(markerChanges(before, before).markers.empty());

  row.graph.remove(row.rooms[2]);
  const visualization_msgs::MarkerArray changes = markerChanges(before, drawn(row));
  std::set<std::string> deleted;
  for (const visualization_msgs::Marker& marker : changes.markers) {
    EXPECT_NE(marker.action, visualization_msgs::Marker::DELETEALL);
    if (marker.action != visualization_msgs::Marker::DELETE) continue;
    deleted.insert(marker.ns);
    if (marker.ns == "doors") continue;
    EXPECT_EQ(marker.id, row.rooms[2]);
  }
  EXPECT_EQ(deleted, (std::set<std::string>{"doors", "room_floors", "room_labels", "room_outlines",
                                            "room_stems", "rooms"}));
}

TEST(Markers, FloorCoversTheAreaOfTheRoomWithoutItsHoles) {
  Row row;
  occusg::Node room = row.graph.at(row.rooms[0]);
  std::get<occusg::RoomAttributes>(room.attributes).polygon.holes = {
      {{0.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {1.5, 0.5}}};
  row.graph.update(room);
  const visualization_msgs::Marker floor =
      drawn(row).at({"room_floors", static_cast<std::int32_t>(row.rooms[0])});
  ASSERT_EQ(floor.points.size() % 3, 0U);
  double area_m2 = 0.0;
  for (std::size_t i = 0; i < floor.points.size(); i += 3) {
    const auto& a = floor.points[i];
    const auto& b = floor.points[i + 1];
    const auto& c = floor.points[i + 2];
    area_m2 += 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
  }
  EXPECT_NEAR(area_m2, 3.0, 0.05);
}

}  // namespace
}  // namespace occusg_ros
