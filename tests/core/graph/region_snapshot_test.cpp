// SPDX-License-Identifier: BSD-3-Clause
#include "graph/region_snapshot.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "occusg/regions/region_tracker.hpp"
#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::rectangle;
using testing::regionFrom;

/// Up to six rectangles in a row that come, go and change their width, and where they meet.
Decomposition randomRow(std::mt19937& random) {
  Decomposition decomposition;
  for (int x = 0; x < 6; ++x) {
    if (random() % 5 == 0) continue;
    const double width = 3.8 - 0.1 * static_cast<double>(random() % 3 == 0 ? random() % 4 : 0);
    const int id = static_cast<int>(decomposition.regions.size()) + 1;
    decomposition.regions.push_back(regionFrom(id, rectangle(4.0 * x, 0.0, 4.0 * x + width, 4.0)));
    if (id > 1) {
      decomposition.crossings.push_back(
          {id - 1,
           id,
           {decomposition.regions[static_cast<std::size_t>(id) - 2].centroid,
            decomposition.regions.back().centroid}});
    }
  }
  return decomposition;
}

bool areSame(const std::vector<Segment2>& a, const std::vector<Segment2>& b) {
  bool same = a.size() == b.size();
  for (std::size_t i = 0; same && i < a.size(); ++i) same = a[i].a == b[i].a && a[i].b == b[i].b;
  return same;
}

void expectSame(const RegionSnapshot& one, const RegionSnapshot& other) {
  EXPECT_EQ(one.state(), other.state());
  EXPECT_EQ(one.changedRegions(), other.changedRegions());
  EXPECT_EQ(one.changedContacts(), other.changedContacts());
  ASSERT_EQ(one.regions().size(), other.regions().size());
  for (const auto& [id, support] : one.regions()) {
    ASSERT_TRUE(other.has(id));
    EXPECT_EQ(support.region.polygon.outer, other.regions().at(id).region.polygon.outer);
  }
  for (int a = 1; a < 100; ++a) {
    EXPECT_EQ(one.remembers(a), other.remembers(a)) << "region " << a;
    for (int b = a + 1; b < a + 10; ++b)
      EXPECT_TRUE(areSame(one.crossingsBetween({a, b}), other.crossingsBetween({a, b})));
  }
}

TEST(RegionSnapshot, WhatTheTrackerSaysChangedIsWhatAComparisonFinds) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    RegionTracker tracker{RegionTrackerConfig{}};
    RegionSnapshot told;
    RegionSnapshot compared;
    std::size_t unchanged = 0;
    for (int i = 0; i < 40; ++i) {
      if (random() % 20 == 0) tracker.reset();
      TrackedRegions tracked = tracker.update(randomRow(random));
      const bool is_missed = random() % 10 == 0;
      if (is_missed) continue;
      told.update(tracked);
      tracked.update = 0;
      compared.update(tracked);
      expectSame(told, compared);
      if (HasFailure()) return;
      unchanged += told.regions().size() - told.changedRegions().size();
    }
    EXPECT_GT(unchanged, 0U) << "the sequence tests nothing";
  }
}

TEST(RegionSnapshot, OnlyTheRegionsToldAreLookedAt) {
  RegionSnapshot snapshot;
  TrackedRegions tracked = testing::tracked({testing::squareAt(1, 0.0), testing::squareAt(2, 4.0)});
  tracked.update = 7;
  snapshot.update(tracked);
  tracked.decomposition.regions[0] = testing::squareAt(1, 0.5, 3.0);
  tracked.decomposition.regions[1] = testing::squareAt(2, 4.5, 3.0);
  tracked.update = 8;
  tracked.changed = {2};
  snapshot.update(tracked);
  EXPECT_EQ(snapshot.changedRegions(), std::vector<int>{2});
  EXPECT_DOUBLE_EQ(snapshot.regions().at(1).region.area_m2, 16.0);
  EXPECT_DOUBLE_EQ(snapshot.regions().at(2).region.area_m2, 9.0);
}

}  // namespace
}  // namespace occusg
