// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "occusg/geometry/cell.hpp"
#include "occusg/geometry/grid.hpp"

namespace occusg {

/// Side of the squares in which a `TiledGrid` takes memory.
inline constexpr int kTileSide_cells = 64;

/// Values of all cells there are, of which only those ever touched, and their tile, take memory.
/// Growing moves no value, so its cost follows what is new and not the map.
template <typename T>
class TiledGrid {
 public:
  /// @param fill the value of cells not touched.
  explicit TiledGrid(const T& fill = {}) : fill_(fill) {}

  [[nodiscard]] bool empty() const { return tiles_.empty(); }

  [[nodiscard]] const T& at(const Cell& cell) const {
    const Cell name = tileOf(cell);
    if (!directory_.box().contains(name)) return fill_;
    const std::int32_t tile = directory_.at(name);
    return tile == kNoTile ? fill_ : tiles_[static_cast<std::size_t>(tile)][placeOf(cell, name)];
  }

  /// For writing.
  [[nodiscard]] T& touch(const Cell& cell) {
    const Cell name = tileOf(cell);
    if (!directory_.box().contains(name))
      directory_.cover({name, {name.x + 1, name.y + 1}}, kNoTile);
    std::int32_t& tile = directory_.at(name);
    if (tile == kNoTile) {
      tile = static_cast<std::int32_t>(tiles_.size());
      tiles_.emplace_back(kTileCells, fill_);
    }
    return tiles_[static_cast<std::size_t>(tile)][placeOf(cell, name)];
  }

  /// Takes over the values of all cells of `values`.
  void assign(const Grid<T>& values) {
    forEachRun(values.box(), [&](const Cell& first, int count) {
      std::copy_n(&values.at(first), count, &touch(first));
    });
  }

  /// A copy of the values of a box.
  [[nodiscard]] Grid<T> dense(const CellBox& box) const {
    Grid<T> values(box, fill_);
    forEachRun(box, [&](const Cell& first, int count) {
      if (const T* run = runAt(first); run != nullptr) std::copy_n(run, count, &values.at(first));
    });
    return values;
  }

  /// Bounds of the cells of `box` whose value is another in `other`.
  [[nodiscard]] CellBox differingFrom(const TiledGrid& other, const CellBox& box) const {
    CellBox differing;
    forEachRun(box, [&](const Cell& first, int count) {
      const T* here = runAt(first);
      const T* there = other.runAt(first);
      const bool are_equal = here != nullptr && there != nullptr
                                 ? std::equal(here, here + count, there)
                                 : here == there && fill_ == other.fill_;
      if (are_equal) return;
      for (int i = 0; i < count; ++i) {
        const Cell cell{first.x + i, first.y};
        if (!(at(cell) == other.at(cell))) differing = differing.including(cell);
      }
    });
    return differing;
  }

  [[nodiscard]] std::size_t memoryBytes() const {
    return tiles_.size() * kTileCells * sizeof(T) +
           directory_.values().size() * sizeof(std::int32_t);
  }

  /// True when every cell has the same value in both.
  friend bool operator==(const TiledGrid& a, const TiledGrid& b) {
    return a.fill_ == b.fill_ && a.isContainedIn(b) && b.isContainedIn(a);
  }

 private:
  static constexpr std::int32_t kNoTile = -1;
  static constexpr std::size_t kTileCells =
      static_cast<std::size_t>(kTileSide_cells) * static_cast<std::size_t>(kTileSide_cells);

  static int floorOfTile(int cell) {
    return cell >= 0 ? cell / kTileSide_cells : -((kTileSide_cells - 1 - cell) / kTileSide_cells);
  }
  static Cell tileOf(const Cell& cell) { return {floorOfTile(cell.x), floorOfTile(cell.y)}; }
  static std::size_t placeOf(const Cell& cell, const Cell& tile) {
    const int y = cell.y - tile.y * kTileSide_cells;
    const int x = cell.x - tile.x * kTileSide_cells;
    return static_cast<std::size_t>(y) * kTileSide_cells + static_cast<std::size_t>(x);
  }

  /// Calls `visit(first cell, count)` for every piece of a row of `box` that lies in one tile.
  template <typename Visit>
  static void forEachRun(const CellBox& box, const Visit& visit) {
    for (int y = box.min.y; y < box.max.y; ++y) {
      for (int x = box.min.x; x < box.max.x;) {
        const int end = std::min(box.max.x, kTileSide_cells * (floorOfTile(x) + 1));
        visit(Cell{x, y}, end - x);
        x = end;
      }
    }
  }

  /// The value of `cell`, with those of the rest of its row in its tile behind it; null where no
  /// cell of the tile was touched.
  [[nodiscard]] const T* runAt(const Cell& cell) const {
    const Cell name = tileOf(cell);
    const std::int32_t tile = directory_.valueOr(name, kNoTile);
    return tile == kNoTile ? nullptr : &tiles_[static_cast<std::size_t>(tile)][placeOf(cell, name)];
  }

  /// True when `other` has the values of every touched tile.
  [[nodiscard]] bool isContainedIn(const TiledGrid& other) const {
    const CellBox& box = directory_.box();
    for (int y = box.min.y; y < box.max.y; ++y) {
      for (int x = box.min.x; x < box.max.x; ++x) {
        const std::int32_t tile = directory_.at({x, y});
        if (tile == kNoTile) continue;
        const std::vector<T>& values = tiles_[static_cast<std::size_t>(tile)];
        const std::int32_t there = other.directory_.valueOr({x, y}, kNoTile);
        for (std::size_t i = 0; i < kTileCells; ++i) {
          const T& value =
              there == kNoTile ? fill_ : other.tiles_[static_cast<std::size_t>(there)][i];
          if (!(values[i] == value)) return false;
        }
      }
    }
    return true;
  }

  T fill_;
  Grid<std::int32_t> directory_;  ///< Number of the tile, or kNoTile.
  std::vector<std::vector<T>> tiles_;
};

}  // namespace occusg
