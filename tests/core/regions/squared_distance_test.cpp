// SPDX-License-Identifier: BSD-3-Clause
#include "regions/squared_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "drawn_grid.hpp"
#include "occusg/regions/constriction_decomposer.hpp"

namespace occusg {
namespace {

using testing::fill;
using testing::solid;

/// By looking at every closed cell, and at the ring around the grid.
std::int32_t nearestClosed(const Grid<std::uint8_t>& open, const Cell& from) {
  std::int32_t nearest = std::numeric_limits<std::int32_t>::max();
  const CellBox around = open.box().grown(1);
  for (int y = around.min.y; y < around.max.y; ++y)
    for (int x = around.min.x; x < around.max.x; ++x)
      if (open.valueOr({x, y}, 0) == 0)
        nearest = std::min(nearest, (x - from.x) * (x - from.x) + (y - from.y) * (y - from.y));
  return nearest;
}

TEST(SquaredDistance, EqualsTheNearestOfAllClosedCells) {
  constexpr unsigned kSeed = 20261126;
  std::mt19937 random(kSeed);
  for (int round = 0; round < 200; ++round) {
    const int width = std::uniform_int_distribution<>(1, 24)(random);
    const int height = std::uniform_int_distribution<>(1, 24)(random);
    Grid<std::uint8_t> open(CellBox{{-5, 7}, {-5 + width, 7 + height}}, 1);
    std::bernoulli_distribution closed(std::uniform_real_distribution<>(0.0, 0.3)(random));
    for (std::uint8_t& cell : open.values()) cell = closed(random) ? 0 : 1;
    const Grid<std::int32_t> squared = squaredDistances(open);
    ASSERT_EQ(squared.box(), open.box());
    for (int y = open.box().min.y; y < open.box().max.y; ++y)
      for (int x = open.box().min.x; x < open.box().max.x; ++x)
        ASSERT_EQ(squared.at({x, y}), nearestClosed(open, {x, y}))
            << "seed " << kSeed << ", round " << round << ", cell " << x << ' ' << y;
  }
}

TEST(SquaredDistance, IsExactBeyondTenThousandColumnsAndRows) {
  constexpr int kLength = 12000;
  constexpr int kWidth = 41;
  const Grid<std::int32_t> wide =
      squaredDistances(Grid<std::uint8_t>(CellBox{{0, 0}, {kLength, kWidth}}, 1));
  const Grid<std::int32_t> tall =
      squaredDistances(Grid<std::uint8_t>(CellBox{{0, 0}, {kWidth, kLength}}, 1));
  for (const int along : {0, 19, 20, 6000, 11979, 11980, 11999}) {
    for (int across = 0; across < kWidth; ++across) {
      const int nearest = std::min({along + 1, kLength - along, across + 1, kWidth - across});
      EXPECT_EQ(wide.at({along, across}), nearest * nearest);
      EXPECT_EQ(tall.at({across, along}), nearest * nearest);
    }
  }
}

/// Rooms of 7.8 by 4.6 m in a row, with walls of 0.2 m and a door of 0.9 m between them.
FreeSpace rowOfRooms(int count, bool transposed) {
  constexpr double kPitch_m = 8.0;
  constexpr double kDepth_m = 5.0;
  FreeSpace layer =
      transposed ? solid(kDepth_m, count * kPitch_m) : solid(count * kPitch_m, kDepth_m);
  const auto free = [&](double along0, double across0, double along1, double across1) {
    if (transposed) {
      fill(layer, across0, along0, across1, along1);
    } else {
      fill(layer, along0, across0, along1, across1);
    }
  };
  for (int room = 0; room < count; ++room) {
    const double start = room * kPitch_m;
    free(start + 0.2, 0.2, start + kPitch_m, kDepth_m - 0.2);
    if (room > 0) free(start, 2.0, start + 0.2, 2.9);
  }
  return layer;
}

TEST(ConstrictionDecomposer, SeventyRoomsInARowOfElevenThousandCellsAreSeventyRegionsEitherWay) {
  for (const bool transposed : {false, true}) {
    ConstrictionDecomposer decomposer{ConstrictionDecomposerConfig{}};
    EXPECT_EQ(decomposer.update(rowOfRooms(70, transposed)).regions.size(), 70U);
  }
}

}  // namespace
}  // namespace occusg
