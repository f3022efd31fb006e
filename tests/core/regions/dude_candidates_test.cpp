// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "drawn_grid.hpp"
#include "regions/dude_mask.hpp"

namespace occusg {
namespace {

using testing::drawn;

/// Everything up to the candidates, in the place the layer was drawn.
struct Candidates {
  explicit Candidates(const FreeSpace& layer)
      : open(cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kNone)),
        clearance(squaredClearance(open)),
        surroundings(open, clearance, identity),
        shape(shapeOf(outlinesOf(open).front(), surroundings, 20.0)),
        mesh(triangulated(shape.rings)),
        found(cutCandidates(mesh, shape, surroundings, 20.0)) {}

  [[nodiscard]] bool has(const Cell& a, const Cell& b) const {
    return std::any_of(found.begin(), found.end(), [&](const DudeCandidate& candidate) {
      const Cell& from = mesh.points[static_cast<std::size_t>(candidate.corner_a)];
      const Cell& to = mesh.points[static_cast<std::size_t>(candidate.corner_b)];
      return (from == a && to == b) || (from == b && to == a);
    });
  }

  GridSymmetry identity;
  Grid<std::uint8_t> open;
  Grid<std::int32_t> clearance;
  DudeSurroundings surroundings;
  DudeShape shape;
  DudeMesh mesh;
  std::vector<DudeCandidate> found;
};

/// Two rooms of six by seven; the door is two cells wide, its wall one cell thick.
const std::vector<std::string> kTwoRooms{"......#......", "......#......", "......#......",
                                         ".............", ".............", "......#......",
                                         "......#......"};

TEST(DudeCandidates, BothFacesOfADoorAreCandidates) {
  const Candidates candidates(drawn(kTwoRooms));
  EXPECT_TRUE(candidates.has({6, 2}, {6, 4}));
  EXPECT_TRUE(candidates.has({7, 2}, {7, 4}));
}

TEST(DudeCandidates, DiagonalOfADoorwayIsNone) {
  const Candidates candidates(drawn(kTwoRooms));
  EXPECT_FALSE(candidates.has({6, 2}, {7, 4}));
  EXPECT_FALSE(candidates.has({7, 2}, {6, 4}));
}

TEST(DudeCandidates, DepthIsThatOfTheDeeperJamb) {
  const Candidates candidates(drawn(kTwoRooms));
  // The stub above the door is three cells long, the one below two.
  int doors = 0;
  for (const DudeCandidate& candidate : candidates.found) {
    if (candidate.length_cells != 2.0) continue;
    EXPECT_DOUBLE_EQ(candidate.depth_cells, 3.0);
    ++doors;
  }
  EXPECT_EQ(doors, 2);
}

TEST(DudeCandidates, FootIsPutIntoTheWallOppositeALoneJamb) {
  const Candidates candidates(drawn({"......#......", "......#......", "......#......",
                                     "......#......", ".............", "............."}));
  EXPECT_TRUE(candidates.has({6, 2}, {6, 0}));
  EXPECT_TRUE(candidates.has({7, 2}, {7, 0}));
}

TEST(DudeCandidates, ConvexRoomHasNone) {
  EXPECT_TRUE(Candidates(drawn({"....", "....", "...."})).found.empty());
}

TEST(DudeCandidates, LongestCutLimitsThem) {
  const Candidates wide(
      drawn({std::string(60, '.'), std::string(30, '.') + "#" + std::string(29, '.'),
             std::string(60, '.')}));
  for (const DudeCandidate& candidate : wide.found) EXPECT_LE(candidate.length_cells, 20.0);
}

TEST(DudeCandidates, BorderInsideFreeSpaceIsNoObstacle) {
  // The outline is that of the left room and the doorway; beyond it the map is free.
  const FreeSpace layer = drawn(kTwoRooms);
  const Grid<std::uint8_t> open =
      cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kNone);
  Grid<std::uint8_t> work = open;
  for (int y = 0; y < 7; ++y)
    for (int x = 7; x < 13; ++x) work.at({x, y}) = 0;
  const Grid<std::int32_t> clearance = squaredClearance(open);
  const GridSymmetry identity;
  const DudeShape shape =
      shapeOf(outlinesOf(work).front(), DudeSurroundings(open, clearance, identity), 20.0);
  std::size_t minima = 0;
  std::size_t number = 0;
  for (const CornerRing& ring : shape.rings)
    for (const Cell& corner : ring)
      if (shape.corners[number++].is_minimum) {
        ++minima;
        EXPECT_TRUE(corner.x == 6 || corner.x == 7);
      }
  EXPECT_EQ(minima, 4U);
}

TEST(DudeClearance, CellsBeyondTheGridAreClosed) {
  const FreeSpace layer = drawn({"...", "...", "..."});
  const Grid<std::int32_t> squared =
      squaredClearance(cleanedFreeSpace(layer.cells, layer.cells.box(), GridCleaning::kNone));
  EXPECT_EQ(squared.at({1, 1}), 4);
  EXPECT_EQ(squared.at({0, 1}), 1);
  EXPECT_EQ(squaredClearance({}).values().size(), 0U);
}

}  // namespace
}  // namespace occusg
