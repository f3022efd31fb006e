// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/geometry/tiled_grid.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

namespace occusg {
namespace {

TEST(TiledGrid, CellsNeverTouchedHaveTheFillAndTakeNoMemory) {
  TiledGrid<int> grid(7);
  EXPECT_TRUE(grid.empty());
  EXPECT_EQ(grid.at({0, 0}), 7);
  EXPECT_EQ(grid.at({-1000000, 5}), 7);
  EXPECT_EQ(grid.memoryBytes(), 0U);
  grid.touch({-1, 0}) = 3;
  EXPECT_EQ(grid.at({-1, 0}), 3);
  EXPECT_EQ(grid.at({-2, 0}), 7);
  EXPECT_EQ(grid.at({0, 0}), 7);
}

TEST(TiledGrid, KeepsValuesWhileItGrowsInEveryDirection) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> place(-500, 500);
    TiledGrid<int> grid(0);
    std::map<Cell, int> expected;
    for (int i = 1; i <= 500; ++i) {
      const Cell cell{place(random), place(random)};
      grid.touch(cell) = i;
      expected[cell] = i;
    }
    for (const auto& [cell, value] : expected) ASSERT_EQ(grid.at(cell), value);
  }
}

TEST(TiledGrid, MemoryFollowsTheTouchedTilesNotTheirBounds) {
  TiledGrid<int> grid(0);
  grid.touch({0, 0}) = 1;
  const std::size_t one = grid.memoryBytes();
  grid.touch({kTileSide_cells - 1, kTileSide_cells - 1}) = 1;
  EXPECT_EQ(grid.memoryBytes(), one);
  grid.touch({64 * kTileSide_cells, 0}) = 1;
  EXPECT_LT(grid.memoryBytes(), 3 * one);
}

TEST(TiledGrid, EqualsAGridWithTheSameValuesWhateverWasTouched) {
  TiledGrid<int> a(0);
  TiledGrid<int> b(0);
  a.touch({-70, 3}) = 5;
  EXPECT_FALSE(a == b);
  EXPECT_FALSE(b == a);
  b.touch({200, 200}) = 0;
  b.touch({-70, 3}) = 5;
  EXPECT_TRUE(a == b);
  EXPECT_TRUE(b == a);
  b.touch({200, 200}) = 1;
  EXPECT_FALSE(a == b);
  EXPECT_FALSE(TiledGrid<int>(0) == TiledGrid<int>(1));
}

}  // namespace
}  // namespace occusg
