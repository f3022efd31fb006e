// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/grid_reading.hpp"

#include <algorithm>
#include <cmath>

#include "occusg/error.hpp"
#include "occusg/mapping/free_space_cells.hpp"
#include "occusg_ros/shown_text.hpp"

namespace occusg_ros {
namespace {

CellValues decidedBy(const occusg::OccupancyThresholds& thresholds) {
  CellValues values{};
  for (std::size_t percent = 0; percent < values.size(); ++percent)
    values[percent] = occusg::decidedCell(static_cast<double>(percent), thresholds);
  return values;
}

occusg::OccupancyHistogram histogramOf(const std::vector<std::int8_t>& data) {
  occusg::OccupancyHistogram counts{};
  for (const std::int8_t value : data)
    if (value >= 0 && value <= occusg::kFullObstacle) ++counts[static_cast<std::size_t>(value)];
  return counts;
}

}  // namespace

CellValues unchangedValues() {
  CellValues values{};
  for (std::size_t percent = 0; percent < values.size(); ++percent)
    values[percent] = static_cast<std::int8_t>(percent);
  return values;
}

GridReading readingOf(const std::vector<std::int8_t>& data,
                      const occusg::OccupancyThresholds& thresholds) {
  if (thresholds.free_below > 0.0) return {decidedBy(thresholds), ""};
  const occusg::OccupancyHistogram counts = histogramOf(data);
  if (occusg::occupancyKind(counts) == occusg::OccupancyKind::kDecided) return {};
  const auto percent = static_cast<int>(std::lround(100.0 * occusg::shareBetween(counts)));
  return {decidedBy({50.0, 50.0}),
          std::to_string(percent) +
              " % of the known cells are neither 0 nor 100, so the map holds probabilities: "
              "cells below 50 count as free and above it as occupied; ~free_below_percent and "
              "~occupied_above_percent choose other thresholds"};
}

nav_msgs::OccupancyGrid updated(const nav_msgs::OccupancyGrid& grid,
                                const map_msgs::OccupancyGridUpdate& update,
                                const std::string& where) {
  if (update.header.frame_id != grid.header.frame_id) {
    throw occusg::refuse(where, "the part's frame is '" + shownName(update.header.frame_id) + "'",
                         "the map's is '" + shownName(grid.header.frame_id) + "'");
  }
  const std::uint64_t cells = std::uint64_t{update.width} * update.height;
  if (cells != update.data.size()) {
    throw occusg::refuse(where, "the part carries " + std::to_string(update.data.size()) + " cells",
                         "width times height is " + std::to_string(cells));
  }
  const bool inside = update.x >= 0 && update.y >= 0 &&
                      std::uint64_t(update.x) + update.width <= grid.info.width &&
                      std::uint64_t(update.y) + update.height <= grid.info.height;
  if (!inside) {
    throw occusg::refuse(where,
                         "the part of " + std::to_string(update.width) + " x " +
                             std::to_string(update.height) + " cells at " +
                             std::to_string(update.x) + ", " + std::to_string(update.y) +
                             " reaches outside",
                         "the map has " + std::to_string(grid.info.width) + " x " +
                             std::to_string(grid.info.height));
  }
  nav_msgs::OccupancyGrid result = grid;
  result.header.stamp = update.header.stamp;
  for (std::uint32_t row = 0; row < update.height; ++row) {
    const auto source =
        update.data.begin() + static_cast<std::ptrdiff_t>(std::size_t{row} * update.width);
    const std::size_t place = (static_cast<std::size_t>(update.y) + row) * grid.info.width +
                              static_cast<std::size_t>(update.x);
    std::copy(source, source + update.width,
              result.data.begin() + static_cast<std::ptrdiff_t>(place));
  }
  return result;
}

}  // namespace occusg_ros
