// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/shown_text.hpp"

#include <gtest/gtest.h>
#include <tf2/buffer_core.h>

#include "occusg_ros/clock_state.hpp"
#include "occusg_ros/input_health.hpp"
#include "occusg_ros/tf_poses.hpp"

namespace occusg_ros {
namespace {

TEST(ShownText, FailureMode18MegabytesOfANameAreCutAndControlCharactersReplaced) {
  EXPECT_EQ(shownText("map"), "map");
  EXPECT_EQ(shownText("a\n\x1b[2Jb"), "a??[2Jb");
  const std::string shown = shownText(std::string(10'000'000, 'x'));
  EXPECT_LT(shown.size(), 500U);
  EXPECT_NE(shown.find("10000000 bytes"), std::string::npos);
}

TEST(ShownText, FailureMode18AFrameOfMegabytesLeavesAShortSentence) {
  const tf2::BufferCore tf;
  const PoseAnswer answer = poseAt(tf, "map", std::string(10'000'000, 'f'), ros::Time(1.0));
  EXPECT_EQ(answer.kind, PoseAnswer::Kind::kUnusable);
  EXPECT_LT(answer.problem.size(), 300U);
  InputHealth health;
  health.noteDropped(Drop::kImage, std::string(10'000'000, 'e'));
  EXPECT_LT(health.counts().last_problem.size(), 500U);
}

TEST(ClockState, SimulatedTimeThatStandsStillIsAProblem) {
  ClockState clock;
  clock.note(true, 0.0, 100.0);
  EXPECT_NE(clock.problem().find("no /clock comes"), std::string::npos);
  clock.note(true, 50.0, 101.0);
  EXPECT_EQ(clock.problem(), "");
  clock.note(true, 50.0, 105.0);
  EXPECT_EQ(clock.problem(), "");
  clock.note(true, 50.0, 113.0);
  EXPECT_NE(clock.problem().find("has not moved for 12 s"), std::string::npos);
  clock.note(true, 50.1, 114.0);
  EXPECT_EQ(clock.problem(), "");
}

TEST(ClockState, TheClockOfTheWallIsNeverAProblem) {
  ClockState clock;
  clock.note(false, 50.0, 100.0);
  clock.note(false, 50.0, 200.0);
  EXPECT_EQ(clock.problem(), "");
}

}  // namespace
}  // namespace occusg_ros
