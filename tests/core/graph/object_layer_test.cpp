// SPDX-License-Identifier: BSD-3-Clause
#include "graph/object_layer.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <limits>
#include <string>
#include <vector>

#include "graph/free_space_links.hpp"
#include "graph/ghost_check.hpp"

namespace occusg {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A cube of side 0.4 m around (x, 0, 0.5).
Detection seen(const std::string& class_name, double x, double side_m = 0.4) {
  Detection detection;
  detection.class_name = class_name;
  detection.score = 0.8;
  detection.centroid = {x, 0.0, 0.5};
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(side_m / 2.0);
  detection.box = {Eigen::Vector3d(detection.centroid - half),
                   Eigen::Vector3d(detection.centroid + half)};
  return detection;
}

ObjectLayerConfig paper() {
  ObjectLayerConfig config;
  config.memory = ObjectMemory::kFirstSight;
  config.ghosts = GhostRemoval::kNever;
  return config;
}

std::size_t objectsAfter(const ObjectLayerConfig& config,
                         const std::vector<Detection>& detections) {
  SceneGraph graph;
  ObjectLayer layer(config);
  for (const Detection& detection : detections) layer.observe(graph, {detection}, 1.0);
  return graph.nodes(NodeType::kObject).size();
}

const ObjectAttributes& onlyObject(const SceneGraph& graph) {
  return std::get<ObjectAttributes>(graph.nodes(NodeType::kObject).begin()->second.attributes);
}

TEST(ObjectLayer, SameClassWithinThreeQuartersOfAMetreMerges) {
  EXPECT_EQ(objectsAfter(paper(), {seen("chair", 0.0), seen("chair", 0.74)}), 1U);
  EXPECT_EQ(objectsAfter(paper(), {seen("chair", 0.0), seen("chair", 0.76)}), 2U);
  EXPECT_EQ(objectsAfter(paper(), {seen("chair", 0.0), seen(" Chair", 0.5)}), 1U);
  EXPECT_EQ(objectsAfter(paper(), {seen("chair", 0.0), seen("table", 0.5)}), 2U);
}

TEST(ObjectLayer, UnlabelledObjectsStayDistinct) {
  EXPECT_EQ(objectsAfter(paper(), {seen("", 0.0), seen("", 0.3)}), 2U);
  EXPECT_EQ(objectsAfter({}, {seen("", 0.0), seen("", 0.3)}), 2U);
}

TEST(ObjectLayer, PaperTakesAnyClassWithinFifteenCentimetresForFlicker) {
  EXPECT_EQ(objectsAfter(paper(), {seen("chair", 0.0), seen("table", 0.14)}), 1U);
  EXPECT_EQ(objectsAfter(paper(), {seen("chair", 0.0), seen("table", 0.16)}), 2U);
}

TEST(ObjectLayer, PaperFreezesAnObjectAtFirstSight) {
  SceneGraph graph;
  ObjectLayer layer(paper());
  layer.observe(graph, {seen("chair", 0.0)}, 1.0);
  Detection later = seen("chair", 0.2, 0.8);
  later.score = 0.95;
  layer.observe(graph, {later}, 5.0);
  const Node& node = graph.nodes(NodeType::kObject).begin()->second;
  EXPECT_EQ(node.position.x(), 0.0);
  EXPECT_EQ(node.last_seen_s, 5.0);
  EXPECT_EQ(onlyObject(graph).score, 0.8);
  EXPECT_NEAR(onlyObject(graph).box.sizes().x(), 0.4, 1e-12);
  EXPECT_EQ(onlyObject(graph).observations, 2);
}

TEST(ObjectLayer, KeepsMeanPlaceCommonBoxAndHistogram) {
  SceneGraph graph;
  ObjectLayer layer{ObjectLayerConfig{}};
  layer.observe(graph, {seen("chair", 0.0)}, 1.0);
  layer.observe(graph, {seen("chair", 0.1)}, 2.0);
  layer.observe(graph, {seen("stool", 0.05)}, 3.0);
  ASSERT_EQ(graph.nodes(NodeType::kObject).size(), 1U);
  const Node& node = graph.nodes(NodeType::kObject).begin()->second;
  EXPECT_NEAR(node.position.x(), 0.05, 1e-12);
  EXPECT_NEAR(onlyObject(graph).box.min().x(), -0.2, 1e-12);
  EXPECT_NEAR(onlyObject(graph).box.max().x(), 0.3, 1e-12);
  EXPECT_EQ(onlyObject(graph).class_name, "chair");
  EXPECT_NEAR(onlyObject(graph).class_histogram.at("chair"), 1.6, 1e-12);
  EXPECT_NEAR(onlyObject(graph).class_histogram.at("stool"), 0.8, 1e-12);
  EXPECT_EQ(onlyObject(graph).observations, 3);
  layer.observe(graph, {seen("stool", 0.05), seen("stool", 0.05)}, 4.0);
  EXPECT_EQ(onlyObject(graph).class_name, "stool") << "seen three times by now";
}

TEST(ObjectLayer, NeighboursOfAClassStayApart) {
  EXPECT_EQ(objectsAfter({}, {seen("chair", 0.0), seen("chair", 0.5)}), 2U);
}

TEST(ObjectLayer, AnObjectFirstSeenInPiecesBecomesOne) {
  SceneGraph graph;
  ObjectLayer layer{ObjectLayerConfig{}};
  layer.observe(graph, {seen("sofa", -0.8, 0.6), seen("sofa", 0.8, 0.6)}, 1.0);
  EXPECT_EQ(graph.nodes(NodeType::kObject).size(), 2U);
  Detection whole = seen("sofa", 0.0, 0.6);
  whole.box.extend(seen("sofa", -0.8, 0.6).box);
  whole.box.extend(seen("sofa", 0.8, 0.6).box);
  layer.observe(graph, {whole}, 2.0);
  ASSERT_EQ(graph.nodes(NodeType::kObject).size(), 1U);
  EXPECT_EQ(graph.nodes(NodeType::kObject).begin()->first, firstId(NodeType::kObject));
  EXPECT_EQ(onlyObject(graph).observations, 3);
  EXPECT_EQ(layer.counts().merged, 1U);
}

TEST(ObjectLayer, NeighboursSeenInOneFrameStayTwoThoughTheirBoxesOverlap) {
  // As two desks that stand askew: their boxes along the axes have half in common.
  const Detection left = seen("desk", 0.0, 1.0);
  const Detection right = seen("desk", 0.5, 1.0);
  EXPECT_EQ(objectsAfter({}, {left, right}), 1U) << "without a frame that shows both";
  SceneGraph graph;
  ObjectLayer layer{ObjectLayerConfig{}};
  for (int frame = 0; frame < 5; ++frame) layer.observe(graph, {left, right}, frame);
  layer.observe(graph, {right}, 5.0);
  layer.observe(graph, {left}, 6.0);
  ASSERT_EQ(graph.nodes(NodeType::kObject).size(), 2U);
  for (const auto& [id, node] : graph.nodes(NodeType::kObject)) {
    EXPECT_EQ(std::get<ObjectAttributes>(node.attributes).observations, 6);
    EXPECT_NEAR(std::get<ObjectAttributes>(node.attributes).box.sizes().x(), 1.0, 1e-12);
  }
}

TEST(ObjectLayer, ADetectorsSingleMistakeDoesNotPartAnObject) {
  const Detection left = seen("desk", 0.0, 1.0);
  const Detection right = seen("desk", 0.5, 1.0);
  SceneGraph graph;
  ObjectLayer layer{ObjectLayerConfig{}};
  layer.observe(graph, {left, right}, 0.0);
  EXPECT_EQ(graph.nodes(NodeType::kObject).size(), 2U);
  for (int frame = 1; frame < 12; ++frame) layer.observe(graph, {left}, frame);
  EXPECT_EQ(graph.nodes(NodeType::kObject).size(), 1U);
}

/// What was seen of a table: a box of this outline from one height to another.
Detection piece(double x0, double x1, double z0, double z1) {
  Detection detection = seen("table", 0.0);
  detection.box = {Eigen::Vector3d(x0, 0.0, z0), Eigen::Vector3d(x1, 0.6, z1)};
  detection.centroid = detection.box.center();
  return detection;
}

TEST(ObjectLayer, ATablesLegsAndTopAreOneObject) {
  const Detection top = piece(0.0, 1.6, 0.75, 0.79);
  const Detection leg = piece(0.05, 0.15, 0.0, 0.7);
  EXPECT_EQ(objectsAfter({}, {top, leg}), 1U);
  EXPECT_EQ(objectsAfter({}, {leg, top}), 1U);
  EXPECT_EQ(objectsAfter({}, {top, piece(1.7, 1.8, 0.0, 0.7)}), 2U) << "beside its outline";
  EXPECT_EQ(objectsAfter({}, {top, piece(0.0, 1.6, 2.0, 2.2)}), 2U) << "far above it";
  EXPECT_EQ(objectsAfter(paper(), {top, leg}), 2U) << "the paper's objects are frozen";
}

TEST(ObjectLayer, StackedThingsSeenInOneFrameStayTwo) {
  const Detection lower = piece(0.0, 0.6, 0.0, 0.3);
  const Detection upper = piece(0.0, 0.6, 0.3, 0.6);
  SceneGraph graph;
  ObjectLayer layer{ObjectLayerConfig{}};
  for (int frame = 0; frame < 3; ++frame) layer.observe(graph, {lower, upper}, frame);
  EXPECT_EQ(graph.nodes(NodeType::kObject).size(), 2U);
}

TEST(SeenApart, FollowsObjectsThatMergeAndGo) {
  SeenApart apart;
  apart.add(1, 2);
  apart.add(2, 1);
  apart.add(2, 3);
  EXPECT_EQ(apart.count(1, 2), 2);
  EXPECT_EQ(apart.count(3, 2), 1);
  EXPECT_EQ(apart.count(1, 3), 0);
  apart.merge(1, 3);
  EXPECT_EQ(apart.count(2, 1), 3);
  EXPECT_EQ(apart.count(2, 3), 0);
  apart.merge(1, 2);
  EXPECT_EQ(apart.count(1, 2), 0) << "nothing is apart from itself";
  apart.add(1, 4);
  apart.erase(4);
  EXPECT_EQ(apart.count(1, 4), 0);
}

TEST(SeenApart, IsTheSameWhenMadeFromItsPairs) {
  SeenApart apart;
  apart.add(2, 1);
  apart.add(1, 2);
  apart.add(3, 2);
  EXPECT_EQ(apart.pairs(), (ObjectPairCounts{{{1, 2}, 2}, {{2, 3}, 1}}));
  SeenApart again(apart.pairs());
  again.merge(1, 3);
  EXPECT_EQ(again.pairs(), (ObjectPairCounts{{{1, 2}, 3}}));
}

TEST(ObjectLayer, RefusesAndCountsWhatIsNoDetection) {
  SceneGraph graph;
  ObjectLayer layer{ObjectLayerConfig{}};
  std::vector<Detection> bad(6, seen("chair", 0.0));
  bad[0].centroid.x() = kNaN;
  bad[1].score = kNaN;
  bad[2].score = 1.5;
  bad[3].box.setEmpty();
  bad[4].box.max().z() = std::numeric_limits<double>::infinity();
  bad[5].box.extend(Eigen::Vector3d(1e6, 0.0, 0.0));
  layer.observe(graph, bad, 1.0);
  EXPECT_EQ(layer.counts().refused, 6U);
  EXPECT_EQ(graph.nodeCount(), 0U);
  EXPECT_EQ(graph.revision(), 0U) << "the live graph is untouched";
}

TEST(ObjectLayer, AHundredThousandDetectionsInAFrameAreCapped) {
  SceneGraph graph;
  ObjectLayer layer{ObjectLayerConfig{}};
  std::vector<Detection> flood(100'000, seen("chair", 0.0));
  for (std::size_t i = 0; i < flood.size(); ++i) flood[i].score = i == 77'777 ? 0.9 : 0.5;
  flood[77'777].centroid.x() = 9.0;
  layer.observe(graph, flood, 1.0);
  EXPECT_EQ(layer.counts().detections, kMaxDetectionsPerFrame);
  EXPECT_EQ(layer.counts().over_limit, 100'000U - kMaxDetectionsPerFrame);
  EXPECT_EQ(graph.nodes(NodeType::kObject).size(), 1U);
  EXPECT_GT(onlyObject(graph).score, 0.5) << "the best is among those taken";
}

/// A map in which the cube [0, 2]^3 is known.
octomap::OcTree cubeOf(bool occupied) {
  octomap::OcTree map(0.05);
  for (double z = 0.025; z < 2.0; z += 0.05)
    for (double y = 0.025; y < 2.0; y += 0.05)
      for (double x = 0.025; x < 2.0; x += 0.05) map.updateNode(x, y, z, occupied, true);
  map.updateInnerOccupancy();
  return map;
}

TEST(ObjectLayer, AnObjectSeenThroughThreeTimesInARowIsAGhost) {
  Detection chair = seen("chair", 1.0);
  chair.centroid = {1.0, 1.0, 1.0};
  chair.box = {Eigen::Vector3d(0.8, 0.8, 0.8), Eigen::Vector3d(1.2, 1.2, 1.2)};
  SceneGraph graph;
  ObjectLayer layer{ObjectLayerConfig{}};
  layer.observe(graph, {chair}, 1.0);
  const octomap::OcTree empty_space = cubeOf(false);
  const octomap::OcTree solid = cubeOf(true);
  const octomap::OcTree unknown(0.05);
  layer.removeGhosts(graph, empty_space, {0.0, 0.0}, 8.0);
  layer.removeGhosts(graph, empty_space, {0.0, 0.0}, 8.0);
  layer.removeGhosts(graph, solid, {0.0, 0.0}, 8.0);
  for (int i = 0; i < 5; ++i) layer.removeGhosts(graph, unknown, {0.0, 0.0}, 8.0);
  for (int i = 0; i < 5; ++i) layer.removeGhosts(graph, empty_space, {50.0, 0.0}, 8.0);
  layer.removeGhosts(graph, empty_space, {0.0, 0.0}, 8.0);
  layer.removeGhosts(graph, empty_space, {0.0, 0.0}, 8.0);
  EXPECT_EQ(graph.nodes(NodeType::kObject).size(), 1U);
  layer.removeGhosts(graph, empty_space, {0.0, 0.0}, 8.0);
  EXPECT_TRUE(graph.nodes(NodeType::kObject).empty());
  EXPECT_EQ(layer.counts().ghosts, 1U);

  ObjectLayer keeper(paper());
  keeper.observe(graph, {chair}, 1.0);
  for (int i = 0; i < 5; ++i) keeper.removeGhosts(graph, empty_space, {0.0, 0.0}, 8.0);
  EXPECT_EQ(graph.nodes(NodeType::kObject).size(), 1U);
}

TEST(ObjectLayer, LooksThatFoundAnObjectsSpaceFreeCountAfterARestore) {
  const Detection chair = seen("chair", 1.0);
  SceneGraph graph;
  ObjectLayer first{ObjectLayerConfig{}};
  first.observe(graph, {chair}, 1.0);
  octomap::OcTree empty_space(0.05);
  for (double z = 0.225; z < 0.8; z += 0.05)
    for (double y = -0.275; y < 0.3; y += 0.05)
      for (double x = 0.725; x < 1.3; x += 0.05) empty_space.updateNode(x, y, z, false);
  for (int i = 0; i < 2; ++i) first.removeGhosts(graph, empty_space, {0.0, 0.0}, 8.0);
  ObjectLayer second{ObjectLayerConfig{}};
  second.restore(graph, first.state());
  second.removeGhosts(graph, empty_space, {0.0, 0.0}, 8.0);
  EXPECT_TRUE(graph.nodes(NodeType::kObject).empty());
}

TEST(GhostCheck, ATableIsNotSeenThroughThoughTheSpaceBelowItsTopIsFree) {
  for (const double top_m : {0.79, 0.801, 1.02, 1.6}) {
    SCOPED_TRACE(top_m);
    octomap::OcTree map = cubeOf(false);
    const Eigen::AlignedBox3d table(Eigen::Vector3d(0.2, 0.2, 0.0),
                                    Eigen::Vector3d(1.8, 1.0, top_m));
    EXPECT_TRUE(isSeenThrough(map, table));
    for (double y = 0.225; y < 1.0; y += 0.05)
      for (double x = 0.225; x < 1.8; x += 0.05)
        map.setNodeValue(x, y, top_m - 0.005, map.getClampingThresMaxLog());
    EXPECT_FALSE(isSeenThrough(map, table));
  }
}

// A hob in a worktop: 0.1 m thick, so that between the voxels it shares with the worktop and with
// the air above there is a single layer, in which its surface may or may not be.
TEST(GhostCheck, APlateIsNotSeenThroughThoughItsBoxEndsAMillimetreAboveIt) {
  for (const double bottom_m : {0.89, 0.905, 0.94}) {
    for (const double above_m : {-0.001, 0.001, 0.01, 0.02}) {
      SCOPED_TRACE(std::to_string(bottom_m) + " to " + std::to_string(1.0 + above_m));
      octomap::OcTree map = cubeOf(false);
      const Eigen::AlignedBox3d plate(Eigen::Vector3d(0.2, 0.2, bottom_m),
                                      Eigen::Vector3d(0.8, 1.2, 1.0 + above_m));
      const bool has_inside = 1.0 + above_m - bottom_m > 0.05;
      EXPECT_EQ(isSeenThrough(map, plate), has_inside) << "there is nothing in it";
      for (double y = 0.225; y < 1.2; y += 0.05)
        for (double x = 0.225; x < 0.8; x += 0.05)
          map.setNodeValue(x, y, 0.999, map.getClampingThresMaxLog());
      EXPECT_FALSE(isSeenThrough(map, plate));
    }
  }
}

TEST(GhostCheck, AThinThingThatLayOnTheFloorIsSeenThroughOnceItIsGone) {
  octomap::OcTree map = cubeOf(false);
  for (double y = 0.025; y < 2.0; y += 0.05)
    for (double x = 0.025; x < 2.0; x += 0.05)
      map.setNodeValue(x, y, 0.025, map.getClampingThresMaxLog());
  const auto box = [](double top_m) {
    return Eigen::AlignedBox3d(Eigen::Vector3d(0.2, 0.2, -0.005), Eigen::Vector3d(0.8, 1.2, top_m));
  };
  EXPECT_TRUE(isSeenThrough(map, box(0.08)));
  EXPECT_FALSE(isSeenThrough(map, box(0.06))) << "too thin to be told from the floor";
}

TEST(FreeSpaceLinks, AnObjectIsLinkedToTheNearestNodeWithinReach) {
  SceneGraph graph;
  FreeSpaceLinks links(1.0);
  const NodeId object = graph.add({0, 0, 0}, 1.0, ObjectAttributes{}).id;
  const NodeId far = graph.add({1.01, 0, 0}, 1.0, NavigationAttributes{}).id;
  links.update(graph);
  EXPECT_TRUE(graph.targets(EdgeType::kNearestFreeSpace, object).empty());
  const NodeId near = graph.add({0.9, 0, 0}, 1.0, NavigationAttributes{}).id;
  links.update(graph);
  EXPECT_EQ(graph.targets(EdgeType::kNearestFreeSpace, object), std::vector<NodeId>{near});
  graph.add({0.0, 0.86, 0}, 1.0, NavigationAttributes{});
  links.update(graph);
  EXPECT_EQ(graph.targets(EdgeType::kNearestFreeSpace, object), std::vector<NodeId>{near})
      << "four centimetres are no reason";
  const NodeId nearest = graph.add({0.0, 0.8, 0}, 1.0, NavigationAttributes{}).id;
  links.update(graph);
  EXPECT_EQ(graph.targets(EdgeType::kNearestFreeSpace, object), std::vector<NodeId>{nearest});
  graph.remove(nearest);
  graph.remove(far);
  links.update(graph);
  EXPECT_EQ(graph.targets(EdgeType::kNearestFreeSpace, object).size(), 1U);
}

}  // namespace
}  // namespace occusg
