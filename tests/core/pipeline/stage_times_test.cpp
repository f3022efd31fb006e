// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/stage_times.hpp"

#include <gtest/gtest.h>

namespace occusg {
namespace {

TEST(StageTimes, SummaryOfOneToHundredIsKnown) {
  std::vector<double> durations_ms;
  for (int i = 100; i >= 1; --i) durations_ms.push_back(i);
  const StageSummary summary = summarize(durations_ms);
  EXPECT_EQ(summary.count, 100U);
  EXPECT_DOUBLE_EQ(summary.mean_ms, 50.5);
  EXPECT_NEAR(summary.std_ms, 28.866, 1e-3);
  EXPECT_DOUBLE_EQ(summary.p50_ms, 50.0);
  EXPECT_DOUBLE_EQ(summary.p95_ms, 95.0);
  EXPECT_DOUBLE_EQ(summary.max_ms, 100.0);
}

TEST(StageTimes, StageThatNeverRanIsAllZero) {
  const StageSummary summary = StageTimes().summary(Stage::kGraph);
  EXPECT_EQ(summary.count, 0U);
  EXPECT_EQ(summary.mean_ms, 0.0);
  EXPECT_EQ(summary.p95_ms, 0.0);
}

TEST(StageTimes, TimedBooksOneSampleAndReturnsTheResult) {
  StageTimes times;
  EXPECT_EQ(timed(times, Stage::kTracking, [] { return 42; }), 42);
  EXPECT_EQ(times.summary(Stage::kTracking).count, 1U);
  EXPECT_EQ(times.summary(Stage::kGraph).count, 0U);
}

TEST(StageTimes, TimedPassesReferencesThrough) {
  StageTimes times;
  int value = 1;
  timed(times, Stage::kGraph, [&]() -> int& { return value; }) = 7;
  EXPECT_EQ(value, 7);
}

TEST(StageTimes, NamesAreTheKeysOfTimingJson) {
  std::string names;
  for (const Stage stage : kStages) names += nameOf(stage) + " ";
  EXPECT_EQ(names, "point_cloud occupancy free_space decomposition tracking graph total ");
}

TEST(StageTimes, MemoryIsKeptPerStage) {
  StageTimes times;
  times.setMemory(Stage::kOccupancy, 1234);
  EXPECT_EQ(times.memoryBytes(Stage::kOccupancy), 1234U);
  EXPECT_EQ(times.memoryBytes(Stage::kFreeSpace), 0U);
}

TEST(StageTimes, MergeAddsDurationsAndMemory) {
  StageTimes times;
  times.add(Stage::kGraph, 1.0);
  times.setMemory(Stage::kGraph, 10);
  StageTimes other;
  other.add(Stage::kGraph, 3.0);
  other.setMemory(Stage::kGraph, 5);
  times.merge(other);
  EXPECT_EQ(times.summary(Stage::kGraph).count, 2U);
  EXPECT_DOUBLE_EQ(times.summary(Stage::kGraph).mean_ms, 2.0);
  EXPECT_EQ(times.memoryBytes(Stage::kGraph), 15U);
}

TEST(StageTimes, OldDurationsGoSoThatDaysOfThemFit) {
  StageTimes times;
  for (std::size_t i = 0; i < kMaxKeptDurations; ++i) times.add(Stage::kGraph, 1.0);
  times.add(Stage::kGraph, 2.0);
  EXPECT_EQ(times.summary(Stage::kGraph).count, kMaxKeptDurations / 2 + 1);
  EXPECT_DOUBLE_EQ(times.summary(Stage::kGraph).max_ms, 2.0);
}

}  // namespace
}  // namespace occusg
