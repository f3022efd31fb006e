// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_holes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace occusg {
namespace {

/// Holes run clockwise.
const CornerRing kThinWall{{0, 0}, {0, 1}, {12, 1}, {12, 0}};
const CornerRing kL{{0, 0}, {0, 6}, {2, 6}, {2, 2}, {6, 2}, {6, 0}};

TEST(DudeHoles, DiameterAndWidthOfAThinWall) {
  const DudeHole hole = holeShape(kThinWall);
  EXPECT_DOUBLE_EQ(hole.diameter_cells, std::sqrt(145.0));
  EXPECT_NEAR(hole.width_cells, 2.0 * 12.0 / std::sqrt(145.0), 1e-9);
  EXPECT_EQ(hole.area_cells, 12);
}

TEST(DudeHoles, AreaOfANonConvexHole) { EXPECT_EQ(holeShape(kL).area_cells, 20); }

TEST(DudeHoles, EndsOfAWallAreAsDeepAsItIsLong) {
  for (const double depth : holeDepths(kThinWall)) EXPECT_DOUBLE_EQ(depth, std::sqrt(145.0));
}

TEST(DudeHoles, InnerCornerIsLessDeepThanTheEnds) {
  const std::vector<double> depths = holeDepths(kL);
  EXPECT_DOUBLE_EQ(depths[3], std::sqrt(20.0));
  EXPECT_DOUBLE_EQ(depths[1], std::sqrt(72.0));
}

TEST(DudeHoles, RingEnclosesItsCellsOnly) {
  std::vector<Cell> cells;
  visitRing(kL, [&](const Cell& cell) { cells.push_back(cell); });
  ASSERT_EQ(cells.size(), 20U);
  EXPECT_EQ(cells.front(), (Cell{0, 0}));
  EXPECT_EQ(cells.back(), (Cell{1, 5}));
}

TEST(DudeHoles, SignedCellsTellTheDirection) {
  EXPECT_EQ(signedCells(kL), -20);
  EXPECT_EQ(signedCells({kL.rbegin(), kL.rend()}), 20);
}

}  // namespace
}  // namespace occusg
