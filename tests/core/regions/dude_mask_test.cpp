// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "drawn_grid.hpp"

namespace occusg {
namespace {

using testing::drawn;
using testing::fill;
using testing::solid;

std::int64_t setCells(const Grid<std::uint8_t>& grid) {
  return std::count_if(grid.values().begin(), grid.values().end(), [](auto v) { return v != 0; });
}

CellBox boundsOfSet(const Grid<std::uint8_t>& grid) {
  CellBox bounds;
  for (int y = grid.box().min.y; y < grid.box().max.y; ++y)
    for (int x = grid.box().min.x; x < grid.box().max.x; ++x)
      if (grid.at({x, y}) != 0) bounds = bounds.including(Cell{x, y});
  return bounds;
}

DudeMask maskOf(const FreeSpace& layer, double max_hole_cells) {
  return dudeMask(cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kNone),
                  max_hole_cells, [](const Cell& /*cell*/) { return true; });
}

TEST(GridCleaning, NoneTakesFreeCellsOnly) {
  const FreeSpace layer = drawn({".1# ."});
  EXPECT_EQ(cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kNone).values(),
            (std::vector<std::uint8_t>{1, 0, 0, 0, 1}));
}

TEST(GridCleaning, PublishedObstacleCellBlocksTenByTen) {
  FreeSpace layer = solid(2.0, 2.0);
  fill(layer, 0.0, 0.0, 2.0, 2.0);
  layer.cells.at({20, 20}) = kFullObstacle;
  Grid<std::uint8_t> cleaned =
      cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kPublished);
  for (std::uint8_t& value : cleaned.values()) value = value == 0 ? 1 : 0;
  EXPECT_EQ(boundsOfSet(cleaned), (CellBox{{16, 16}, {26, 26}}));
  EXPECT_EQ(setCells(cleaned), 100);
}

TEST(GridCleaning, PublishedFreeCellOpensTwelveByTwelve) {
  FreeSpace layer = solid(2.0, 2.0);
  fill(layer, 0.0, 0.0, 2.0, 2.0, kUnknown);
  layer.cells.at({20, 20}) = kFree;
  const Grid<std::uint8_t> cleaned =
      cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kPublished);
  EXPECT_EQ(boundsOfSet(cleaned), (CellBox{{15, 15}, {27, 27}}));
  EXPECT_EQ(setCells(cleaned), 144);
}

TEST(GridCleaning, PublishedInsetsRoomsWithHardWallsByAQuarterMetre) {
  FreeSpace layer = solid(5.0, 5.0);
  fill(layer, 1.0, 1.0, 4.0, 4.0);
  const CellBox bounds =
      boundsOfSet(cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kPublished));
  EXPECT_EQ(bounds.width(), 51);  // 60 cells less 5 on one side and 4 on the other.
  EXPECT_EQ(bounds.height(), 51);
}

TEST(GridCleaning, PublishedDissolvesWeakWalls) {
  FreeSpace layer = solid(6.0, 3.0);
  fill(layer, 0.0, 0.0, 6.0, 3.0);
  fill(layer, 3.0, 0.0, 3.2, 3.0, 90);
  EXPECT_EQ(setCells(cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kPublished)),
            120 * 60);
}

TEST(GridCleaning, BoxOfThePublishedMaskDoesNotDependOnWhereItIsCut) {
  FreeSpace layer = solid(3.0, 3.0);
  fill(layer, 0.5, 0.5, 2.0, 2.5);
  const CellBox part{{20, 15}, {50, 40}};
  const auto whole = cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kPublished);
  const auto cut = cleanedFreeSpace(layer.cells, part, GridCleaning::kPublished);
  for (int y = part.min.y; y < part.max.y; ++y)
    for (int x = part.min.x; x < part.max.x; ++x)
      ASSERT_EQ(cut.at({x, y}), whole.at({x, y})) << x << ' ' << y;
}

TEST(DudeMask, FurnitureIsFilledAndRemembered) {
  const DudeMask mask = maskOf(drawn({".....", ".##..", "....."}), 2.5);
  EXPECT_EQ(setCells(mask.cells), 15);
  ASSERT_EQ(mask.ignored_holes.size(), 1U);
  ASSERT_EQ(mask.outlines.size(), 1U);
  EXPECT_TRUE(mask.outlines.front().holes.empty());
}

TEST(DudeMask, LongHolesStay) {
  const DudeMask mask = maskOf(drawn({".....", ".###.", "....."}), 2.5);
  EXPECT_EQ(setCells(mask.cells), 12);
  EXPECT_EQ(mask.outlines.front().holes.size(), 1U);
}

TEST(DudeMask, FreeSpaceInsideFurnitureIsNoComponent) {
  const DudeMask mask = maskOf(drawn({".....", ".###.", ".#.#.", ".###.", "....."}), 5.0);
  EXPECT_EQ(setCells(mask.cells), 25);
  EXPECT_EQ(mask.outlines.size(), 1U);
  EXPECT_EQ(maskOf(drawn({".....", ".###.", ".#.#.", ".###.", "....."}), 4.0).outlines.size(), 2U);
}

TEST(DudeMask, HoleThatMayNotBeFilledStays) {
  const FreeSpace layer = drawn({".....", ".##..", "....."});
  const DudeMask mask =
      dudeMask(cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kNone), 2.5,
               [](const Cell& cell) { return cell.x != 2; });
  EXPECT_EQ(setCells(mask.cells), 13);
}

}  // namespace
}  // namespace occusg
