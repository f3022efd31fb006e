// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/gap_conversions.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "occusg/error.hpp"
#include "occusg_ros/grid_conversions.hpp"

namespace occusg_ros {
namespace {

using occusg::Cell;
using occusg::CellBox;
using occusg::ColumnEvidence;
using occusg::FreeSpace;

const Cell kLintel{-7, 4};
const Cell kOpenToTheSky{1, 3};

// 9 x 2 free cells of 5 cm: a lintel at 2.05 m over one, nothing known over another.
FreeSpace doorway() {
  FreeSpace layer;
  layer.frame.resolution_m = 0.05;
  layer.cells = occusg::FreeSpaceCells(CellBox{{-7, 3}, {2, 5}}, occusg::kFree);
  ColumnEvidence& lintel = layer.evidence.touch(kLintel);
  lintel.overhead = occusg::Overhead::kOccupied;
  lintel.gap_bottom = 1;
  lintel.gap_top = 41;
  layer.evidence.touch(kOpenToTheSky).gap_top = 30;
  return layer;
}

std::string refusalOf(const occusg::OverheadGaps& gaps) {
  FreeSpace layer = toFreeSpace(toGridMsg(doorway(), {}), "map");
  try {
    addGaps(gaps, "gaps", layer);
  } catch (const occusg::Error& error) {
    EXPECT_TRUE(layer.evidence.empty()) << "a refused message changes nothing";
    return error.what();
  }
  return "accepted";
}

TEST(GapConversions, LintelsSurviveTheWayThroughTwoMessages) {
  const FreeSpace sent = doorway();
  FreeSpace received = toFreeSpace(toGridMsg(sent, {}), "map");
  addGaps(toGapsMsg(sent, {}), "gaps", received);
  const ColumnEvidence& lintel = received.evidence.at(kLintel);
  EXPECT_EQ(lintel.overhead, occusg::Overhead::kOccupied);
  EXPECT_EQ(lintel.gap_bottom, 1);
  EXPECT_EQ(lintel.gap_top, 41);
}

TEST(GapConversions, NothingKnownOverheadIsNoLintel) {
  FreeSpace received = toFreeSpace(toGridMsg(doorway(), {}), "map");
  addGaps(toGapsMsg(doorway(), {}), "gaps", received);
  EXPECT_EQ(received.evidence.at(kOpenToTheSky).overhead, occusg::Overhead::kUnknown);
  EXPECT_EQ(received.evidence.at({0, 3}), ColumnEvidence());
}

TEST(GapConversions, HeaderAndPlaceAreThoseOfTheGrid) {
  std_msgs::Header header;
  header.frame_id = "map";
  header.stamp.sec = 7;
  const occusg::OverheadGaps gaps = toGapsMsg(doorway(), header);
  const nav_msgs::OccupancyGrid grid = toGridMsg(doorway(), header);
  EXPECT_EQ(gaps.header, grid.header);
  EXPECT_EQ(gaps.info, grid.info);
}

TEST(GapConversions, FailureMode11GapsOfOtherCellsAreRefusedInOneSentence) {
  const occusg::OverheadGaps good = toGapsMsg(doorway(), {});
  ASSERT_EQ(refusalOf(good), "accepted");

  occusg::OverheadGaps gaps = good;
  gaps.info.width = 8;
  EXPECT_NE(refusalOf(gaps).find("has 9 x 2 cells"), std::string::npos) << refusalOf(gaps);
  gaps = good;
  gaps.gap_top.pop_back();
  EXPECT_NE(refusalOf(gaps).find("17 gaps"), std::string::npos) << refusalOf(gaps);
  gaps = good;
  gaps.gap_bottom.push_back(0);
  EXPECT_NE(refusalOf(gaps), "accepted");
  gaps = good;
  gaps.info.origin.position.x += 0.05;
  EXPECT_NE(refusalOf(gaps).find("lie elsewhere"), std::string::npos) << refusalOf(gaps);
  gaps = good;
  gaps.info.origin.position.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusalOf(gaps).find("lie elsewhere"), std::string::npos) << refusalOf(gaps);
  gaps = good;
  gaps.info.resolution = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refusalOf(gaps).find("lie elsewhere"), std::string::npos) << refusalOf(gaps);
}

}  // namespace
}  // namespace occusg_ros
