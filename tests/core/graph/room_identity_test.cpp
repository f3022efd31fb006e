// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "occusg/graph/graph_builder.hpp"
#include "occusg/regions/region_tracker.hpp"
#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::poseAt;
using testing::rectangle;
using testing::regionFrom;
using testing::roomsOf;

constexpr double kPeriod_s = 2.0;  // Of maintenance, so that each update maintains.
constexpr NodeId kWhole = firstId(NodeType::kRoom);

/// Tracker and graph as a pipeline joins them, in their default configuration. The robot stands
/// apart from the rooms the test is about.
class RoomIdentity : public ::testing::Test {
 protected:
  void see(const std::vector<Polygon>& footprints, int updates) {
    Decomposition decomposition;
    for (const Polygon& footprint : footprints) {
      const int id = static_cast<int>(decomposition.regions.size()) + 1;
      decomposition.regions.push_back(regionFrom(id, footprint));
    }
    for (int i = 0; i < updates; ++i) {
      builder_.update(tracker_.update(decomposition), poseAt(x_robot_, 1.0), stamp_s_);
      stamp_s_ += kPeriod_s;
    }
  }
  [[nodiscard]] double areaOf(NodeId room) const { return builder_.graph().room(room).area_m2; }
  [[nodiscard]] std::vector<NodeId> rooms() const { return roomsOf(builder_.graph()); }

  RegionTracker tracker_{RegionTrackerConfig{}};
  GraphBuilder builder_{GraphBuilderConfig{}};
  double stamp_s_ = 0.0;
  double x_robot_ = 2.0;
};

const Polygon kCorridor = rectangle(0.0, 0.0, 24.0, 1.5);
const Polygon kLongPart = rectangle(0.0, 0.0, 14.0, 1.5);
const Polygon kShortPart = rectangle(14.0, 0.0, 24.0, 1.5);

TEST_F(RoomIdentity, ARoomThatIsSplitKeepsItsIdOnTheLargerPart) {
  see({kCorridor}, 3);
  ASSERT_EQ(rooms(), std::vector<NodeId>{kWhole});
  see({kShortPart, kLongPart}, 10);
  ASSERT_EQ(rooms(), (std::vector<NodeId>{kWhole, kWhole + 1}));
  EXPECT_DOUBLE_EQ(areaOf(kWhole), 21.0);
  EXPECT_DOUBLE_EQ(areaOf(kWhole + 1), 15.0);
  EXPECT_EQ(builder_.roomIdSwitches(), 0U);
}

TEST_F(RoomIdentity, EvenIfTheRobotIsInTheSmallerPart) {
  x_robot_ = 20.0;
  see({kCorridor}, 3);
  see({kShortPart, kLongPart}, 10);
  EXPECT_DOUBLE_EQ(areaOf(kWhole), 21.0);
  EXPECT_EQ(builder_.currentRoom(), kWhole + 1);
  EXPECT_EQ(builder_.roomIdSwitches(), 0U);
}

TEST_F(RoomIdentity, RoomsThatMergeGoOnAsTheLarger) {
  see({kShortPart, kLongPart}, 5);
  ASSERT_EQ(rooms(), (std::vector<NodeId>{kWhole, kWhole + 1}));
  const NodeId larger = areaOf(kWhole) > areaOf(kWhole + 1) ? kWhole : kWhole + 1;
  see({kCorridor}, 10);
  EXPECT_EQ(rooms(), std::vector<NodeId>{larger});
  EXPECT_DOUBLE_EQ(areaOf(larger), 36.0);
  EXPECT_EQ(builder_.roomIdSwitches(), 0U);
}

TEST_F(RoomIdentity, AMergeThatIsUndoneSoonCostsNoRoomItsId) {
  see({kShortPart, kLongPart}, 5);
  const std::vector<NodeId> before = rooms();
  const std::vector<double> areas{areaOf(before.at(0)), areaOf(before.at(1))};
  see({kCorridor}, 3);
  see({kLongPart, kShortPart}, 10);
  ASSERT_EQ(rooms(), before);
  EXPECT_EQ((std::vector<double>{areaOf(before[0]), areaOf(before[1])}), areas);
  EXPECT_EQ(builder_.roomIdSwitches(), 0U);
}

TEST_F(RoomIdentity, ARoomSplitAndMergedManyTimesIsOneRoom) {
  see({kCorridor}, 3);
  for (int i = 0; i < 3; ++i) {
    see({kShortPart, kLongPart}, 1);
    see({kCorridor}, 1);
  }
  see({kCorridor}, 10);
  EXPECT_EQ(rooms(), std::vector<NodeId>{kWhole});
  EXPECT_EQ(builder_.roomIdSwitches(), 0U);
}

}  // namespace
}  // namespace occusg
