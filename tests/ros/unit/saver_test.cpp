// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/saver.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <string>
#include <vector>

namespace occusg_ros {
namespace {

TEST(Saver, FailureMode15NextIsDueOnePeriodLater) {
  Saver saver(30.0, 100.0, [](const std::string&) {});
  EXPECT_FALSE(saver.isDue(129.0));
  EXPECT_TRUE(saver.isDue(130.0));
  saver.write([] {});
  EXPECT_TRUE(saver.isDue(130.0)) << "what was asked for elsewhere changes nothing";
}

TEST(Saver, FailureMode15PeriodOfZeroIsNever) {
  const Saver saver(0.0, 0.0, [](const std::string&) {});
  EXPECT_FALSE(saver.isDue(1e9));
}

TEST(Saver, FailureMode15SlowDiskKeepsNobodyWaitingAndNothingPilesUp) {
  std::promise<void> disk;
  std::promise<std::string> reported;
  Saver saver(1.0, 0.0, [&](const std::string& problem) { reported.set_value(problem); });
  saver.writeInBackground(10.0, [written = disk.get_future().share()] { written.wait(); });
  EXPECT_FALSE(saver.isDue(20.0)) << "the first is still being written";
  disk.set_value();
  EXPECT_EQ(reported.get_future().get(), "");
}

TEST(Saver, FailureMode16WhatGoesWrongIsReported) {
  std::vector<std::string> problems;
  {
    Saver saver(1.0, 0.0, [&](const std::string& problem) { problems.push_back(problem); });
    saver.writeInBackground(10.0, [] { throw std::runtime_error("the disk is full"); });
  }
  EXPECT_EQ(problems, std::vector<std::string>{"the disk is full"});
}

TEST(Saver, FailureMode20EndWaitsForWhatIsBeingWritten) {
  std::atomic<bool> written{false};
  {
    Saver saver(1.0, 0.0, [](const std::string&) {});
    std::promise<void> begun;
    saver.writeInBackground(10.0, [&] {
      begun.set_value();
      written = true;
    });
    begun.get_future().wait();
  }
  EXPECT_TRUE(written);
}

}  // namespace
}  // namespace occusg_ros
