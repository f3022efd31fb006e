// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/local_floor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace occusg {
namespace {

constexpr int kStorey_voxels = 44;
constexpr int kReach_tiles = 2;

LocalFloor noFloors() { return {kStorey_voxels, kReach_tiles}; }

/// All columns of one tile show a floor at the same height.
void setTile(LocalFloor& floors, const Cell& tile, std::int16_t height) {
  for (int i = 0; i < kFloorTile_cells * kFloorTile_cells; ++i)
    floors.set({kFloorTile_cells * tile.x + i % kFloorTile_cells,
                kFloorTile_cells * tile.y + i / kFloorTile_cells},
               height);
}

std::int16_t floorOfTile(const LocalFloor& floors, const Cell& tile) {
  return floors.at({kFloorTile_cells * tile.x, kFloorTile_cells * tile.y});
}

TEST(LocalFloor, NeedsColumnsThatAgree) {
  LocalFloor floors = noFloors();
  for (std::int16_t i = 0; i < kFloorColumns - 1; ++i) floors.set({i, 0}, 3);
  (void)floors.update();
  EXPECT_EQ(floors.at({0, 0}), kNoFloor);
  floors.set({0, 1}, 9);
  (void)floors.update();
  EXPECT_EQ(floors.at({0, 0}), kNoFloor);
  floors.set({0, 1}, 2);  // a voxel of noise is allowed for
  (void)floors.update();
  EXPECT_EQ(floors.at({0, 0}), 3);
}

TEST(LocalFloor, IsKnownAsFarAsItReaches) {
  LocalFloor floors = noFloors();
  setTile(floors, {-3, 4}, -20);
  EXPECT_EQ(floors.update().size(), 25U);
  EXPECT_EQ(floorOfTile(floors, {-1, 6}), -20);
  EXPECT_EQ(floorOfTile(floors, {-5, 2}), -20);
  EXPECT_EQ(floorOfTile(floors, {0, 4}), kNoFloor);
}

TEST(LocalFloor, TableStandsOnTheFloorBesideIt) {
  LocalFloor floors = noFloors();
  setTile(floors, {0, 0}, 15);
  (void)floors.update();
  EXPECT_EQ(floorOfTile(floors, {0, 0}), 15);  // no floor seen yet
  setTile(floors, {2, 0}, 0);
  (void)floors.update();
  EXPECT_EQ(floorOfTile(floors, {0, 0}), 0);
}

TEST(LocalFloor, StairwellDoesNotPullDownTheFloorBesideIt) {
  LocalFloor floors = noFloors();
  setTile(floors, {0, 0}, 0);
  setTile(floors, {1, 0}, -54);
  (void)floors.update();
  EXPECT_EQ(floorOfTile(floors, {0, 0}), 0);
  EXPECT_EQ(floorOfTile(floors, {1, 0}), -54);
  EXPECT_EQ(floorOfTile(floors, {0, 1}), 0);  // a wall between both
}

TEST(LocalFloor, UpdateNamesTheTilesWhoseFloorMovedAndNoOthers) {
  LocalFloor floors = noFloors();
  setTile(floors, {0, 0}, 5);
  (void)floors.update();
  EXPECT_TRUE(floors.update().empty());
  setTile(floors, {0, 0}, 5);
  EXPECT_TRUE(floors.update().empty());
  setTile(floors, {4, 0}, 3);
  std::vector<Cell> moved = floors.update();
  EXPECT_EQ(moved.size(), 25U);
  EXPECT_EQ(floorOfTile(floors, {2, 0}), 3);
  EXPECT_EQ(floorOfTile(floors, {1, 0}), 5);
  setTile(floors, {4, 0}, kNoFloor);
  EXPECT_EQ(floors.update().size(), 25U);
  EXPECT_EQ(floorOfTile(floors, {2, 0}), 5);
  EXPECT_EQ(floorOfTile(floors, {4, 0}), kNoFloor);
}

TEST(LocalFloor, DoesNotDependOnTheOrderInWhichColumnsCame) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> cell(-40, 40);
    std::uniform_int_distribution<int> height(0, 3);
    LocalFloor step_by_step = noFloors();
    std::vector<std::pair<Cell, std::int16_t>> last;
    for (int y = -40; y < 40; ++y)
      for (int x = -40; x < 40; ++x)
        last.emplace_back(Cell{x, y}, static_cast<std::int16_t>(30 * height(random)));
    for (int i = 0; i < 3000; ++i) {
      step_by_step.set({cell(random), cell(random)},
                       static_cast<std::int16_t>(30 * height(random)));
      if (i % 100 == 0) (void)step_by_step.update();
    }
    for (int y = 40; y <= 40; ++y)
      for (int x = -40; x <= 40; ++x) step_by_step.set({x, y}, kNoFloor);
    for (int y = -40; y <= 40; ++y) step_by_step.set({40, y}, kNoFloor);
    std::shuffle(last.begin(), last.end(), random);
    for (const auto& [column, floor] : last) step_by_step.set(column, floor);
    (void)step_by_step.update();

    LocalFloor at_once = noFloors();
    for (const auto& [column, floor] : last) at_once.set(column, floor);
    (void)at_once.update();
    for (int y = -80; y < 80; y += 8)
      for (int x = -80; x < 80; x += 8)
        ASSERT_EQ(step_by_step.at({x, y}), at_once.at({x, y})) << x << ", " << y;
  }
}

}  // namespace
}  // namespace occusg
