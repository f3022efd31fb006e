// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/geometry/grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "occusg/geometry/pose.hpp"

namespace occusg {
namespace {

TEST(CellBox, DefaultIsEmptyAndHoldsNothing) {
  EXPECT_TRUE(CellBox{}.empty());
  EXPECT_FALSE(CellBox{}.contains({0, 0}));
  EXPECT_EQ(CellBox{}.grown(3), CellBox{});
  EXPECT_EQ((CellBox{{2, 2}, {1, 5}}).width(), 0);
}

TEST(CellBox, MinIsInsideMaxIsNot) {
  const CellBox box{{-1, -2}, {3, 4}};
  EXPECT_TRUE(box.contains({-1, -2}));
  EXPECT_FALSE(box.contains({3, 3}));
  EXPECT_FALSE(box.contains({2, 4}));
  EXPECT_EQ(box.width(), 4);
  EXPECT_EQ(box.height(), 6);
}

TEST(CellBox, IncludingIgnoresEmptyBoxes) {
  const CellBox box{{1, 1}, {2, 2}};
  EXPECT_EQ(CellBox{}.including(box), box);
  EXPECT_EQ(box.including(CellBox{}), box);
  EXPECT_EQ(box.including(Cell{-3, 5}), (CellBox{{-3, 1}, {2, 6}}));
}

TEST(CellBox, IntersectionOfApartBoxesIsTheEmptyBox) {
  const CellBox box{{0, 0}, {4, 4}};
  EXPECT_EQ(box.intersected({{2, -1}, {9, 3}}), (CellBox{{2, 0}, {4, 3}}));
  EXPECT_EQ(box.intersected({{4, 0}, {9, 4}}), CellBox{});
}

TEST(GridFrame, CellsAreFlooredOnBothSidesOfZero) {
  const GridFrame frame{0.05};
  EXPECT_EQ(frame.cellAt({0.0, -0.001}), (Cell{0, -1}));
  EXPECT_EQ(frame.cellAt({-0.051, 0.049}), (Cell{-2, 0}));
  EXPECT_EQ(frame.cellAt(frame.center({-7, 11})), (Cell{-7, 11}));
  EXPECT_DOUBLE_EQ(frame.cellArea(), 0.0025);
}

TEST(Grid, ReadsOutsideAsTold) {
  Grid<int> grid({{-1, -1}, {1, 1}}, 5);
  grid.at({0, -1}) = 6;
  EXPECT_EQ(grid.valueOr({0, -1}, 9), 6);
  EXPECT_EQ(grid.valueOr({1, 0}, 9), 9);
  EXPECT_EQ(grid.values(), (std::vector<int>{5, 6, 5, 5}));
}

TEST(Grid, CoverKeepsValuesAndFillsTheRest) {
  Grid<int> grid({{0, 0}, {1, 1}}, 7);
  grid.cover({{-1, 0}, {0, 2}}, 1);
  EXPECT_EQ(grid.box(), (CellBox{{-1, 0}, {1, 2}}));
  EXPECT_EQ(grid.values(), (std::vector<int>{1, 7, 1, 1}));
  const Grid<int> before = grid;
  grid.cover({{0, 0}, {1, 1}}, 3);
  EXPECT_EQ(grid, before);
}

TEST(Pose, NanOrInfinityAnywhereIsNotFinite) {
  Pose pose = Pose::Identity();
  EXPECT_TRUE(isFinite(pose));
  pose.translation().y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(isFinite(pose));
  pose = Pose::Identity();
  pose.linear()(2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isFinite(pose));
}

}  // namespace
}  // namespace occusg
