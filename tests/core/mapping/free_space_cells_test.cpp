// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/free_space_cells.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace occusg {
namespace {

TEST(FreeSpaceCells, ABoxThatGrowsMovesNoValue) {
  FreeSpaceCells cells(CellBox{{-3, -3}, {3, 3}}, kFree);
  const std::int8_t* const place = &cells.at({-3, 2});
  cells.cover(CellBox{{-5000, -5000}, {5000, 5000}});
  EXPECT_EQ(&cells.at({-3, 2}), place);
  EXPECT_EQ(*place, kFree);
}

TEST(FreeSpaceCells, CellsABoxGrowsByAreUnknownAndTakeNoMemory) {
  FreeSpaceCells cells(CellBox{{0, 0}, {2, 2}}, kFree);
  const std::size_t bytes = cells.memoryBytes();
  cells.cover(CellBox{{-5000, -5000}, {5000, 5000}});
  EXPECT_EQ(cells.box(), (CellBox{{-5000, -5000}, {5000, 5000}}));
  EXPECT_EQ(cells.size(), std::size_t{100'000'000});
  EXPECT_EQ(cells.valueOr({4999, -5000}, kFree), kUnknown);
  EXPECT_EQ(cells.valueOr({5000, -5000}, kFree), kFree);
  EXPECT_EQ(cells.memoryBytes(), bytes);
}

TEST(FreeSpaceCells, DenseHasTheSameValues) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto upTo = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const Cell corner{upTo(400) - 200, upTo(400) - 200};
    const CellBox box{corner, {corner.x + 1 + upTo(200), corner.y + 1 + upTo(200)}};
    Grid<std::int8_t> values(box, kUnknown);
    for (std::int8_t& value : values.values()) value = static_cast<std::int8_t>(upTo(102) - 1);
    const FreeSpaceCells cells(values);
    EXPECT_EQ(cells.dense(), values);
    const CellBox part{{box.min.x + box.width() / 3, box.min.y + box.height() / 2}, box.max};
    const Grid<std::int8_t> dense_part = cells.dense(part);
    ASSERT_EQ(dense_part.box(), part);
    for (int y = part.min.y; y < part.max.y; ++y)
      for (int x = part.min.x; x < part.max.x; ++x)
        ASSERT_EQ(dense_part.at({x, y}), values.at({x, y}));
  }
}

TEST(FreeSpaceCells, DifferingCellsAreTheirBoundsWhateverTheBoxes) {
  const FreeSpaceCells before(CellBox{{0, 0}, {200, 200}}, kFree);
  EXPECT_TRUE(before.differingFrom(before).empty());
  FreeSpaceCells after = before;
  after.at({3, 100}) = kFullObstacle;
  after.at({150, 70}) = kUnknown;
  after.cover(CellBox{{-100, -100}, {0, 0}});
  const CellBox differing{{3, 70}, {151, 101}};
  EXPECT_EQ(after.differingFrom(before), differing);
  EXPECT_EQ(before.differingFrom(after), differing);
  after.at({-100, -100}) = kFree;
  EXPECT_EQ(before.differingFrom(after), (CellBox{{-100, -100}, {151, 101}}));
}

TEST(FreeSpaceCells, AreEqualWhenBoxAndValuesAre) {
  const FreeSpaceCells a(CellBox{{0, 0}, {2, 2}}, kUnknown);
  FreeSpaceCells b;
  EXPECT_FALSE(a == b);
  b.cover(CellBox{{0, 0}, {2, 2}});
  EXPECT_TRUE(a == b);
  b.at({1, 1}) = kFree;
  EXPECT_FALSE(a == b);
}

}  // namespace
}  // namespace occusg
