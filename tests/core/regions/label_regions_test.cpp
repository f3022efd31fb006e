// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/label_regions.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace occusg {
namespace {

/// Labels drawn as text, the top line being the highest y; anything but a letter is kNoRegion.
Grid<std::int32_t> labelled(const std::vector<std::string>& rows, Cell corner = {0, 0}) {
  const int width = static_cast<int>(rows.front().size());
  const int height = static_cast<int>(rows.size());
  const CellBox box{corner, {corner.x + width, corner.y + height}};
  Grid<std::int32_t> labels(box, kNoRegion);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char letter = rows[height - 1 - y][x];
      if (letter >= 'a') labels.at({corner.x + x, corner.y + y}) = letter - 'a' + 1;
    }
  }
  return labels;
}

TEST(NumberedPieces, CountFromTheLowestRowWhateverTheLabels) {
  EXPECT_TRUE(numberedPieces(labelled({"ccaa", "zz.a"})) == labelled({"ccbb", "aa.b"}));
}

TEST(NumberedPieces, EqualLabelsThatTouchAtACornerAreTwoPieces) {
  EXPECT_TRUE(numberedPieces(labelled({"a.", ".a"})) == labelled({"b.", ".a"}));
}

TEST(NumberedPieces, ArmsThatMeetLaterAreOnePiece) {
  EXPECT_TRUE(numberedPieces(labelled({"aaaaa", "a.a.a", "a.a.a"})) ==
              labelled({"aaaaa", "a.a.a", "a.a.a"}));
}

TEST(NumberedPieces, OfAnEmptyGridAreNone) {
  EXPECT_TRUE(numberedPieces(Grid<std::int32_t>()).empty());
}

TEST(WithoutSmallPieces, JoinsTheNeighbourWithTheWidestContact) {
  EXPECT_TRUE(withoutSmallPieces(labelled({"aabbbb", "accbbb", "aaaabb"}), 3) ==
              labelled({"aabbbb", "aaabbb", "aaaabb"}));
}

TEST(WithoutSmallPieces, DropsWhatHasNoNeighbour) {
  EXPECT_TRUE(withoutSmallPieces(labelled({"a.bbb"}), 2) == labelled({"..aaa"}));
}

TEST(WithoutSmallPieces, SmallOnesMayGrowTogether) {
  EXPECT_TRUE(withoutSmallPieces(labelled({"abb.cdd"}), 3) == labelled({"aaa.bbb"}));
  EXPECT_TRUE(withoutSmallPieces(labelled({"abcd"}), 4) == labelled({"aaaa"}));
  EXPECT_TRUE(withoutSmallPieces(labelled({"abcd"}), 5) == labelled({"...."}));
}

TEST(DecompositionOf, RegionHasAreaCentroidBoundsAndHoles) {
  const Decomposition result =
      decompositionOf(labelled({"aaaa", "a..a", "a..a", "aaaa"}, {10, -20}), GridFrame{0.5});
  ASSERT_EQ(result.regions.size(), 1U);
  const Region& region = result.regions[0];
  EXPECT_EQ(region.id, 1);
  EXPECT_DOUBLE_EQ(region.area_m2, 3.0);
  EXPECT_DOUBLE_EQ(region.centroid.x, 6.0);
  EXPECT_DOUBLE_EQ(region.centroid.y, -9.0);
  EXPECT_EQ(region.cells, (CellBox{{10, -20}, {14, -16}}));
  EXPECT_EQ(region.polygon.outer.size(), 4U);
  ASSERT_EQ(region.polygon.holes.size(), 1U);
  EXPECT_DOUBLE_EQ(area(region.polygon), 3.0);
}

TEST(DecompositionOf, CrossingRunsFromJambToJamb) {
  const Decomposition result =
      decompositionOf(labelled({"aa.bb", "aaabb", "aaabb", "aa.bb"}), GridFrame{0.5}, 1.0);
  ASSERT_EQ(result.crossings.size(), 1U);
  EXPECT_EQ(result.crossings[0].region_a, 1);
  EXPECT_EQ(result.crossings[0].region_b, 2);
  EXPECT_EQ(result.crossings[0].segment.a, (Point2{1.5, 0.5}));
  EXPECT_EQ(result.crossings[0].segment.b, (Point2{1.5, 1.5}));
  EXPECT_EQ(result.regions[0].adjacent, std::vector<int>{2});
  EXPECT_EQ(result.regions[1].adjacent, std::vector<int>{1});
}

TEST(DecompositionOf, ContactBelowTheShortestCrossingDoesNotMakeNeighbours) {
  const Decomposition result = decompositionOf(labelled({"aabb", "aabb"}), GridFrame{0.1}, 0.21);
  EXPECT_TRUE(result.crossings.empty());
  EXPECT_TRUE(result.regions[0].adjacent.empty());
  EXPECT_EQ(decompositionOf(labelled({"aabb", "aabb"}), GridFrame{0.1}, 0.2).crossings.size(), 1U);
}

TEST(DecompositionOf, TwoDoorsBetweenTheSameRegionsAreTwoCrossings) {
  const Decomposition result =
      decompositionOf(labelled({"aabb", "aabb", "a..b", "aabb"}), GridFrame{0.5}, 0.5);
  ASSERT_EQ(result.crossings.size(), 2U);
  EXPECT_DOUBLE_EQ(length(result.crossings[0].segment), 0.5);
  EXPECT_DOUBLE_EQ(length(result.crossings[1].segment), 1.0);
  EXPECT_LT(result.crossings[0].segment.a.y, result.crossings[1].segment.a.y);
  EXPECT_EQ(result.regions[0].adjacent, std::vector<int>{2});
}

TEST(DecompositionOf, RegionWithinAnotherCrossesAlongItsDiagonal) {
  const Decomposition result =
      decompositionOf(labelled({"aaaa", "abba", "abba", "aaaa"}), GridFrame{1.0});
  ASSERT_EQ(result.crossings.size(), 1U);
  EXPECT_EQ(result.crossings[0].segment.a, (Point2{1.0, 1.0}));
  EXPECT_EQ(result.crossings[0].segment.b, (Point2{3.0, 3.0}));
}

TEST(DecompositionOf, NothingLabelledIsEmptyButKeepsTheFrame) {
  const Decomposition result = decompositionOf(labelled({"....", "...."}), GridFrame{0.2});
  EXPECT_TRUE(result.regions.empty());
  EXPECT_TRUE(result.crossings.empty());
  EXPECT_DOUBLE_EQ(result.frame.resolution_m, 0.2);
  EXPECT_EQ(result.labels.box(), (CellBox{{0, 0}, {4, 2}}));
}

}  // namespace
}  // namespace occusg
