// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/label_regions.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "geometry/cell_outline.hpp"
#include "regions/contacts.hpp"

namespace occusg {
namespace {

/// Cell sums, exact in integers, so that a region's numbers do not depend on the order of cells.
struct CellSums {
  std::int64_t count = 0;
  std::int64_t x = 0;
  std::int64_t y = 0;
  CellBox bounds;
};

using Contacts = std::map<std::int32_t, std::int64_t>;  ///< Shared cell edges by neighbour.

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

/// Adds the cells [x_begin, x_end) of row y.
void addRun(int x_begin, int x_end, int y, CellSums& sum) {
  const std::int64_t length = x_end - x_begin;
  sum.count += length;
  sum.x += length * (std::int64_t{x_begin} + x_end - 1) / 2;
  sum.y += length * y;
  sum.bounds = sum.bounds.including(CellBox{{x_begin, y}, {x_end, y + 1}});
}

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
      if (piece != kNoRegion) addRun(x, x + static_cast<int>(end - run), y, sums[i]);
      run = end;
    }
  }
  return sums;
}

std::vector<Contacts> contactCounts(const Grid<std::int32_t>& pieces, std::size_t count) {
  std::vector<Contacts> contacts(count);
  const std::vector<std::int32_t>& piece = pieces.values();
  const auto width = static_cast<std::size_t>(pieces.box().width());
  const auto count_edge = [&](std::int32_t a, std::int32_t b) {
    if (a == b || a == kNoRegion || b == kNoRegion) return;
    ++contacts[a][b];
    ++contacts[b][a];
  };
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (i % width != 0) count_edge(piece[i], piece[i - 1]);
    if (i >= width) count_edge(piece[i], piece[i - width]);
  }
  return contacts;
}

/// The neighbour with most shared edges; the lower number on a tie.
std::int32_t widestNeighbour(const Contacts& contacts) {
  std::int32_t widest = kNoRegion;
  std::int64_t edges = 0;
  for (const auto& [neighbour, shared] : contacts) {
    if (shared <= edges) continue;
    widest = neighbour;
    edges = shared;
  }
  return widest;
}

/// What becomes of every piece: itself, the piece it joins (directly), or kNoRegion.
std::vector<std::int32_t> joinSmall(std::vector<CellSums>& sums, std::vector<Contacts>& contacts,
                                    std::size_t min_cells) {
  std::vector<std::int32_t> heir(sums.size());
  std::set<std::pair<std::int64_t, std::int32_t>> small;
  const auto limit = static_cast<std::int64_t>(min_cells);
  for (std::size_t piece = 1; piece < sums.size(); ++piece) {
    heir[piece] = static_cast<std::int32_t>(piece);
    if (sums[piece].count < limit) small.emplace(sums[piece].count, heir[piece]);
  }
  while (!small.empty()) {
    const std::int32_t piece = small.begin()->second;
    small.erase(small.begin());
    const std::int32_t into = widestNeighbour(contacts[piece]);
    heir[piece] = into;
    if (into == kNoRegion) continue;
    small.erase({sums[into].count, into});
    sums[into].count += sums[piece].count;
    if (sums[into].count < limit) small.emplace(sums[into].count, into);
    for (const auto& [neighbour, shared] : contacts[piece]) {
      contacts[neighbour].erase(piece);
      if (neighbour == into) continue;
      contacts[neighbour][into] += shared;
      contacts[into][neighbour] += shared;
    }
  }
  return heir;
}

Region regionOf(const Grid<std::int32_t>& pieces, const GridFrame& frame, int id,
                const CellSums& sum) {
  Region region;
  region.id = id;
  region.polygon = toPolygon(outlinesOf(pieces, id, sum.bounds).front(), frame);
  region.area_m2 = static_cast<double>(sum.count) * frame.cellArea();
  const auto count = static_cast<double>(sum.count);
  region.centroid = {(static_cast<double>(sum.x) / count + 0.5) * frame.resolution_m,
                     (static_cast<double>(sum.y) / count + 0.5) * frame.resolution_m};
  region.cells = sum.bounds;
  return region;
}

std::vector<Crossing> crossingsOf(const Grid<std::int32_t>& pieces, const GridFrame& frame,
                                  double min_crossing_m) {
  // Inclusive whatever the rounding of the ends' metres.
  const double limit_m = min_crossing_m - 1e-3 * frame.resolution_m;
  std::vector<Crossing> crossings;
  for (const Contact& contact : contactsOf(pieces)) {
    const Segment2 segment{frame.corner(contact.from), frame.corner(contact.to)};
    if (length(segment) < limit_m) continue;
    crossings.push_back({contact.label_a, contact.label_b, segment});
  }
  return crossings;
}

}  // namespace

Grid<std::int32_t> numberedPieces(const Grid<std::int32_t>& labels) {
  Grid<std::int32_t> numbers(labels.box(), kNoRegion);
  const std::vector<std::int32_t>& label = labels.values();
  std::vector<std::int32_t>& number = numbers.values();
  const auto width = static_cast<std::size_t>(labels.box().width());
  PieceRoots roots;
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (label[i] == kNoRegion) continue;
    const bool joins_left = i % width != 0 && label[i - 1] == label[i];
    const bool joins_below = i >= width && label[i - width] == label[i];
    if (joins_left && joins_below && number[i - 1] != number[i - width]) {
      number[i] = roots.join(number[i - 1], number[i - width]);
    } else if (joins_left || joins_below) {
      number[i] = number[joins_left ? i - 1 : i - width];
    } else {
      number[i] = roots.create();
    }
  }
  const std::vector<std::int32_t> final_numbers = roots.numbers();
  for (std::int32_t& value : number) value = final_numbers[value];
  return numbers;
}

Grid<std::int32_t> withoutSmallPieces(const Grid<std::int32_t>& labels, std::size_t min_cells) {
  Grid<std::int32_t> pieces = numberedPieces(labels);
  std::vector<CellSums> sums = sumsOf(pieces);
  std::vector<Contacts> contacts = contactCounts(pieces, sums.size());
  std::vector<std::int32_t> heir = joinSmall(sums, contacts, min_cells);
  // A piece may have joined one that later joined another.
  for (std::int32_t& into : heir)
    while (heir[into] != into) into = heir[into];
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
  for (std::size_t id = 1; id < sums.size(); ++id)
    result.regions.push_back(regionOf(result.labels, frame, static_cast<int>(id), sums[id]));
  result.crossings = crossingsOf(result.labels, frame, min_crossing_m);
  for (const Crossing& crossing : result.crossings) {
    result.regions[crossing.region_a - 1].adjacent.push_back(crossing.region_b);
    result.regions[crossing.region_b - 1].adjacent.push_back(crossing.region_a);
  }
  for (Region& region : result.regions) {
    std::sort(region.adjacent.begin(), region.adjacent.end());
    region.adjacent.erase(std::unique(region.adjacent.begin(), region.adjacent.end()),
                          region.adjacent.end());
  }
  return result;
}

}  // namespace occusg
