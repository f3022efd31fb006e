// SPDX-License-Identifier: BSD-3-Clause
#include "regions/outside.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "occusg/regions/region.hpp"
#include "regions/cell_walks.hpp"
#include "regions/squared_distance.hpp"

namespace occusg {
namespace {

/// Paper around a drawn plan holds more than this share of the picture's rim.
constexpr double kRimShare = 0.5;
/// A frontier is ragged when it is longer than the outline of a rectangle of the region's area that
/// is four times as long as wide, which is so many sides of a square of that area.
constexpr double kRaggedness = 5.0;

/// A region's border, in cell edges; crossings to other regions are left out.
struct Border {
  std::size_t cells = 0;
  std::size_t wall = 0;
  std::size_t frontier = 0;
  std::size_t rim_cells = 0;  ///< Of the grid's rim.

  [[nodiscard]] std::size_t length() const { return wall + frontier; }
  [[nodiscard]] double wallShare() const {
    return length() == 0 ? 1.0 : static_cast<double>(wall) / static_cast<double>(length());
  }
};

/// Squared distance of every cell to the nearest obstacle, as far as `reach_cells` matters.
Grid<std::int32_t> squaredDistancesToObstacles(const Grid<std::int8_t>& cells, double reach_cells) {
  // What lies outside the grid counts as closed, so it must be farther away than the reach.
  const int margin = static_cast<int>(std::ceil(reach_cells)) + 1;
  Grid<std::uint8_t> open(cells.box().grown(margin), 1);
  const CellBox& box = cells.box();
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x)
      if (cells.at({x, y}) > kFree) open.at({x, y}) = 0;
  }
  return squaredDistances(open);
}

bool isOnRim(const Cell& cell, const CellBox& box) {
  return cell.x == box.min.x || cell.y == box.min.y || cell.x == box.max.x - 1 ||
         cell.y == box.max.y - 1;
}

std::vector<Border> bordersOf(const Grid<std::int8_t>& cells, double wall_reach_cells,
                              const Grid<std::int32_t>& labels) {
  const Grid<std::int32_t> to_wall = squaredDistancesToObstacles(cells, wall_reach_cells);
  const auto reach = static_cast<std::int32_t>(wall_reach_cells * wall_reach_cells);
  const auto most = std::max_element(labels.values().begin(), labels.values().end());
  std::vector<Border> borders(static_cast<std::size_t>(*most) + 1);
  const CellBox box = labels.box().intersected(cells.box());
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const std::int32_t label = labels.at({x, y});
      if (label == kNoRegion) continue;
      Border& border = borders[static_cast<std::size_t>(label)];
      ++border.cells;
      border.rim_cells += isOnRim({x, y}, cells.box()) ? 1 : 0;
      for (const Cell& beside : sideNeighbours({x, y})) {
        if (labels.valueOr(beside, kNoRegion) != kNoRegion) continue;
        if (cells.valueOr(beside, kUnknown) == kFree) continue;
        ++(to_wall.at({x, y}) <= reach ? border.wall : border.frontier);
      }
    }
  }
  return borders;
}

/// Rays make a frontier ragged. Rooms whose walls a map does not draw have a shorter one.
bool isRagged(const Border& border) {
  return static_cast<double>(border.frontier) >
         kRaggedness * std::sqrt(static_cast<double>(border.cells));
}

/// The share of wall that half of all cells have at least in their region.
double usualShare(const std::vector<Border>& borders) {
  std::vector<std::pair<double, std::size_t>> shares;
  std::size_t cells = 0;
  for (const Border& border : borders) {
    if (border.length() == 0) continue;
    shares.emplace_back(border.wallShare(), border.cells);
    cells += border.cells;
  }
  std::sort(shares.begin(), shares.end());
  std::size_t passed = 0;
  for (const auto& [share, count] : shares) {
    passed += count;
    if (2 * passed >= cells) return share;
  }
  return 0.0;
}

void unlabel(const std::vector<char>& goes, Grid<std::int32_t>& labels) {
  for (std::int32_t& label : labels.values())
    if (goes[static_cast<std::size_t>(label)] != 0) label = kNoRegion;
}

}  // namespace

void removeNarrow(const Grid<std::int32_t>& squared, double min_width_cells,
                  Grid<std::int32_t>& labels) {
  if (labels.empty()) return;
  const auto most = std::max_element(labels.values().begin(), labels.values().end());
  std::vector<std::int32_t> deepest(static_cast<std::size_t>(*most) + 1, 0);
  const CellBox& box = labels.box();
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      std::int32_t& depth = deepest[static_cast<std::size_t>(labels.at({x, y}))];
      depth = std::max(depth, squared.valueOr({x, y}, 0));
    }
  }
  std::vector<char> goes(deepest.size(), 0);
  for (std::size_t label = 1; label < deepest.size(); ++label)
    goes[label] = 2.0 * std::sqrt(deepest[label]) < min_width_cells ? 1 : 0;
  unlabel(goes, labels);
}

void removeOutside(const Grid<std::int8_t>& cells, const EnclosureRules& rules,
                   Grid<std::int32_t>& labels) {
  if (labels.empty()) return;
  const std::vector<Border> borders = bordersOf(cells, rules.wall_reach_cells, labels);
  const double least_share = rules.min_share * usualShare(borders);
  const auto regions = std::count_if(borders.begin() + 1, borders.end(),
                                     [](const Border& border) { return border.cells > 0; });
  const int width = cells.box().width();
  const int height = cells.box().height();
  const double rim_cells = 2.0 * (width + height) - 4.0;
  std::vector<char> goes(borders.size(), 0);
  for (std::size_t label = 1; label < borders.size(); ++label) {
    const Border& border = borders[label];
    const bool is_paper =
        regions > 1 && static_cast<double>(border.rim_cells) > kRimShare * rim_cells;
    const bool is_fan = border.wallShare() < least_share && isRagged(border);
    goes[label] = is_paper || is_fan ? 1 : 0;
  }
  unlabel(goes, labels);
}

}  // namespace occusg
