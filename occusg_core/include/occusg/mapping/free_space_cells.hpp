// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "occusg/geometry/tiled_grid.hpp"

namespace occusg {

/// Values of a free-space cell, those of nav_msgs/OccupancyGrid: unknown, free, and 1..100 the
/// share to which an obstacle fills the free height beside it.
inline constexpr std::int8_t kUnknown = -1;
inline constexpr std::int8_t kFree = 0;
inline constexpr std::int8_t kFullObstacle = 100;

/// The values of all cells of a box. They are kept in tiles: a box that grows moves no value, so
/// its cost follows what is new and not the map. What reads most of a map reads it from `dense`.
class FreeSpaceCells {
 public:
  FreeSpaceCells() = default;
  FreeSpaceCells(const CellBox& box, std::int8_t value)
      : FreeSpaceCells(Grid<std::int8_t>(box, value)) {}
  explicit FreeSpaceCells(const Grid<std::int8_t>& values);

  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] bool empty() const { return box_.empty(); }
  /// Number of cells in the box.
  [[nodiscard]] std::size_t size() const;

  /// @pre box().contains(cell)
  [[nodiscard]] std::int8_t at(const Cell& cell) const { return tiles_.at(cell); }
  [[nodiscard]] std::int8_t& at(const Cell& cell) { return tiles_.touch(cell); }

  /// The value at `cell`, or `outside` where the box does not reach.
  [[nodiscard]] std::int8_t valueOr(const Cell& cell, std::int8_t outside) const {
    return box_.contains(cell) ? tiles_.at(cell) : outside;
  }

  /// Enlarges the box to hold `box` too; new cells are unknown.
  void cover(const CellBox& box) { box_ = box_.including(box); }

  /// A copy in which rows lie one after the other.
  [[nodiscard]] Grid<std::int8_t> dense() const { return tiles_.dense(box_); }
  /// @pre `box` lies in box().
  [[nodiscard]] Grid<std::int8_t> dense(const CellBox& box) const { return tiles_.dense(box); }

  /// Bounds of the cells whose value is another in `other`; beyond a box all cells are unknown.
  [[nodiscard]] CellBox differingFrom(const FreeSpaceCells& other) const {
    return tiles_.differingFrom(other.tiles_, box_.including(other.box_));
  }

  [[nodiscard]] std::size_t memoryBytes() const { return tiles_.memoryBytes(); }

  friend bool operator==(const FreeSpaceCells& a, const FreeSpaceCells& b) {
    return a.box_ == b.box_ && a.tiles_ == b.tiles_;
  }

 private:
  CellBox box_;
  TiledGrid<std::int8_t> tiles_{kUnknown};  ///< Unknown beyond the box.
};

}  // namespace occusg
