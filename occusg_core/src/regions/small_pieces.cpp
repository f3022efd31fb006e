// SPDX-License-Identifier: BSD-3-Clause
#include "regions/small_pieces.hpp"

#include <cstddef>
#include <set>
#include <utility>

#include "occusg/regions/region.hpp"

namespace occusg {
namespace {

/// The neighbour with most shared edges; the lower number on a tie.
std::int32_t widestNeighbour(const SharedEdges& shared) {
  std::int32_t widest = kNoRegion;
  std::int64_t edges = 0;
  for (const auto& [neighbour, count] : shared) {
    if (count <= edges) continue;
    widest = neighbour;
    edges = count;
  }
  return widest;
}

}  // namespace

std::vector<std::int32_t> heirsOfSmallPieces(std::vector<std::int64_t> cells,
                                             std::vector<SharedEdges> shared,
                                             std::int64_t min_cells) {
  std::vector<std::int32_t> heir(cells.size());
  std::set<std::pair<std::int64_t, std::int32_t>> small;
  for (std::size_t piece = 1; piece < cells.size(); ++piece) {
    heir[piece] = static_cast<std::int32_t>(piece);
    if (cells[piece] < min_cells) small.emplace(cells[piece], heir[piece]);
  }
  while (!small.empty()) {
    const std::int32_t piece = small.begin()->second;
    small.erase(small.begin());
    const std::int32_t into = widestNeighbour(shared[piece]);
    heir[piece] = into;
    if (into == kNoRegion) continue;
    small.erase({cells[into], into});
    cells[into] += cells[piece];
    if (cells[into] < min_cells) small.emplace(cells[into], into);
    for (const auto& [neighbour, count] : shared[piece]) {
      shared[neighbour].erase(piece);
      if (neighbour == into) continue;
      shared[neighbour][into] += count;
      shared[into][neighbour] += count;
    }
  }
  // A piece may have joined one that later joined another.
  for (std::int32_t& into : heir)
    while (heir[into] != into) into = heir[into];
  return heir;
}

}  // namespace occusg
