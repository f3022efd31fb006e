// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "occusg/geometry/cell.hpp"

namespace occusg {

/// Dense values over a box of world-aligned cells, row-major from the lowest y up.
template <typename T>
class Grid {
 public:
  Grid() = default;
  Grid(const CellBox& box, const T& fill)
      : box_(box),
        values_(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()),
                fill) {}

  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] bool empty() const { return values_.empty(); }

  /// @pre box().contains(cell)
  [[nodiscard]] const T& at(const Cell& cell) const { return values_[index(cell)]; }
  [[nodiscard]] T& at(const Cell& cell) { return values_[index(cell)]; }

  /// The value at `cell`, or `outside` where the grid does not reach.
  [[nodiscard]] T valueOr(const Cell& cell, const T& outside) const {
    return box_.contains(cell) ? values_[index(cell)] : outside;
  }

  /// Enlarges the grid to cover `box` too; new cells hold `fill`, old ones keep their value.
  void cover(const CellBox& box, const T& fill) {
    const CellBox wanted = box_.including(box);
    if (wanted == box_) return;
    Grid larger(wanted, fill);
    for (int y = box_.min.y; y < box_.max.y; ++y) {
      const auto row = values_.begin() + static_cast<std::ptrdiff_t>(index({box_.min.x, y}));
      const auto place = static_cast<std::ptrdiff_t>(larger.index({box_.min.x, y}));
      std::move(row, row + box_.width(), larger.values_.begin() + place);
    }
    *this = std::move(larger);
  }

  /// Row-major values; the cell of values()[i] is box().min + (i % width, i / width).
  [[nodiscard]] const std::vector<T>& values() const { return values_; }
  [[nodiscard]] std::vector<T>& values() { return values_; }

  friend bool operator==(const Grid& a, const Grid& b) {
    return a.box_ == b.box_ && a.values_ == b.values_;
  }

 private:
  [[nodiscard]] std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }

  CellBox box_;
  std::vector<T> values_;
};

}  // namespace occusg
