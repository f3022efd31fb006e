// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstddef>

#include "occusg/regions/region.hpp"

namespace occusg::testing {

/// Expects that nothing tells `a` from `b`: regions, ids, crossings and labels.
inline void expectEqual(const Decomposition& a, const Decomposition& b) {
  ASSERT_EQ(a.regions.size(), b.regions.size());
  for (std::size_t i = 0; i < a.regions.size(); ++i) {
    EXPECT_EQ(a.regions[i].id, b.regions[i].id);
    EXPECT_EQ(a.regions[i].polygon.outer, b.regions[i].polygon.outer);
    EXPECT_EQ(a.regions[i].polygon.holes, b.regions[i].polygon.holes);
    EXPECT_EQ(a.regions[i].area_m2, b.regions[i].area_m2);
    EXPECT_EQ(a.regions[i].centroid, b.regions[i].centroid);
    EXPECT_EQ(a.regions[i].cells, b.regions[i].cells);
    EXPECT_EQ(a.regions[i].adjacent, b.regions[i].adjacent);
  }
  ASSERT_EQ(a.crossings.size(), b.crossings.size());
  for (std::size_t i = 0; i < a.crossings.size(); ++i) {
    EXPECT_EQ(a.crossings[i].region_a, b.crossings[i].region_a);
    EXPECT_EQ(a.crossings[i].region_b, b.crossings[i].region_b);
    EXPECT_EQ(a.crossings[i].segment.a, b.crossings[i].segment.a);
    EXPECT_EQ(a.crossings[i].segment.b, b.crossings[i].segment.b);
  }
  EXPECT_TRUE(a.labels == b.labels);
}

}  // namespace occusg::testing
