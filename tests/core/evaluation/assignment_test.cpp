// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>

#include "occusg/error.hpp"

namespace occusg {
namespace {

using Matrix = std::vector<std::vector<double>>;

double sumOf(const Matrix& weights, const std::vector<int>& columns) {
  double sum = 0.0;
  for (std::size_t row = 0; row < columns.size(); ++row)
    if (columns[row] >= 0) sum += weights[row][static_cast<std::size_t>(columns[row])];
  return sum;
}

/// Largest sum over all assignments of as many rows as possible.
double bestSum(const Matrix& weights, std::size_t row, std::set<std::size_t>& taken,
               std::size_t skips_left) {
  if (row == weights.size()) return 0.0;
  double best = -std::numeric_limits<double>::infinity();
  if (skips_left > 0) best = bestSum(weights, row + 1, taken, skips_left - 1);
  for (std::size_t column = 0; column < weights[row].size(); ++column) {
    if (!taken.insert(column).second) continue;
    best = std::max(best, weights[row][column] + bestSum(weights, row + 1, taken, skips_left));
    taken.erase(column);
  }
  return best;
}

TEST(Assignment, NothingToAssign) {
  EXPECT_TRUE(maxSumAssignment({}).empty());
  EXPECT_EQ(maxSumAssignment({{}, {}}), (std::vector<int>{-1, -1}));
}

TEST(Assignment, BestSumBeatsBestPair) {
  EXPECT_EQ(maxSumAssignment({{0.9, 0.8}, {0.7, 0.0}}), (std::vector<int>{1, 0}));
}

TEST(Assignment, SurplusRowsGetNone) {
  EXPECT_EQ(maxSumAssignment({{0.2}, {0.9}, {0.5}}), (std::vector<int>{-1, 0, -1}));
  EXPECT_EQ(maxSumAssignment({{0.2, 0.9, 0.5}}), (std::vector<int>{1}));
}

TEST(Assignment, EqualWeightsGiveTheSameAnswerEveryTime) {
  const Matrix equal(4, std::vector<double>(4, 0.5));
  const auto first = maxSumAssignment(equal);
  EXPECT_EQ(maxSumAssignment(equal), first);
  EXPECT_EQ(std::set<int>(first.begin(), first.end()), (std::set<int>{0, 1, 2, 3}));
}

TEST(Assignment, RefusesRaggedRowsAndValuesThatAreNotFinite) {
  EXPECT_THROW((void)maxSumAssignment({{1.0, 2.0}, {1.0}}), Error);
  EXPECT_THROW((void)maxSumAssignment({{std::nan("")}}), Error);
  EXPECT_THROW((void)maxSumAssignment({{std::numeric_limits<double>::infinity()}}), Error);
}

TEST(Assignment, AgreesWithTryingEverything) {
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 engine(seed);
    const std::size_t rows = 1 + engine() % 6;
    const std::size_t columns = 1 + engine() % 6;
    Matrix weights(rows, std::vector<double>(columns));
    // Every third matrix has few values, so many ties, and some are negative.
    const std::uint32_t range = seed % 3 == 0 ? 3 : 1000;
    for (auto& row : weights)
      for (double& weight : row)
        weight = static_cast<double>(engine() % range) - (seed % 2 == 0 ? 0.0 : range / 2.0);
    const auto columns_of = maxSumAssignment(weights);
    ASSERT_EQ(columns_of.size(), rows);
    std::set<int> used;
    for (const int column : columns_of) {
      if (column < 0) continue;
      EXPECT_TRUE(used.insert(column).second) << "column twice";
    }
    EXPECT_EQ(used.size(), std::min(rows, columns));
    std::set<std::size_t> taken;
    EXPECT_DOUBLE_EQ(sumOf(weights, columns_of),
                     bestSum(weights, 0, taken, rows - std::min(rows, columns)));
  }
}

}  // namespace
}  // namespace occusg
