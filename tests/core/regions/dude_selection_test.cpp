// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_selection.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace occusg {
namespace {

DudeLink link(int a, int b, double length, double depth, double bonus = 0.0) {
  return {a, b, length, depth, bonus};
}

std::vector<char> kept(const std::vector<DudePiece>& pieces, const std::vector<DudeLink>& links,
                       const DudeSelectionRules& rules = {}) {
  return selectCuts(pieces, links, rules).is_kept;
}

const DudePiece kRoom{20.0, 4000};

TEST(DudeSelection, KeepsADoorAndDropsAnOpening) {
  // Half of 18 is below 0.8 of 20, half of 34 is not.
  EXPECT_EQ(kept({kRoom, kRoom, kRoom}, {link(0, 1, 18, 60), link(1, 2, 34, 60)}),
            (std::vector<char>{1, 0}));
}

TEST(DudeSelection, OfTwoCutsAcrossOneDoorwayOneStays) {
  // Room, niche, room: the niche is no wider than the door.
  const DudePiece niche{9.0, 100};
  EXPECT_EQ(kept({kRoom, niche, kRoom}, {link(0, 1, 19, 60), link(1, 2, 18, 60)}),
            (std::vector<char>{0, 1}));
}

TEST(DudeSelection, ShallowCutsGo) {
  EXPECT_EQ(kept({kRoom, kRoom}, {link(0, 1, 18, 49)}), (std::vector<char>{0}));
  EXPECT_EQ(kept({kRoom, kRoom}, {link(0, 1, 18, 50)}), (std::vector<char>{1}));
}

TEST(DudeSelection, SmallPieceJoinsAcrossItsLongestCut) {
  const DudePiece closet{10.0, 150};
  EXPECT_EQ(kept({kRoom, closet, kRoom}, {link(0, 1, 8, 60), link(1, 2, 12, 60)}),
            (std::vector<char>{1, 0}));
}

TEST(DudeSelection, SmallPieceWithoutACutStays) {
  const DudeSelection selection = selectCuts({{3.0, 10}}, {}, {});
  EXPECT_EQ(selection.count, 1);
  EXPECT_EQ(selection.merged_piece, (std::vector<int>{0}));
}

TEST(DudeSelection, OldCutIsPreferred) {
  EXPECT_EQ(kept({kRoom, kRoom}, {link(0, 1, 34, 60, 0.2)}), (std::vector<char>{1}));
  EXPECT_EQ(kept({kRoom, kRoom}, {link(0, 1, 39, 60, 0.2)}), (std::vector<char>{0}));
  EXPECT_EQ(kept({kRoom, kRoom}, {link(0, 1, 18, 45, 0.2)}), (std::vector<char>{1}));
}

TEST(DudeSelection, PieceWithoutACellNeverStays) {
  EXPECT_EQ(kept({kRoom, {0.0, 0}}, {link(0, 1, 1, 60)}), (std::vector<char>{0}));
}

TEST(DudeSelection, MergedPiecesAreNumberedInOrder) {
  const DudeSelection selection =
      selectCuts({kRoom, kRoom, kRoom}, {link(0, 2, 34, 60), link(0, 1, 18, 60)}, {});
  EXPECT_EQ(selection.count, 2);
  EXPECT_EQ(selection.merged_piece, (std::vector<int>{0, 1, 0}));
}

}  // namespace
}  // namespace occusg
