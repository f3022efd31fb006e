// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/occupancy_thresholds.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "occusg/mapping/free_space_cells.hpp"

namespace occusg {
namespace {

TEST(OccupancyThresholds, MapOfFreeAndOccupiedCellsIsDecided) {
  OccupancyHistogram counts{};
  EXPECT_EQ(occupancyKind(counts), OccupancyKind::kDecided);
  counts[0] = 800;
  counts[100] = 100;
  counts[40] = 50;
  EXPECT_EQ(occupancyKind(counts), OccupancyKind::kDecided);
}

TEST(OccupancyThresholds, CellsMostlyBetweenAreProbabilities) {
  OccupancyHistogram counts{};
  for (std::size_t percent = 5; percent < 40; ++percent) counts[percent] = 20;
  for (std::size_t percent = 60; percent < 95; ++percent) counts[percent] = 2;
  EXPECT_EQ(occupancyKind(counts), OccupancyKind::kProbability);
  EXPECT_DOUBLE_EQ(shareBetween(counts), 1.0);
}

TEST(OccupancyThresholds, OneValueBetweenIsNoProbability) {
  OccupancyHistogram counts{};
  counts[50] = 900;
  counts[0] = 100;
  EXPECT_EQ(occupancyKind(counts), OccupancyKind::kDecided);
}

TEST(OccupancyThresholds, CellsAreFreeBelowAndOccupiedAbove) {
  const OccupancyThresholds thresholds{35.0, 65.0};
  EXPECT_EQ(decidedCell(34.0, thresholds), kFree);
  EXPECT_EQ(decidedCell(35.0, thresholds), kUnknown);
  EXPECT_EQ(decidedCell(65.0, thresholds), kUnknown);
  EXPECT_EQ(decidedCell(66.0, thresholds), kFullObstacle);
  EXPECT_EQ(decidedCell(-1.0, thresholds), kUnknown);
  EXPECT_EQ(decidedCell(std::numeric_limits<double>::quiet_NaN(), thresholds), kUnknown);
}

}  // namespace
}  // namespace occusg
