// SPDX-License-Identifier: BSD-3-Clause
#include "regions/acceptance_guard.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "error_sentence.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;

/// `count` regions of equal area that together cover `area_m2`.
Decomposition totals(int count, double area_m2) {
  Decomposition decomposition;
  decomposition.regions.resize(count);
  for (Region& region : decomposition.regions) region.area_m2 = area_m2 / count;
  return decomposition;
}

AcceptanceGuardConfig paperConfig() {
  AcceptanceGuardConfig config;
  config.reject_on_count_alone = true;
  config.max_rejections_in_a_row = 0;
  return config;
}

TEST(AcceptanceGuard, AcceptsWhateverComesFirst) {
  EXPECT_TRUE(AcceptanceGuard({}).accept(totals(3, 50.0)));
  EXPECT_TRUE(AcceptanceGuard({}).accept(Decomposition{}));
}

TEST(AcceptanceGuard, AreaDropOf14Point9PercentIsAcceptedAnd15Point1Rejected) {
  AcceptanceGuard slight({});
  ASSERT_TRUE(slight.accept(totals(10, 100.0)));
  EXPECT_TRUE(slight.accept(totals(10, 85.1)));
  AcceptanceGuard exact({});
  ASSERT_TRUE(exact.accept(totals(7, 100.0)));
  EXPECT_TRUE(exact.accept(totals(7, 85.0)));
  AcceptanceGuard grave({});
  ASSERT_TRUE(grave.accept(totals(10, 100.0)));
  EXPECT_FALSE(grave.accept(totals(10, 84.9)));
}

TEST(AcceptanceGuard, CountDropRejectsAloneOnlyAsInThePaper) {
  AcceptanceGuard paper(paperConfig());
  ASSERT_TRUE(paper.accept(totals(1000, 100.0)));
  EXPECT_FALSE(paper.accept(totals(849, 100.0)));
  EXPECT_TRUE(paper.accept(totals(851, 100.0)));
  AcceptanceGuard ours({});
  ASSERT_TRUE(ours.accept(totals(5, 100.0)));
  EXPECT_TRUE(ours.accept(totals(4, 100.0)));  // Two rooms merged.
}

TEST(AcceptanceGuard, ComparesWithTheLastAcceptedNotTheLastSeen) {
  AcceptanceGuard guard({});
  ASSERT_TRUE(guard.accept(totals(4, 100.0)));
  EXPECT_FALSE(guard.accept(totals(4, 50.0)));
  EXPECT_FALSE(guard.accept(totals(4, 60.0)));
  EXPECT_TRUE(guard.accept(totals(4, 90.0)));
  EXPECT_TRUE(guard.accept(totals(4, 80.0)));
  EXPECT_EQ(guard.rejections(), 2U);
}

TEST(AcceptanceGuard, GivesInAfterSoManyRejectionsInARow) {
  AcceptanceGuardConfig config;
  config.max_rejections_in_a_row = 3;
  AcceptanceGuard guard(config);
  ASSERT_TRUE(guard.accept(totals(4, 100.0)));
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(guard.accept(totals(2, 50.0)));
  EXPECT_TRUE(guard.accept(totals(2, 50.0)));
  EXPECT_TRUE(guard.accept(totals(2, 50.0)));
  EXPECT_FALSE(guard.accept(totals(1, 20.0)));  // Patience is new after an acceptance.
}

TEST(AcceptanceGuard, NeverGivesInAsInThePaper) {
  AcceptanceGuard guard(paperConfig());
  ASSERT_TRUE(guard.accept(totals(4, 100.0)));
  for (int i = 0; i < 100; ++i) ASSERT_FALSE(guard.accept(Decomposition{}));
  EXPECT_EQ(guard.rejections(), 100U);
}

TEST(AcceptanceGuard, ResetForgetsWhatWasAccepted) {
  AcceptanceGuard guard({});
  ASSERT_TRUE(guard.accept(totals(4, 100.0)));
  ASSERT_FALSE(guard.accept(totals(4, 10.0)));
  guard.reset();
  EXPECT_TRUE(guard.accept(totals(4, 10.0)));
  EXPECT_EQ(guard.rejections(), 0U);
}

TEST(AcceptanceGuard, RefusesParametersOutOfRange) {
  AcceptanceGuardConfig config;
  config.max_area_drop = 1.5;
  EXPECT_TRUE(tells(sentenceOf([&] { AcceptanceGuard guard(config); }),
                    {"regions.guard.max_area_drop", "1.5", "allowed is [0, 1]"}));
  config = {};
  config.max_count_drop = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(tells(sentenceOf([&] { AcceptanceGuard guard(config); }),
                    {"regions.guard.max_count_drop", "nan"}));
  config = {};
  config.max_rejections_in_a_row = -1;
  EXPECT_TRUE(tells(sentenceOf([&] { AcceptanceGuard guard(config); }),
                    {"regions.guard.max_rejections_in_a_row", "-1"}));
}

}  // namespace
}  // namespace occusg
