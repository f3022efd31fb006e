// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/waiting_map.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <optional>

namespace occusg_ros {
namespace {

constexpr double kLongAfter_s = 100.0;

nav_msgs::OccupancyGridConstPtr gridOf(double stamp_s) {
  const auto grid = boost::make_shared<nav_msgs::OccupancyGrid>();
  grid->header.stamp = ros::Time(stamp_s);
  return grid;
}

occusg::OverheadGapsConstPtr gapsOf(double stamp_s) {
  const auto gaps = boost::make_shared<occusg::OverheadGaps>();
  gaps->header.stamp = ros::Time(stamp_s);
  return gaps;
}

TEST(WaitingMap, ALaserMapWaitsForNothing) {
  WaitingMap waiting;
  const auto grid = gridOf(1.0);
  EXPECT_FALSE(waiting.takeGrid(grid, 0.0));
  const std::optional<WaitingMap::Map> map = waiting.ready(GapsPublished::kNo, 0.0);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->grid, grid);
  EXPECT_EQ(map->gaps, nullptr);
  waiting.noteUsed(*map);
  EXPECT_TRUE(waiting.empty());
}

TEST(WaitingMap, GridAndGapsOfOneStampMeetInEitherOrder) {
  const auto gaps = gapsOf(1.0);
  WaitingMap gaps_first;
  gaps_first.takeGaps(gaps, 0.0);
  gaps_first.takeGrid(gridOf(1.0), 0.0);
  WaitingMap grid_first;
  grid_first.takeGrid(gridOf(1.0), 0.0);
  EXPECT_FALSE(grid_first.ready(GapsPublished::kYes, 0.0)) << "the gaps are on their way";
  grid_first.takeGaps(gaps, 0.1);
  for (const WaitingMap* waiting : {&gaps_first, &grid_first}) {
    const std::optional<WaitingMap::Map> map = waiting->ready(GapsPublished::kYes, 0.1);
    ASSERT_TRUE(map);
    EXPECT_EQ(map->gaps, gaps);
  }
}

TEST(WaitingMap, GapsOfAnotherStampDoNotCount) {
  WaitingMap waiting;
  waiting.takeGaps(gapsOf(1.0), 0.0);
  waiting.takeGrid(gridOf(2.0), 0.0);
  waiting.takeGaps(gapsOf(3.0), 0.0);
  EXPECT_FALSE(waiting.ready(GapsPublished::kYes, 0.1));
  const std::optional<WaitingMap::Map> map = waiting.ready(GapsPublished::kYes, kLongAfter_s);
  ASSERT_TRUE(map) << "patience ends";
  EXPECT_EQ(map->gaps, nullptr);
}

TEST(WaitingMap, TheNewestGridCounts) {
  WaitingMap waiting;
  waiting.takeGaps(gapsOf(1.0), 0.0);
  waiting.takeGrid(gridOf(1.0), 0.0);
  const std::optional<WaitingMap::Map> first = waiting.ready(GapsPublished::kYes, 0.0);
  ASSERT_TRUE(first);
  const auto second = gridOf(2.0);
  EXPECT_TRUE(waiting.takeGrid(second, 1.0)) << "one that waited gave way";
  waiting.noteUsed(*first);
  EXPECT_FALSE(waiting.empty()) << "the newer one still waits";
  EXPECT_EQ(waiting.ready(GapsPublished::kNo, 1.0)->grid, second);
}

TEST(WaitingMap, AGridKeepsItsGapsWhileThoseOfTheNextArrive) {
  WaitingMap waiting;
  const auto gaps = gapsOf(1.0);
  waiting.takeGaps(gaps, 0.0);
  waiting.takeGrid(gridOf(1.0), 0.0);
  for (const double stamp_s : {2.0, 3.0, 4.0}) waiting.takeGaps(gapsOf(stamp_s), 0.0);
  EXPECT_EQ(waiting.ready(GapsPublished::kYes, 0.0)->gaps, gaps);
}

TEST(WaitingMap, LateGapsBringBackTheGridThatWasUsedWithoutThem) {
  WaitingMap waiting;
  const auto grid = gridOf(1.0);
  waiting.takeGrid(grid, 0.0);
  waiting.noteUsed(*waiting.ready(GapsPublished::kNo, 0.0));
  const auto gaps = gapsOf(1.0);
  waiting.takeGaps(gaps, 1.0);
  const std::optional<WaitingMap::Map> again = waiting.ready(GapsPublished::kYes, 1.0);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->grid, grid);
  EXPECT_EQ(again->gaps, gaps);
  waiting.noteUsed(*again);
  waiting.takeGaps(gapsOf(1.0), 2.0);
  EXPECT_TRUE(waiting.empty()) << "once is enough";
}

TEST(WaitingMap, NothingComesBackAfterClearing) {
  WaitingMap waiting;
  waiting.takeGrid(gridOf(1.0), 0.0);
  waiting.noteUsed(*waiting.ready(GapsPublished::kNo, 0.0));
  waiting.clear();
  waiting.takeGaps(gapsOf(1.0), 1.0);
  EXPECT_TRUE(waiting.empty());
}

}  // namespace
}  // namespace occusg_ros
