// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/grid_conversions.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

using occusg::Cell;
using occusg::CellBox;
using occusg::FreeSpace;

// 3 x 2 cells of 0.5 m with its lower left corner at (1, -1); one obstacle at the upper right.
nav_msgs::OccupancyGrid smallGrid() {
  nav_msgs::OccupancyGrid grid;
  grid.info.resolution = 0.5F;
  grid.info.width = 3;
  grid.info.height = 2;
  grid.info.origin.position.x = 1.0;
  grid.info.origin.position.y = -1.0;
  grid.info.origin.orientation.w = 1.0;
  grid.data = {0, 0, -1, 0, 0, 100};
  return grid;
}

std::string refusalOf(const nav_msgs::OccupancyGrid& grid) {
  try {
    (void)toFreeSpace(grid, "map");
  } catch (const occusg::Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GridConversions, LayerSurvivesTheWayThroughAMessage) {
  FreeSpace layer;
  layer.frame.resolution_m = 0.05;
  layer.cells = occusg::FreeSpaceCells(CellBox{{-7, 3}, {2, 5}}, occusg::kFree);
  layer.cells.at({-7, 4}) = 42;
  layer.cells.at({1, 3}) = occusg::kUnknown;
  const FreeSpace back = toFreeSpace(toGridMsg(layer, {}), "map");
  EXPECT_EQ(back.cells, layer.cells);
  EXPECT_DOUBLE_EQ(back.frame.resolution_m, 0.05);
  EXPECT_EQ(back.changed, layer.cells.box());
}

TEST(GridConversions, CellsLieWhereTheOriginSays) {
  const FreeSpace layer = toFreeSpace(smallGrid(), "map");
  EXPECT_EQ(layer.cells.box(), (CellBox{{2, -2}, {5, 0}}));
  EXPECT_EQ(layer.cells.at({4, -1}), occusg::kFullObstacle);
  EXPECT_EQ(layer.cells.at({4, -2}), occusg::kUnknown);
}

TEST(GridConversions, OriginBetweenCellsMovesTheMapByHalfACellAtMost) {
  nav_msgs::OccupancyGrid grid = smallGrid();
  grid.info.origin.position.x = 1.2;
  EXPECT_EQ(toFreeSpace(grid, "map").cells.box().min, (Cell{2, -2}));
  grid.info.origin.position.x = 1.3;
  EXPECT_EQ(toFreeSpace(grid, "map").cells.box().min, (Cell{3, -2}));
}

TEST(GridConversions, FailureMode11RotatedOriginIsHonoured) {
  nav_msgs::OccupancyGrid grid = smallGrid();
  grid.info.origin.position.x = 0.0;
  grid.info.origin.position.y = 0.0;
  // A quarter turn: the grid's x runs along the map's y, its y along the map's -x.
  grid.info.origin.orientation.z = std::sqrt(0.5);
  grid.info.origin.orientation.w = std::sqrt(0.5);
  const FreeSpace layer = toFreeSpace(grid, "map");
  EXPECT_EQ(layer.cells.valueOr({-2, 2}, 1), occusg::kFullObstacle);
  EXPECT_EQ(layer.cells.valueOr({-1, 2}, 1), occusg::kUnknown);
  EXPECT_EQ(layer.cells.valueOr({-1, 0}, 1), occusg::kFree);
}

TEST(GridConversions, FailureMode11MapsThatCannotBeUsedAreRefused) {
  EXPECT_EQ(refusalOf(smallGrid()), "accepted");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float resolution : {0.0F, -0.05F, nan, 1e9F}) {
    nav_msgs::OccupancyGrid grid = smallGrid();
    grid.info.resolution = resolution;
    EXPECT_NE(refusalOf(grid).find("resolution"), std::string::npos) << resolution;
  }
  nav_msgs::OccupancyGrid short_of_data = smallGrid();
  short_of_data.data.pop_back();
  EXPECT_NE(refusalOf(short_of_data).find("5 cells"), std::string::npos);

  nav_msgs::OccupancyGrid huge = smallGrid();
  huge.info.width = huge.info.height = 0xFFFFFFFFU;
  EXPECT_NE(refusalOf(huge), "accepted");

  for (const std::int8_t value : {std::int8_t{-2}, std::int8_t{101}, std::int8_t{-128}}) {
    nav_msgs::OccupancyGrid grid = smallGrid();
    grid.data[3] = value;
    EXPECT_NE(refusalOf(grid).find(std::to_string(value)), std::string::npos);
  }
  nav_msgs::OccupancyGrid tilted = smallGrid();
  tilted.info.origin.orientation.x = std::sqrt(0.5);
  tilted.info.origin.orientation.w = std::sqrt(0.5);
  EXPECT_NE(refusalOf(tilted).find("tilted"), std::string::npos);

  nav_msgs::OccupancyGrid nowhere = smallGrid();
  nowhere.info.origin.position.x = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusalOf(nowhere), "accepted");

  nav_msgs::OccupancyGrid far = smallGrid();
  far.info.origin.position.x = 1e12;
  EXPECT_NE(refusalOf(far), "accepted");
}

TEST(GridConversions, EmptyMapIsAnEmptyLayer) {
  nav_msgs::OccupancyGrid grid = smallGrid();
  grid.info.width = grid.info.height = 0;
  grid.data.clear();
  EXPECT_TRUE(toFreeSpace(grid, "map").cells.empty());
}

TEST(GridConversions, LabelImageFollowsTheRowsOfTheMap) {
  const nav_msgs::OccupancyGrid grid = smallGrid();
  occusg::Decomposition decomposition;
  decomposition.frame.resolution_m = 0.5;
  decomposition.labels = occusg::Grid<std::int32_t>(CellBox{{2, -2}, {5, 0}}, occusg::kNoRegion);
  decomposition.labels.at({3, -1}) = 7;
  const sensor_msgs::Image image = toLabelImage(decomposition, grid);
  ASSERT_EQ(image.data.size(), 6 * sizeof(std::int32_t));
  std::int32_t labels[6];
  std::memcpy(labels, image.data.data(), sizeof(labels));
  EXPECT_EQ(labels[4], 7);
  EXPECT_EQ(labels[1], 0);
}

TEST(GridConversions, FailureMode10OccupiedHalfOfTheWorldShowsNoMoreVoxelsThanTheCap) {
  octomap::OcTree tree(0.1);
  tree.updateNode(0.05F, 0.05F, 0.05F, false);
  tree.createNodeChild(tree.getRoot(), 0)->setLogOdds(2.0F);
  const sensor_msgs::PointCloud2 cloud = occupiedVoxels(tree, {});
  EXPECT_EQ(cloud.width * cloud.height, kMaxShownVoxels);
}

TEST(GridConversions, OccupiedVoxelsOfAPrunedLeafAreAllShown) {
  octomap::OcTree tree(0.1);
  for (float x = 0.05F; x < 0.2F; x += 0.1F)
    for (float y = 0.05F; y < 0.2F; y += 0.1F)
      for (float z = 0.05F; z < 0.2F; z += 0.1F) tree.updateNode(x, y, z, true);
  tree.updateNode(1.05F, 1.05F, 1.05F, false);
  tree.prune();
  const sensor_msgs::PointCloud2 cloud = occupiedVoxels(tree, {});
  ASSERT_EQ(cloud.width * cloud.height, 8U);
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x");
  EXPECT_NEAR(x[0], 0.05F, 1e-4F);
  EXPECT_NEAR((x + 7)[2], 0.15F, 1e-4F);
}

// What octomap_msgs/Octomap looks like, where it is not installed.
struct OctomapLookalike {
  std_msgs::Header header;
  bool binary = false;
  std::string id;
  double resolution = 0.0;
  std::vector<std::int8_t> data;
};

TEST(GridConversions, OctomapMessageReadsBackAsTheSameTree) {
  octomap::OcTree tree(0.1);
  tree.updateNode(0.05F, 0.05F, 0.05F, true);
  tree.updateNode(0.55F, 0.05F, 0.05F, false);
  const auto msg = toOctomapMsg<OctomapLookalike>(tree, {});
  EXPECT_EQ(msg.id, "OcTree");
  octomap::OcTree back(msg.resolution);
  std::stringstream stream(std::string(msg.data.begin(), msg.data.end()));
  back.readBinaryData(stream);
  EXPECT_EQ(back.size(), tree.size());
  ASSERT_NE(back.search(0.05, 0.05, 0.05), nullptr);
  EXPECT_TRUE(back.isNodeOccupied(back.search(0.05, 0.05, 0.05)));
}

}  // namespace
}  // namespace occusg_ros
