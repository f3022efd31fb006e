// SPDX-License-Identifier: BSD-3-Clause
#include "regions/straight_cuts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <utility>

#include "occusg/regions/label_regions.hpp"
#include "occusg/regions/region.hpp"
#include "regions/cell_walks.hpp"

namespace occusg {
namespace {

constexpr std::int32_t kUndecided = -1;

/// Marks the open cells on the line between the jambs as undecided. Consecutive cells of the line
/// touch at least at a corner, which no 4-connected way gets through.
void draw(const PassageCut& cut, const Clearance& clearance, Grid<std::int32_t>& labels) {
  const Cell span{cut.jamb_b.x - cut.jamb_a.x, cut.jamb_b.y - cut.jamb_a.y};
  const int steps = std::max(std::abs(span.x), std::abs(span.y));
  const auto share = [&](int length, int step) {  // Rounded half up, whatever the sign.
    const std::int64_t twice = 2 * std::int64_t{length} * step + steps;
    const std::int64_t whole = 2 * std::int64_t{steps};
    return static_cast<int>((twice >= 0 ? twice : twice - whole + 1) / whole);
  };
  for (int step = 1; step < steps; ++step) {
    const Cell cell{cut.jamb_a.x + share(span.x, step), cut.jamb_a.y + share(span.y, step)};
    if (clearance.open.valueOr(cell, 0) != 0) labels.at(cell) = kUndecided;
  }
}

/// By basin: the piece its deepest cell lies in (kNoRegion: under a cut).
std::vector<std::int32_t> homesOf(const Grid<std::int32_t>& basins, const Clearance& clearance,
                                  const Grid<std::int32_t>& pieces) {
  std::vector<std::int32_t> home;
  std::vector<std::int32_t> depth;
  for (std::size_t i = 0; i < basins.values().size(); ++i) {
    const auto basin = static_cast<std::size_t>(basins.values()[i]);
    if (basin >= home.size()) {
      home.resize(basin + 1, kNoRegion);
      depth.resize(basin + 1, -1);
    }
    if (basin == kNoRegion || clearance.squared.values()[i] <= depth[basin]) continue;
    depth[basin] = clearance.squared.values()[i];
    home[basin] = pieces.values()[i];
  }
  return home;
}

/// By piece: the only basin at home there, kUndecided when there are more, else the basin with
/// most cells in it.
std::vector<std::int32_t> ownersOf(const Grid<std::int32_t>& basins,
                                   const std::vector<std::int32_t>& home,
                                   const Grid<std::int32_t>& pieces) {
  const std::int32_t count = *std::max_element(pieces.values().begin(), pieces.values().end());
  std::vector<std::int32_t> owner(static_cast<std::size_t>(count) + 1, kNoRegion);
  for (std::size_t basin = 1; basin < home.size(); ++basin) {
    std::int32_t& of_home = owner[home[basin]];
    of_home = of_home == kNoRegion ? static_cast<std::int32_t>(basin) : kUndecided;
  }
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> guests;
  for (std::size_t i = 0; i < basins.values().size(); ++i) {
    const std::int32_t piece = pieces.values()[i];
    if (piece != kNoRegion && owner[piece] == kNoRegion) ++guests[{piece, basins.values()[i]}];
  }
  std::vector<std::size_t> most(owner.size(), 0);
  for (const auto& [guest, cells] : guests) {
    if (cells <= most[guest.first]) continue;
    most[guest.first] = cells;
    owner[guest.first] = guest.second;
  }
  return owner;
}

/// Gives undecided cells, ring by ring, the smallest label beside them.
void decideFromBeside(Grid<std::int32_t>& labels, std::vector<Cell> undecided) {
  while (!undecided.empty()) {
    std::vector<std::pair<Cell, std::int32_t>> decided;
    std::vector<Cell> left;
    for (const Cell& cell : undecided) {
      std::int32_t smallest = kNoRegion;
      for (const Cell& side : sideNeighbours(cell)) {
        const std::int32_t label = labels.valueOr(side, kNoRegion);
        if (label > kNoRegion && (smallest == kNoRegion || label < smallest)) smallest = label;
      }
      if (smallest == kNoRegion) {
        left.push_back(cell);
      } else {
        decided.emplace_back(cell, smallest);
      }
    }
    if (decided.empty()) return;
    for (const auto& [cell, label] : decided) labels.at(cell) = label;
    undecided = std::move(left);
  }
}

}  // namespace

Grid<std::int32_t> straightened(const Clearance& clearance, const Grid<std::int32_t>& basins,
                                const std::vector<PassageCut>& cuts) {
  if (cuts.empty()) return basins;
  Grid<std::int32_t> pieces(basins.box(), kNoRegion);
  for (std::size_t i = 0; i < basins.values().size(); ++i)
    pieces.values()[i] = basins.values()[i] == kNoRegion ? kNoRegion : 1;
  for (const PassageCut& cut : cuts) draw(cut, clearance, pieces);
  for (std::int32_t& piece : pieces.values()) piece = std::max(piece, kNoRegion);
  pieces = numberedPieces(pieces);
  const std::vector<std::int32_t> home = homesOf(basins, clearance, pieces);
  const std::vector<std::int32_t> owner = ownersOf(basins, home, pieces);

  Grid<std::int32_t> labels(basins.box(), kNoRegion);
  std::vector<Cell> undecided;
  const CellBox& box = basins.box();
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Cell cell{x, y};
      const std::int32_t basin = basins.at(cell);
      if (basin == kNoRegion) continue;
      const std::int32_t piece = pieces.at(cell);
      const bool is_shared = piece != kNoRegion && owner[piece] == kUndecided;
      if (is_shared) {
        labels.at(cell) = home[basin] == piece ? basin : kNoRegion;
      } else if (piece != kNoRegion) {
        labels.at(cell) = owner[piece];
      }
      if (labels.at(cell) == kNoRegion) undecided.push_back(cell);
    }
  }
  decideFromBeside(labels, std::move(undecided));
  return labels;
}

}  // namespace occusg
