// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/save_status.hpp"

#include <gtest/gtest.h>

namespace occusg_ros {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;

diagnostic_updater::DiagnosticStatusWrapper described(const SaveStatus& saves, double now_s) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  status.summary(Level::OK, "2 rooms");
  saves.describe(status, now_s);
  return status;
}

TEST(SaveStatus, FailureMode16SavingsThatFailRaiseTheLevelAndSayForHowLong) {
  SaveStatus saves(0.0);
  saves.note("/maps/last", "", 100.0);
  EXPECT_EQ(described(saves, 101.0).level, Level::OK);
  saves.note("/maps/last", "the disk is full", 130.0);
  EXPECT_EQ(described(saves, 131.0).level, Level::WARN);
  const auto late = described(saves, 100.0 + 40 * 60);
  EXPECT_EQ(late.level, Level::ERROR);
  EXPECT_NE(late.message.find("nothing saved for 40 min: the disk is full"), std::string::npos)
      << late.message;
  saves.note("/maps/last", "", 2600.0);
  EXPECT_EQ(described(saves, 2601.0).level, Level::OK);
}

}  // namespace
}  // namespace occusg_ros
