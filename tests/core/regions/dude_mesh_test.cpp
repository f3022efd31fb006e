// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "regions/dude_pieces.hpp"

namespace occusg {
namespace {

const CornerRing kSquare{{0, 0}, {6, 0}, {6, 6}, {0, 6}};
const CornerRing kHole{{2, 2}, {2, 4}, {4, 4}, {4, 2}};

std::int64_t twiceTheArea(const DudeMesh& mesh) {
  std::int64_t twice = 0;
  for (const DudeMesh::Face& face : mesh.faces) {
    const Cell& a = mesh.points[static_cast<std::size_t>(face.corners[0])];
    const Cell& b = mesh.points[static_cast<std::size_t>(face.corners[1])];
    const Cell& c = mesh.points[static_cast<std::size_t>(face.corners[2])];
    twice += static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) -
             static_cast<std::int64_t>(c.x - a.x) * (b.y - a.y);
  }
  return twice;
}

TEST(DudeMesh, FacesCoverTheAreaBetweenTheRings) {
  EXPECT_EQ(twiceTheArea(triangulated({kSquare})), 72);
  EXPECT_EQ(twiceTheArea(triangulated({kSquare, kHole})), 64);
}

TEST(DudeMesh, NeighboursNameOneAnother) {
  const DudeMesh mesh = triangulated({kSquare, kHole});
  ASSERT_EQ(mesh.faces.size(), 8U);
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    for (const int other : mesh.faces[face].neighbours) {
      if (other < 0) continue;
      const auto& back = mesh.faces[static_cast<std::size_t>(other)].neighbours;
      EXPECT_EQ(std::count(back.begin(), back.end(), static_cast<int>(face)), 1);
    }
  }
}

TEST(DudeMesh, RingsMayTouchAtACorner) {
  // Two holes that meet at (3, 3), and corners in the middle of straight edges.
  const DudeMesh mesh = triangulated({{{0, 0}, {3, 0}, {6, 0}, {6, 6}, {0, 6}},
                                      {{2, 2}, {2, 3}, {3, 3}, {3, 2}},
                                      {{3, 3}, {3, 4}, {4, 4}, {4, 3}}});
  EXPECT_EQ(twiceTheArea(mesh), 2 * (36 - 2));
}

TEST(DudePieces, WithoutCutsEverythingIsOnePiece) {
  const DudeMesh mesh = triangulated({kSquare, kHole});
  const DudeFlood flood = floodedPieces(mesh, {});
  EXPECT_EQ(flood.count, 1);
  const Grid<std::int32_t> values = rasterised(mesh, flood);
  EXPECT_EQ(std::count(values.values().begin(), values.values().end(), 0), 32);
  EXPECT_EQ(values.at({2, 2}), -1);
  EXPECT_EQ(values.at({3, 3}), -1);
  EXPECT_EQ(values.at({4, 3}), 0);
}

TEST(DudePieces, MarkedEdgeSeparatesItsSides) {
  const DudeMesh mesh = triangulated({kSquare});
  ASSERT_EQ(mesh.faces.size(), 2U);
  int side = 0;
  while (mesh.faces[0].neighbours[static_cast<std::size_t>(side)] < 0) ++side;
  const DudeFlood flood = floodedPieces(mesh, {{0, side, 0, 0, 0.0, 0.0}});
  EXPECT_EQ(flood.count, 2);
  const Grid<std::int32_t> values = rasterised(mesh, flood);
  // The six cells on the diagonal have their middles on the cut: they go to the side of larger x.
  const auto cellsOf = [&](std::int32_t value) {
    return std::count(values.values().begin(), values.values().end(), value);
  };
  EXPECT_EQ(cellsOf(values.at({5, 2})), 21);
  EXPECT_EQ(cellsOf(values.at({0, 2})), 15);
  EXPECT_EQ(std::count(values.values().begin(), values.values().end(), -1), 0);
}

TEST(DudePieces, CrumbJoinsTheValueItTouchesMost) {
  Grid<std::int32_t> values({{0, 0}, {5, 3}}, 0);
  for (int x = 0; x < 5; ++x) values.at({x, 1}) = 1;
  values.at({2, 2}) = 1;
  values.at({4, 0}) = 1;
  for (const Cell& cell : {Cell{3, 2}, Cell{4, 2}}) values.at(cell) = -1;
  // Of value 0 the lower row is the larger part; the upper left corner is a crumb beside value 1.
  EXPECT_EQ(joinCrumbs(2, values), 2);
  EXPECT_EQ(values.at({0, 2}), 1);
  EXPECT_EQ(values.at({1, 2}), 1);
  EXPECT_EQ(values.at({0, 0}), 0);
}

TEST(DudePieces, CrumbWithoutANeighbourGetsAValueOfItsOwn) {
  Grid<std::int32_t> values({{0, 0}, {4, 1}}, 0);
  values.at({2, 0}) = -1;
  EXPECT_EQ(joinCrumbs(1, values), 2);
  EXPECT_EQ(values.values(), (std::vector<std::int32_t>{0, 0, -1, 1}));
}

}  // namespace
}  // namespace occusg
