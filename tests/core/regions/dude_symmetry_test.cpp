// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_symmetry.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "geometry/cell_outline.hpp"

namespace occusg {
namespace {

CellOutline lShape() {
  Grid<std::uint8_t> mask({{5, -3}, {9, 0}}, 1);
  mask.at({6, -1}) = 0;
  mask.at({7, -1}) = 0;
  mask.at({8, -1}) = 0;
  mask.at({6, -2}) = 0;
  return outlinesOf(mask).front();
}

TEST(DudeSymmetry, InverseBringsCornersAndCellsBack) {
  for (int number = 0; number < 8; ++number) {
    SCOPED_TRACE(number);
    const GridSymmetry symmetry = GridSymmetry(number).shifted({7, -11});
    EXPECT_EQ(symmetry.inverse().corner(symmetry.corner({3, 5})), (Cell{3, 5}));
    EXPECT_EQ(symmetry.inverse().cell(symmetry.cell({3, 5})), (Cell{3, 5}));
  }
}

TEST(DudeSymmetry, TheEightAreDifferent) {
  std::set<Cell> images;
  for (int number = 0; number < 8; ++number) images.insert(GridSymmetry(number).corner({2, 1}));
  EXPECT_EQ(images.size(), 8U);
}

TEST(DudeSymmetry, CellMovesWithTheSquareItCovers) {
  for (int number = 0; number < 8; ++number) {
    SCOPED_TRACE(number);
    const GridSymmetry symmetry(number);
    const CellBox image = symmetry.box({{4, 2}, {5, 3}});
    EXPECT_EQ(image.min, symmetry.cell({4, 2}));
    EXPECT_EQ(image.width(), 1);
    EXPECT_EQ(image.height(), 1);
  }
}

TEST(DudeSymmetry, ImagesOfOneOutlineHaveOneCanonicalImage) {
  const CellOutline outline = lShape();
  const CellOutline canonical = canonicalSymmetry(outline).outline(outline);
  for (int number = 0; number < 8; ++number) {
    SCOPED_TRACE(number);
    const CellOutline image = GridSymmetry(number).shifted({100, -40}).outline(outline);
    EXPECT_EQ(canonicalSymmetry(image).outline(image).outer, canonical.outer);
  }
}

TEST(DudeSymmetry, CanonicalImageStartsAtTheOrigin) {
  const CellOutline outline = lShape();
  const CellOutline canonical = canonicalSymmetry(outline).outline(outline);
  int min_x = 1;
  int min_y = 1;
  for (const Cell& corner : canonical.outer) {
    min_x = std::min(min_x, corner.x);
    min_y = std::min(min_y, corner.y);
  }
  EXPECT_EQ(min_x, 0);
  EXPECT_EQ(min_y, 0);
}

}  // namespace
}  // namespace occusg
