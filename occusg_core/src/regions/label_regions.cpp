// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/label_regions.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "regions/cell_sums.hpp"
#include "regions/crossings.hpp"
#include "regions/small_pieces.hpp"

namespace occusg {
namespace {

/// Roots of provisional numbers; a root is the smallest number of its piece.
class PieceRoots {
 public:
  std::int32_t create() {
    parent_.push_back(static_cast<std::int32_t>(parent_.size()));
    return parent_.back();
  }

  [[nodiscard]] std::int32_t root(std::int32_t number) {
    while (parent_[number] != number) number = parent_[number] = parent_[parent_[number]];
    return number;
  }

  std::int32_t join(std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
    return low;
  }

  /// What every provisional number becomes: roots count up from 1, in their order.
  [[nodiscard]] std::vector<std::int32_t> numbers() {
    std::vector<std::int32_t> numbers(parent_.size(), kNoRegion);
    std::int32_t count = 0;
    for (std::size_t i = 1; i < parent_.size(); ++i) {
      const std::int32_t of = root(static_cast<std::int32_t>(i));
      numbers[i] = static_cast<std::size_t>(of) == i ? ++count : numbers[of];
    }
    return numbers;
  }

 private:
  std::vector<std::int32_t> parent_{kNoRegion};
};

std::vector<CellSums> sumsOf(const Grid<std::int32_t>& pieces) {
  std::vector<CellSums> sums(1);
  const CellBox& box = pieces.box();
  auto row = pieces.values().begin();
  for (int y = box.min.y; y < box.max.y; ++y, row += box.width()) {
    for (auto run = row; run != row + box.width();) {
      const std::int32_t piece = *run;
      const auto end =
          std::find_if(run, row + box.width(), [&](std::int32_t other) { return other != piece; });
      const auto i = static_cast<std::size_t>(piece);
      if (i >= sums.size()) sums.resize(i + 1);
      const int x = box.min.x + static_cast<int>(run - row);
      if (piece != kNoRegion) sums[i].addRun(x, x + static_cast<int>(end - run), y);
      run = end;
    }
  }
  return sums;
}

std::vector<SharedEdges> contactCounts(const Grid<std::int32_t>& pieces, std::size_t count) {
  std::vector<SharedEdges> contacts(count);
  const std::vector<std::int32_t>& piece = pieces.values();
  const auto width = static_cast<std::size_t>(pieces.box().width());
  const auto count_edge = [&](std::int32_t a, std::int32_t b) {
    if (a == b || a == kNoRegion || b == kNoRegion) return;
    ++contacts[a][b];
    ++contacts[b][a];
  };
  for (std::size_t row = 0; row < piece.size(); row += width) {
    for (std::size_t i = row; i < row + width; ++i) {
      if (i != row) count_edge(piece[i], piece[i - 1]);
      if (row != 0) count_edge(piece[i], piece[i - width]);
    }
  }
  return contacts;
}

}  // namespace

Grid<std::int32_t> numberedPieces(const Grid<std::int32_t>& labels) {
  Grid<std::int32_t> numbers(labels.box(), kNoRegion);
  const std::vector<std::int32_t>& label = labels.values();
  std::vector<std::int32_t>& number = numbers.values();
  const auto width = static_cast<std::size_t>(labels.box().width());
  PieceRoots roots;
  for (std::size_t row = 0; row < label.size(); row += width) {
    for (std::size_t i = row; i < row + width; ++i) {
      if (label[i] == kNoRegion) continue;
      const bool joins_left = i != row && label[i - 1] == label[i];
      const bool joins_below = row != 0 && label[i - width] == label[i];
      if (joins_left && joins_below && number[i - 1] != number[i - width]) {
        number[i] = roots.join(number[i - 1], number[i - width]);
      } else if (joins_left || joins_below) {
        number[i] = number[joins_left ? i - 1 : i - width];
      } else {
        number[i] = roots.create();
      }
    }
  }
  const std::vector<std::int32_t> final_numbers = roots.numbers();
  for (std::int32_t& value : number) value = final_numbers[value];
  return numbers;
}

Grid<std::int32_t> withoutSmallPieces(const Grid<std::int32_t>& labels, std::size_t min_cells) {
  Grid<std::int32_t> pieces = numberedPieces(labels);
  const auto limit = static_cast<std::int64_t>(min_cells);
  std::vector<std::int64_t> cells;
  for (const CellSums& sums : sumsOf(pieces)) cells.push_back(sums.count);
  if (std::all_of(cells.begin() + 1, cells.end(), [&](auto count) { return count >= limit; }))
    return pieces;
  std::vector<SharedEdges> shared = contactCounts(pieces, cells.size());
  const std::vector<std::int32_t> heir =
      heirsOfSmallPieces(std::move(cells), std::move(shared), limit);
  std::vector<std::int32_t> number(heir.size(), kNoRegion);
  std::int32_t count = 0;
  for (std::int32_t& piece : pieces.values()) {
    const std::int32_t into = heir[piece];
    if (into != kNoRegion && number[into] == kNoRegion) number[into] = ++count;
    piece = number[into];
  }
  return pieces;
}

Decomposition decompositionOf(const Grid<std::int32_t>& labels, const GridFrame& frame,
                              double min_crossing_m) {
  Decomposition result;
  result.frame = frame;
  result.labels = numberedPieces(labels);
  const std::vector<CellSums> sums = sumsOf(result.labels);
  result.regions.reserve(sums.size() - 1);
  for (std::size_t i = 1; i < sums.size(); ++i) {
    const auto id = static_cast<int>(i);
    result.regions.push_back(regionOf(result.labels, id, id, frame, sums[i]));
  }
  result.crossings = crossingsOf(result.labels, frame, min_crossing_m);
  nameNeighbours(result.crossings, result.regions);
  return result;
}

}  // namespace occusg
