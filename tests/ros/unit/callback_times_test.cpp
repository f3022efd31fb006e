// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/callback_times.hpp"

#include <gtest/gtest.h>

namespace occusg_ros {
namespace {

TEST(CallbackTimes, TheLongestIsKeptWithItsName) {
  CallbackTimes times;
  EXPECT_EQ(times.longest().duration_ms, 0.0);
  times.add("image", 2.0);
  times.add("tick", 7.0);
  times.add("image", 3.0);
  EXPECT_EQ(times.longest().duration_ms, 7.0);
  EXPECT_EQ(times.longest().callback, "tick");
}

TEST(CallbackTimes, ATimingCountsWhenItEnds) {
  CallbackTimes times;
  {
    const CallbackTimes::Timing timing(times, "image");
    EXPECT_EQ(times.longest().callback, "");
  }
  EXPECT_EQ(times.longest().callback, "image");
}

}  // namespace
}  // namespace occusg_ros
