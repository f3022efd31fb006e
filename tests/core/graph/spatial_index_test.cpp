// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/spatial_index.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace occusg {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Keys = std::vector<SpatialIndex::Key>;

Bounds2 pointAt(double x, double y) { return {{x, y}, {x, y}}; }
bool any(SpatialIndex::Key /*key*/) { return true; }

TEST(SpatialIndex, FindsWhatTouchesABoxOnceEach) {
  SpatialIndex index;
  index.insert(3, {{0.0, 0.0}, {9.0, 1.0}});
  index.insert(1, pointAt(4.0, 0.5));
  index.insert(2, pointAt(-4.0, 0.5));
  EXPECT_EQ(index.touching({{3.0, 0.0}, {8.0, 3.0}}), (Keys{1, 3}));
  EXPECT_EQ(index.touching({{9.0, 1.0}, {10.0, 2.0}}), Keys{3});
  EXPECT_EQ(index.touching({{-kInfinity, -kInfinity}, {kInfinity, kInfinity}}), (Keys{1, 2, 3}));
  EXPECT_TRUE(index.touching({{20.0, 20.0}, {21.0, 21.0}}).empty());
}

TEST(SpatialIndex, ErasedKeysAreGone) {
  SpatialIndex index;
  index.insert(1, pointAt(1.0, 1.0));
  index.insert(2, {{-1e9, 0.0}, {1e9, 1.0}});
  index.erase(1, pointAt(1.0, 1.0));
  index.erase(2, {{-1e9, 0.0}, {1e9, 1.0}});
  index.erase(7, pointAt(1.0, 1.0));
  EXPECT_EQ(index.size(), 0U);
  EXPECT_TRUE(index.touching({{-2.0, -2.0}, {2.0, 2.0}}).empty());
}

TEST(SpatialIndex, TheNearestIsThatOfTheSmallerKeyWhenTwoAreEquallyNear) {
  SpatialIndex index;
  index.insert(9, pointAt(1.0, 0.0));
  index.insert(4, pointAt(-1.0, 0.0));
  EXPECT_EQ(index.nearest({0.0, 0.0}, 5.0, any), 4);
  EXPECT_EQ(index.nearest({0.0, 0.0}, 5.0, [](auto key) { return key == 9; }), 9);
  EXPECT_EQ(index.nearest({0.0, 0.0}, 0.99, any), std::nullopt);
  EXPECT_EQ(index.nearest({0.0, 0.0}, 1.0, any), 4);
}

TEST(SpatialIndex, FarAndStrangePlacesAreAnswered) {
  SpatialIndex index;
  EXPECT_EQ(index.nearest({0.0, 0.0}, kInfinity, any), std::nullopt);
  index.insert(1, pointAt(1e300, -1e300));
  EXPECT_EQ(index.nearest({0.0, 0.0}, kInfinity, any), 1);
  index.insert(2, pointAt(1e12, 0.0));
  EXPECT_EQ(index.nearest({0.0, 0.0}, kInfinity, any), 2);
  EXPECT_EQ(index.nearest({kNaN, 0.0}, kInfinity, any), std::nullopt);
  EXPECT_TRUE(index.touching({{kNaN, 0.0}, {kNaN, 1.0}}).empty());
}

TEST(SpatialIndex, AgreesWithASearchOfAllKeys) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    SpatialIndex index;
    std::vector<Point2> points;
    for (int key = 0; key < 200; ++key) {
      points.push_back({uniform(-30.0, 30.0), uniform(-30.0, 30.0)});
      index.insert(key, pointAt(points.back().x, points.back().y));
    }
    for (int query = 0; query < 50; ++query) {
      const Point2 at{uniform(-60.0, 60.0), uniform(-40.0, 40.0)};
      SpatialIndex::Key best = 0;
      for (std::size_t key = 1; key < points.size(); ++key) {
        if (distance(points[key], at) < distance(points[static_cast<std::size_t>(best)], at))
          best = static_cast<SpatialIndex::Key>(key);
      }
      EXPECT_EQ(index.nearest(at, kInfinity, any), best);
    }
  }
}

}  // namespace
}  // namespace occusg
