// SPDX-License-Identifier: BSD-3-Clause
#include "regions/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "regions/squared_distance.hpp"

namespace occusg {
namespace {

/// An island longer than so many sides of a square of its area is a wall: freestanding pieces of
/// wall between two doors stay, tables go.
constexpr double kLongestIslandSides = 3.0;

/// The values of `grid` as an image, not copied.
cv::Mat imageOf(Grid<std::uint8_t>& grid) {
  return {grid.box().height(), grid.box().width(), CV_8U, grid.values().data()};
}

CellBox freeBounds(const Grid<std::int8_t>& layer) {
  const CellBox& box = layer.box();
  CellBox bounds;
  auto row = layer.values().begin();
  for (int y = box.min.y; y < box.max.y; ++y, row += box.width()) {
    const auto first = std::find(row, row + box.width(), kFree);
    if (first == row + box.width()) continue;
    auto end = row + box.width();
    while (*(end - 1) != kFree) --end;
    bounds = bounds.including(CellBox{{box.min.x + static_cast<int>(first - row), y},
                                      {box.min.x + static_cast<int>(end - row), y + 1}});
  }
  return bounds;
}

Grid<std::uint8_t> freeCells(const Grid<std::int8_t>& layer) {
  const CellBox box = freeBounds(layer);
  Grid<std::uint8_t> open(box.grown(1), 0);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) open.at({x, y}) = layer.at({x, y}) == kFree ? 1 : 0;
  return open;
}

/// The cells of `bounds` that component `label` encloses, its own included.
std::vector<cv::Point> enclosedBy(const cv::Mat& components, int label, const cv::Rect& bounds) {
  // One cell of margin makes everything outside the component one 4-connected piece.
  cv::Mat inside(bounds.height + 2, bounds.width + 2, CV_8U, cv::Scalar(0));
  const cv::Rect inner(1, 1, bounds.width, bounds.height);
  inside(inner).setTo(1, components(bounds) == label);
  cv::floodFill(inside, {0, 0}, 2, nullptr, {}, {}, 4);
  std::vector<cv::Point> cells;
  cv::findNonZero(inside(inner) != 2, cells);
  for (cv::Point& cell : cells) cell += bounds.tl();
  return cells;
}

void fillIslands(Clearance& clearance, std::size_t max_island_cells) {
  const cv::Mat open = imageOf(clearance.open);
  cv::Mat components;
  cv::Mat stats;
  cv::Mat centroids;
  const int count =
      cv::connectedComponentsWithStats(open == 0, components, stats, centroids, 8, CV_32S);
  const int outside = components.at<int>(0, 0);
  const double longest = kLongestIslandSides * std::sqrt(static_cast<double>(max_island_cells));
  const int width = open.cols;
  for (int label = 1; label < count; ++label) {
    const int* stat = stats.ptr<int>(label);
    const cv::Rect bounds(stat[cv::CC_STAT_LEFT], stat[cv::CC_STAT_TOP], stat[cv::CC_STAT_WIDTH],
                          stat[cv::CC_STAT_HEIGHT]);
    const double length = std::hypot(bounds.width, bounds.height);
    if (label == outside || length > longest) continue;
    if (static_cast<std::size_t>(stat[cv::CC_STAT_AREA]) > max_island_cells) continue;
    const std::vector<cv::Point> cells = enclosedBy(components, label, bounds);
    if (cells.size() > max_island_cells) continue;
    const auto enclosed = static_cast<double>(cells.size());
    if (length > kLongestIslandSides * std::sqrt(enclosed)) continue;
    ++clearance.island_count;
    for (const cv::Point& cell : cells) {
      const std::size_t i = static_cast<std::size_t>(cell.y) * width + cell.x;
      clearance.open.values()[i] = 1;
      clearance.islands.values()[i] = clearance.island_count;
    }
  }
}

}  // namespace

Clearance clearanceOf(const Grid<std::int8_t>& layer, std::size_t max_island_cells) {
  Clearance clearance;
  clearance.open = freeCells(layer);
  if (clearance.open.empty()) return clearance;
  clearance.islands = Grid<std::int32_t>(clearance.open.box(), 0);
  if (max_island_cells > 0) fillIslands(clearance, max_island_cells);
  clearance.squared = squaredDistances(clearance.open);
  return clearance;
}

}  // namespace occusg
