// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "occusg/geometry/cell.hpp"
#include "occusg/graph/node.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// Which free cells are neighbours.
enum class CellNeighbours {
  kSides,           ///< Those that share a side. A diagonal step past free cells is two such steps.
  kSidesAndCorners  ///< Those that share a corner too, so a step may cut the corner of an obstacle.
};

/// The free cells of a square block of the lattice, by connected part.
class NavigationBlock {
 public:
  using Part = std::uint16_t;
  static constexpr Part kNoPart = 0;

  /// A node of the graph in the block.
  struct Site {
    NodeId node = 0;
    Part part = kNoPart;  ///< The part it stands in.
  };
  struct Extent {
    int cells = 0;
    Cell medoid;  ///< The cell of the part nearest to its mean; of equals the first, row-major.
  };

  NavigationBlock() = default;
  /// Reads the block at `index` in the lattice: its first cell is index * side_cells.
  NavigationBlock(const FreeSpace& layer, const Cell& index, int side_cells,
                  CellNeighbours neighbours);

  /// Whether the same cells are free.
  [[nodiscard]] bool hasSameCells(const NavigationBlock& other) const;
  [[nodiscard]] bool empty() const { return parts_.empty(); }
  [[nodiscard]] int freeCells() const;
  /// By part number less one.
  [[nodiscard]] const std::vector<Extent>& parts() const { return parts_; }
  /// @param x,y within the block, 0..side-1.
  [[nodiscard]] Part partAt(int x, int y) const;
  /// kNoPart when the cell is not free, or not of this block.
  [[nodiscard]] Part partAt(const Cell& cell) const;
  /// The part of the free cell nearest to `cell`, the first of equals; kNoPart when there is none.
  [[nodiscard]] Part partNearest(const Cell& cell) const;
  /// The free cell nearest to the middle of the block, the first of equals.
  /// @pre not empty.
  [[nodiscard]] Cell cellNearestToMiddle() const;
  /// How many cells `part` of `old` has in common with each part of this block, by part number.
  [[nodiscard]] std::vector<int> commonCells(const NavigationBlock& old, Part part) const;

  std::vector<Site> sites;  ///< By node.

 private:
  [[nodiscard]] std::size_t placeOf(int x, int y) const;
  Cell first_;
  int side_ = 0;
  std::vector<Part> labels_;  ///< Row-major.
  std::vector<Extent> parts_;

  void label(CellNeighbours neighbours);
  void measure();
};

/// Parts of `a` and of `b`, the block beside it by (dx, dy) in -1..1, that touch across the edge or
/// the corner they share.
[[nodiscard]] std::vector<std::pair<NavigationBlock::Part, NavigationBlock::Part>> contactsBetween(
    const NavigationBlock& a, const NavigationBlock& b, int dx, int dy, int side_cells,
    CellNeighbours neighbours);

}  // namespace occusg
