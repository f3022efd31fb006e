// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/drivable_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "error_sentence.hpp"
#include "mapping/cells_on_line.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;

FreeSpace freeField(int width, int height) {
  FreeSpace layer;
  layer.frame.resolution_m = 0.1;
  layer.cells = FreeSpaceCells({{0, 0}, {width, height}}, kFree);
  return layer;
}

PathEnd endAt(const Point2& point, const std::string& name) {
  constexpr double kHalf = 0.3;
  return {point,
          {{{point.x - kHalf, point.y - kHalf},
            {point.x + kHalf, point.y - kHalf},
            {point.x + kHalf, point.y + kHalf},
            {point.x - kHalf, point.y + kHalf}},
           {}},
          name};
}

/// Smallest distance between the path and the middle of a closed cell, less half a cell.
double clearanceOf(const DrivablePath& path, const FreeSpace& layer) {
  double smallest = 1e9;
  const CellBox box = layer.cells.box();
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      if (layer.cells.at({x, y}) == kFree) continue;
      for (const Point2& point : path.points)
        smallest = std::min(smallest, distance(point, layer.frame.center({x, y})));
    }
  }
  return smallest - 0.5 * layer.frame.resolution_m;
}

TEST(DrivablePath, KeepsTheRadiusFromAnObstacleBetweenTheEnds) {
  FreeSpace layer = freeField(60, 40);
  for (int y = 0; y < 30; ++y) layer.cells.at({30, y}) = kFullObstacle;
  DrivablePathConfig config;
  config.robot_radius_m = 0.3;
  const DrivablePath path =
      drivablePath(layer, endAt({1.0, 1.0}, "a"), endAt({5.0, 1.0}, "b"), config);
  EXPECT_GE(clearanceOf(path, layer), 0.3 - 0.05) << "the spaced points lie between cells";
  EXPECT_GT(path.length_m, 6.0) << "it goes around the wall";
  EXPECT_LT(path.length_m, 7.0) << "and is pulled straight";
  for (std::size_t i = 1; i < path.points.size(); ++i)
    EXPECT_LE(distance(path.points[i - 1], path.points[i]), config.max_spacing_m + 1e-9);
}

TEST(DrivablePath, InTheOpenItIsOneStraightLine) {
  const DrivablePath path = drivablePath(freeField(60, 40), endAt({1.0, 1.0}, "a"),
                                         endAt({5.0, 3.0}, "b"), DrivablePathConfig{});
  EXPECT_NEAR(path.length_m, std::hypot(4.0, 2.0), 0.1);
}

TEST(DrivablePath, WhatIsUnknownIsNotDrivenOn) {
  FreeSpace layer = freeField(60, 40);
  for (int y = 0; y < 40; ++y) layer.cells.at({30, y}) = kUnknown;
  EXPECT_TRUE(
      tells(sentenceOf([&] {
              (void)drivablePath(layer, endAt({1, 1}, "hall"), endAt({5, 1}, "kitchen"), {});
            }),
            {"hall", "kitchen", "no free space leads there"}));
}

TEST(DrivablePath, TooNarrowADoorIsNamedWithItsWidth) {
  FreeSpace layer = freeField(60, 40);
  for (int y = 0; y < 40; ++y)
    if (y < 18 || y >= 22) layer.cells.at({30, y}) = kFullObstacle;
  DrivablePathConfig config;
  config.robot_radius_m = 0.4;
  EXPECT_TRUE(tells(sentenceOf([&] {
                      (void)drivablePath(layer, endAt({1, 2}, "a"), endAt({5, 2}, "b"), config);
                    }),
                    {"the widest way lets a radius of 0.1", "the robot's is 0.40 m"}));
}

TEST(DrivablePath, EveryPathBetweenRandomObstaclesIsFree) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> column(0, 79), row(0, 59);
  int found = 0;
  for (int round = 0; round < 20; ++round) {
    FreeSpace layer = freeField(80, 60);
    for (int i = 0; i < 40; ++i) layer.cells.at({column(random), row(random)}) = kFullObstacle;
    DrivablePathConfig config;
    config.robot_radius_m = 0.2;
    try {
      const DrivablePath path =
          drivablePath(layer, endAt({1.0, 1.0}, "a"), endAt({7.0, 5.0}, "b"), config);
      ++found;
      EXPECT_GE(clearanceOf(path, layer), 0.2 - 0.05);
    } catch (const Error&) {
      continue;
    }
  }
  EXPECT_GT(found, 0);
}

TEST(CellsOnLine, ALineThroughACornerTouchesBothSides) {
  const GridFrame frame{1.0};
  std::vector<Cell> cells;
  (void)holdsOnLine(frame, {0.5, 0.5}, {2.5, 2.5}, [&](const Cell& cell) {
    cells.push_back(cell);
    return true;
  });
  EXPECT_EQ(cells, (std::vector<Cell>{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 1}, {1, 2}, {2, 2}}));
}

TEST(CellsOnLine, EveryCellUnderTheLineIsTouchedInAllDirections) {
  const GridFrame frame{0.05};
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  for (int round = 0; round < 500; ++round) {
    const Point2 a{place(random), place(random)};
    const Point2 b{place(random), place(random)};
    std::vector<Cell> cells;
    (void)holdsOnLine(frame, a, b, [&](const Cell& cell) {
      cells.push_back(cell);
      return true;
    });
    EXPECT_EQ(cells.front(), frame.cellAt(a));
    EXPECT_EQ(cells.back(), frame.cellAt(b));
    for (int k = 0; k <= 200; ++k) {
      const Point2 at{a.x + k * (b.x - a.x) / 200.0, a.y + k * (b.y - a.y) / 200.0};
      EXPECT_NE(std::find(cells.begin(), cells.end(), frame.cellAt(at)), cells.end());
    }
  }
}

}  // namespace
}  // namespace occusg
