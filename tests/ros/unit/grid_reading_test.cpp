// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/grid_reading.hpp"

#include <gtest/gtest.h>

#include "occusg/error.hpp"
#include "occusg_ros/saved_folder.hpp"
#include "occusg_ros/topic_names.hpp"

namespace occusg_ros {
namespace {

nav_msgs::OccupancyGrid gridOf(std::uint32_t width, std::vector<std::int8_t> data) {
  nav_msgs::OccupancyGrid grid;
  grid.header.frame_id = "map";
  grid.info.width = width;
  grid.info.height = static_cast<std::uint32_t>(data.size()) / width;
  grid.data = std::move(data);
  return grid;
}

map_msgs::OccupancyGridUpdate part(int x, int y, std::uint32_t width,
                                   std::vector<std::int8_t> data) {
  map_msgs::OccupancyGridUpdate update;
  update.header.frame_id = "map";
  update.header.stamp = ros::Time(9.0);
  update.x = x;
  update.y = y;
  update.width = width;
  update.height = static_cast<std::uint32_t>(data.size()) / width;
  update.data = std::move(data);
  return update;
}

TEST(GridReading, MapOfFreeAndOccupiedIsReadAsItIs) {
  const GridReading reading = readingOf({0, 0, 0, 100, -1, 40}, {0.0, 0.0});
  EXPECT_EQ(reading.values, unchangedValues());
  EXPECT_TRUE(reading.assumption.empty());
}

TEST(GridReading, ProbabilitiesAreDecidedAtOneHalfAndThisIsSaid) {
  const GridReading reading = readingOf({5, 12, 34, 40, 60, 95, -1}, {0.0, 0.0});
  EXPECT_EQ(reading.values[49], 0);
  EXPECT_EQ(reading.values[50], -1);
  EXPECT_EQ(reading.values[51], 100);
  EXPECT_NE(reading.assumption.find("100 % of the known cells"), std::string::npos);
}

TEST(GridReading, GivenThresholdsDecide) {
  const GridReading reading = readingOf({0, 100, 30}, {35.0, 65.0});
  EXPECT_EQ(reading.values[34], 0);
  EXPECT_EQ(reading.values[35], -1);
  EXPECT_EQ(reading.values[66], 100);
  EXPECT_TRUE(reading.assumption.empty());
}

TEST(GridUpdate, PartReplacesItsCellsOnly) {
  const nav_msgs::OccupancyGrid grid = gridOf(3, {0, 0, 0, 0, 0, 0});
  const nav_msgs::OccupancyGrid after = updated(grid, part(1, 0, 2, {1, 2, 3, 4}), "map_updates");
  EXPECT_EQ(after.data, (std::vector<std::int8_t>{0, 1, 2, 0, 3, 4}));
  EXPECT_EQ(after.header.stamp, ros::Time(9.0));
}

TEST(GridUpdate, PartThatDoesNotFitIsRefused) {
  const nav_msgs::OccupancyGrid grid = gridOf(3, {0, 0, 0, 0, 0, 0});
  EXPECT_THROW((void)updated(grid, part(2, 0, 2, {1, 2}), "u"), occusg::Error);
  EXPECT_THROW((void)updated(grid, part(-1, 0, 1, {1}), "u"), occusg::Error);
  map_msgs::OccupancyGridUpdate huge = part(1, 1, 1, {1});
  huge.width = 0xFFFFFFFF;
  huge.height = 0xFFFFFFFF;
  EXPECT_THROW((void)updated(grid, huge, "u"), occusg::Error);
  map_msgs::OccupancyGridUpdate elsewhere = part(0, 0, 1, {1});
  elsewhere.header.frame_id = "odom";
  EXPECT_THROW((void)updated(grid, elsewhere, "u"), occusg::Error);
}

TEST(TopicNames, RelativeTopicsLieInTheRobotsNamespace) {
  EXPECT_EQ(inputTopic("/occusg", "camera/depth/image_rect", "depth/image_rect"),
            "/camera/depth/image_rect");
  EXPECT_EQ(inputTopic("/robot1/occusg", "map", "free_space"), "/robot1/map");
  EXPECT_EQ(inputTopic("/robot1/occusg", "/map", "free_space"), "/map");
  EXPECT_EQ(inputTopic("/robot1/occusg", "", "free_space"), "free_space");
  EXPECT_EQ(inputTopic("/", "map", "free_space"), "/map");
}

TEST(SavedFolder, RobotsInNamespacesKeepApart) {
  const std::string alone = expandedFolder("", "/occusg");
  EXPECT_EQ(expandedFolder("", "/robot1/occusg"), alone + "/robot1");
  EXPECT_EQ(expandedFolder("", "/"), alone);
  EXPECT_EQ(expandedFolder("/data", "/robot1/occusg"), "/data");
}

}  // namespace
}  // namespace occusg_ros
