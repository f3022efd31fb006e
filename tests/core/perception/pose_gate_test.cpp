// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/pose_gate.hpp"

#include <gtest/gtest.h>

#include "error_sentence.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;

Pose poseAt(double x) {
  Pose pose = Pose::Identity();
  pose.translation().x() = x;
  return pose;
}

/// As a user who uses every pose that is believed.
bool accepts(PoseGate& gate, double x, double stamp_s) {
  const bool believed = gate.believes(poseAt(x), stamp_s);
  if (believed) gate.used();
  return believed;
}

TEST(PoseGate, PoseThatIsBelievedButNotUsedIsNoPlaceToComeFrom) {
  PoseGate gate(PoseGateConfig{});
  EXPECT_TRUE(accepts(gate, 0.0, 0.0));
  EXPECT_FALSE(gate.believes(poseAt(900.0), 0.1));
  EXPECT_TRUE(gate.believes(poseAt(900.0), 0.2));
  EXPECT_TRUE(accepts(gate, 0.1, 0.3));
}

TEST(PoseGate, RobotThatDrivesIsBelieved) {
  PoseGate gate(PoseGateConfig{});
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(accepts(gate, 0.2 * i, 0.1 * i));
}

TEST(PoseGate, CorrectionOfALocalisationIsBelieved) {
  PoseGate gate(PoseGateConfig{});
  EXPECT_TRUE(accepts(gate, 0.0, 0.0));
  EXPECT_TRUE(accepts(gate, 0.9, 0.001));
}

TEST(PoseGate, OnePoseThatJumpedIsRefusedAndNoneAfterIt) {
  PoseGate gate(PoseGateConfig{});
  EXPECT_TRUE(accepts(gate, 0.0, 0.0));
  EXPECT_FALSE(accepts(gate, 900.0, 0.1));
  EXPECT_TRUE(accepts(gate, 0.1, 0.2));
  EXPECT_TRUE(accepts(gate, 0.2, 0.3));
}

TEST(PoseGate, RobotFoundSomewhereElseIsBelievedFromTheSecondPoseOn) {
  PoseGate gate(PoseGateConfig{});
  EXPECT_TRUE(accepts(gate, 0.0, 0.0));
  EXPECT_FALSE(accepts(gate, 50.0, 0.1));
  EXPECT_TRUE(accepts(gate, 50.1, 0.2));
}

TEST(PoseGate, WayThatTookLongIsBelieved) {
  PoseGate gate(PoseGateConfig{});
  EXPECT_TRUE(accepts(gate, 0.0, 0.0));
  EXPECT_TRUE(accepts(gate, 900.0, 60.0));
}

TEST(PoseGate, StampsThatGoBackGiveASecond) {
  PoseGate gate(PoseGateConfig{});
  EXPECT_TRUE(accepts(gate, 0.0, 100.0));
  EXPECT_TRUE(accepts(gate, 15.0, 0.0));
  EXPECT_FALSE(accepts(gate, 100.0, 0.0));
}

TEST(PoseGate, SpeedThatIsNoneIsRefused) {
  EXPECT_TRUE(tells(sentenceOf([] { PoseGate gate(PoseGateConfig{0.0}); }),
                    {"perception.poses.max_speed_m_s", "allowed"}));
}

}  // namespace
}  // namespace occusg
