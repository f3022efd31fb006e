// SPDX-License-Identifier: BSD-3-Clause
#include "graph/entity_assignment.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::rectangle;
using testing::regionFrom;
using testing::squareAt;
using testing::stale;
using testing::tracked;

constexpr double kToleranceM = 0.5;

RegionSnapshot snapshotOf(std::vector<Region> regions) {
  RegionSnapshot snapshot;
  snapshot.update(tracked(std::move(regions)));
  return snapshot;
}

std::optional<int> held(const RegionSnapshot& snapshot, const Point2& point,
                        std::optional<int> previous = std::nullopt) {
  return regionAt(snapshot, point, kToleranceM, previous);
}

TEST(RegionAt, HalfAMetreOutsideIsTheLimit) {
  const RegionSnapshot snapshot = snapshotOf({squareAt(1, 0.0)});
  EXPECT_EQ(held(snapshot, {2.0, 2.0}), 1);
  EXPECT_EQ(held(snapshot, {4.49, 2.0}), 1);
  EXPECT_EQ(held(snapshot, {4.5, 2.0}), 1);
  EXPECT_FALSE(held(snapshot, {4.51, 2.0}));
  // Within the grown bounds, but farther from the corner.
  EXPECT_FALSE(held(snapshot, {4.4, 4.4}));
}

TEST(RegionAt, TiesAreDecidedTheSameWayInAnyOrder) {
  const Point2 halfway{4.2, 2.0};
  EXPECT_EQ(held(snapshotOf({squareAt(1, 0.0), squareAt(2, 4.4)}), halfway), 1);
  EXPECT_EQ(held(snapshotOf({squareAt(2, 4.4), squareAt(1, 0.0)}), halfway), 1);
  const Point2 on_common_side{4.0, 2.0};
  EXPECT_EQ(held(snapshotOf({squareAt(1, 0.0), squareAt(2, 4.0)}), on_common_side), 1);
  EXPECT_EQ(held(snapshotOf({squareAt(2, 4.0), squareAt(1, 0.0)}), on_common_side), 1);
}

TEST(RegionAt, InsideWinsOverTheRegionBefore) {
  const RegionSnapshot snapshot = snapshotOf({squareAt(1, 0.0), squareAt(2, 4.0)});
  EXPECT_EQ(held(snapshot, {4.01, 2.0}, 1), 2);
}

TEST(RegionAt, OutsideAllTheRegionBeforeWinsOverTheNearer) {
  const RegionSnapshot snapshot = snapshotOf({squareAt(1, 0.0), squareAt(2, 4.4)});
  EXPECT_EQ(held(snapshot, {4.3, 2.0}), 2);
  EXPECT_EQ(held(snapshot, {4.3, 2.0}, 1), 1);
}

TEST(RegionAt, TheInnermostOfNestedRegionsHoldsThePoint) {
  const RegionSnapshot snapshot =
      snapshotOf({squareAt(1, 0.0, 10.0), regionFrom(2, rectangle(4.0, 4.0, 6.0, 6.0))});
  EXPECT_EQ(held(snapshot, {5.0, 5.0}, 1), 2);
  EXPECT_EQ(held(snapshot, {4.0, 5.0}), 2);
  EXPECT_EQ(held(snapshot, {3.9, 5.0}, 2), 1);
}

TEST(RegionAt, AHoleIsOutside) {
  Polygon ring = rectangle(0.0, 0.0, 10.0, 10.0);
  ring.holes = {{{2.0, 2.0}, {2.0, 8.0}, {8.0, 8.0}, {8.0, 2.0}}};
  const RegionSnapshot snapshot = snapshotOf({regionFrom(1, ring)});
  EXPECT_EQ(held(snapshot, {1.0, 1.0}), 1);
  EXPECT_EQ(held(snapshot, {2.4, 5.0}), 1);
  EXPECT_FALSE(held(snapshot, {5.0, 5.0}));
}

class EntityAssignmentTest : public ::testing::Test {
 protected:
  NodeId objectAt(double x, double y) {
    return graph_.add({x, y, 0.0}, 0.0, ObjectAttributes{}).id;
  }

  SceneGraph graph_;
  RegionSnapshot snapshot_;
  EntityAssignment assignment_{kToleranceM};
};

TEST_F(EntityAssignmentTest, ResolvesOnlyWhatIsNewMovedOrNearAChange) {
  const NodeId left = objectAt(1.0, 1.0);
  const NodeId right = objectAt(21.0, 1.0);
  const NodeId nowhere = objectAt(50.0, 50.0);
  snapshot_.update(tracked({squareAt(1, 0.0), squareAt(2, 20.0)}));
  assignment_.update(graph_, snapshot_);
  EXPECT_EQ(assignment_.resolvedCount(), 3U);
  EXPECT_EQ(assignment_.regionOf(left), 1);
  EXPECT_EQ(assignment_.regionOf(right), 2);
  EXPECT_FALSE(assignment_.regionOf(nowhere));

  snapshot_.update(tracked({squareAt(1, 0.0), squareAt(2, 20.0)}));
  assignment_.update(graph_, snapshot_);
  EXPECT_EQ(assignment_.resolvedCount(), 0U);

  snapshot_.update(tracked({squareAt(1, 0.0), squareAt(2, 20.0, 5.0)}));
  assignment_.update(graph_, snapshot_);
  EXPECT_EQ(assignment_.resolvedCount(), 1U);

  Node moved = graph_.at(left);
  moved.position.x() = 22.0;
  graph_.update(moved);
  snapshot_.update(tracked({squareAt(1, 0.0), squareAt(2, 20.0, 5.0)}));
  assignment_.update(graph_, snapshot_);
  EXPECT_EQ(assignment_.resolvedCount(), 1U);
  EXPECT_EQ(assignment_.regionOf(left), 2);
}

TEST_F(EntityAssignmentTest, FollowsNodesThatComeAndGo) {
  snapshot_.update(tracked({squareAt(1, 0.0)}));
  const NodeId first = objectAt(1.0, 1.0);
  const NodeId second = objectAt(2.0, 1.0);
  const NodeId block = graph_.add({3.0, 1.0, 0.0}, 0.0, NavigationAttributes{}).id;
  assignment_.update(graph_, snapshot_);
  graph_.remove(first);
  graph_.remove(block);
  const NodeId agent = graph_.add({1.0, 1.0, 0.0}, 0.0, AgentAttributes{}).id;
  assignment_.update(graph_, snapshot_);
  EXPECT_FALSE(assignment_.regionOf(first));
  EXPECT_FALSE(assignment_.regionOf(block));
  EXPECT_EQ(assignment_.regionOf(second), 1);
  EXPECT_EQ(assignment_.regionOf(agent), 1);
}

TEST_F(EntityAssignmentTest, LosesTheRegionThatGoes) {
  const NodeId object = objectAt(21.0, 1.0);
  snapshot_.update(tracked({squareAt(1, 0.0), squareAt(2, 20.0)}));
  assignment_.update(graph_, snapshot_);
  snapshot_.update(tracked({squareAt(1, 0.0)}));
  assignment_.update(graph_, snapshot_);
  EXPECT_FALSE(assignment_.regionOf(object));
}

TEST(RegionSnapshot, LeavesOutRegionsWithoutAreaButRemembersThem) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RegionSnapshot snapshot;
  Region empty;
  empty.id = 2;
  snapshot.update(tracked({squareAt(1, 0.0), empty, regionFrom(3, {{{0, 0}, {1, 0}, {2, 0}}, {}}),
                           regionFrom(4, {{{0, 0}, {nan, 0}, {2, 2}}, {}})},
                          {9}));
  EXPECT_TRUE(snapshot.has(1));
  for (const int id : {2, 3, 4, 9}) {
    EXPECT_FALSE(snapshot.has(id));
    EXPECT_TRUE(snapshot.remembers(id));
  }
  EXPECT_FALSE(snapshot.remembers(10));
}

TEST(RegionSnapshot, AnEmptyOrStaleUpdateKeepsTheRegions) {
  RegionSnapshot snapshot;
  snapshot.update(tracked({}));
  EXPECT_EQ(snapshot.state(), SnapshotState::kNone);
  snapshot.update(tracked({squareAt(1, 0.0)}));
  EXPECT_EQ(snapshot.state(), SnapshotState::kFresh);
  snapshot.update(tracked({}, {1}));
  EXPECT_EQ(snapshot.state(), SnapshotState::kStale);
  EXPECT_TRUE(snapshot.has(1));
  snapshot.update(stale(tracked({squareAt(2, 0.0)})));
  EXPECT_EQ(snapshot.state(), SnapshotState::kStale);
  EXPECT_FALSE(snapshot.has(2));
  snapshot.update(tracked({squareAt(2, 0.0)}));
  EXPECT_EQ(snapshot.state(), SnapshotState::kFresh);
  EXPECT_FALSE(snapshot.has(1));
}

}  // namespace
}  // namespace occusg
