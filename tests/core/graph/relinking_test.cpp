// SPDX-License-Identifier: BSD-3-Clause
#include "graph/relinking.hpp"

#include <gtest/gtest.h>

#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::rectangle;
using testing::regionFrom;

std::vector<Successor> successors(const std::vector<LostRoom>& rooms,
                                  const std::vector<Region>& regions,
                                  const RoomLayerConfig& config = {}) {
  std::vector<const Region*> unowned;
  unowned.reserve(regions.size());
  for (const Region& region : regions) unowned.push_back(&region);
  return successorsOf(rooms, unowned, config);
}

const Polygon kTenByTen = rectangle(0.0, 0.0, 10.0, 10.0);

/// Covers `share` of kTenByTen, from the left.
Region covering(int id, double share) {
  return regionFrom(id, rectangle(0.0, 0.0, 10.0 * share, 10.0));
}

TEST(Relinking, NeedsTheOverlap) {
  const std::vector<LostRoom> rooms{{7, &kTenByTen, {{1.0, 1.0}}}};
  EXPECT_EQ(successors(rooms, {covering(3, 0.66)}).size(), 1U);
  EXPECT_TRUE(successors(rooms, {covering(3, 0.64)}).empty());
}

TEST(Relinking, NeedsHalfTheMembersWhereItHoldsTheCentroid) {
  const std::vector<Region> regions{covering(3, 0.8)};
  EXPECT_EQ(successors({{7, &kTenByTen, {{1, 1}, {9, 9}}}}, regions).size(), 1U);
  EXPECT_TRUE(successors({{7, &kTenByTen, {{1, 1}, {9, 9}, {9, 1}}}}, regions).empty());
}

TEST(Relinking, NeedsMoreMembersWhereItDoesNotHoldTheCentroid) {
  Polygon around = kTenByTen;
  around.holes = {{{4, 4}, {4, 6}, {6, 6}, {6, 4}}};
  const std::vector<Region> regions{regionFrom(3, around)};
  EXPECT_EQ(successors({{7, &kTenByTen, {{1, 1}, {1, 2}, {1, 3}, {5, 5}}}}, regions).size(), 1U);
  EXPECT_TRUE(successors({{7, &kTenByTen, {{1, 1}, {1, 2}, {5, 5}}}}, regions).empty());
}

TEST(Relinking, WithoutMembersTheFootprintStandsIn) {
  EXPECT_EQ(successors({{7, &kTenByTen, {}}}, {covering(3, 0.8)}).size(), 1U);
}

TEST(Relinking, RefusesWhatIsAmbiguous) {
  const std::vector<LostRoom> rooms{{7, &kTenByTen, {{1.0, 1.0}}}};
  EXPECT_TRUE(successors(rooms, {covering(3, 0.9), covering(4, 0.85)}).empty());
  RoomLayerConfig config;
  config.relink_min_margin = 0.01;
  const auto found = successors(rooms, {covering(3, 0.85), covering(4, 0.9)}, config);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].region, 4);
}

TEST(Relinking, OneRegionSucceedsTheRoomItFitsBest) {
  const Polygon narrow = rectangle(0.0, 0.0, 3.0, 10.0);
  const std::vector<LostRoom> rooms{{7, &narrow, {{1.0, 1.0}}}, {8, &kTenByTen, {{1.0, 1.0}}}};
  const auto found = successors(rooms, {covering(3, 1.0)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].room, 8);
}

TEST(Relinking, EqualRoomsAreDecidedByTheSmallerId) {
  const std::vector<LostRoom> rooms{{8, &kTenByTen, {}}, {7, &kTenByTen, {}}};
  const auto found = successors(rooms, {covering(3, 1.0)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].room, 7);
}

}  // namespace
}  // namespace occusg
