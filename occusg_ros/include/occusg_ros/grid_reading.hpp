// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "occusg/mapping/occupancy_thresholds.hpp"

namespace occusg_ros {

/// What the values 0..100 of a grid mean to a free-space layer.
using CellValues = std::array<std::int8_t, 101>;

/// The values as they are: 0 free, 1..100 obstacle to that degree.
[[nodiscard]] CellValues unchangedValues();

/// How the values of a grid are meant.
struct GridReading {
  CellValues values = unchangedValues();
  std::string assumption;  ///< What the grid leaves open and was assumed; empty when nothing was.
};

/// The values decided by given thresholds, or, when `thresholds.free_below` is 0, found out: a grid
/// of probabilities
/// (`occusg::occupancyKind`) is free below and occupied above 50, another one is read as it is.
[[nodiscard]] GridReading readingOf(const std::vector<std::int8_t>& data,
                                    const occusg::OccupancyThresholds& thresholds);

/// The grid after a part of it has changed, as costmap_2d, move_base and explore_lite publish it.
/// The stamp is the update's.
/// @throws occusg::Error when the part does not lie in the grid, has another number of cells than
/// it says, or another frame.
[[nodiscard]] nav_msgs::OccupancyGrid updated(const nav_msgs::OccupancyGrid& grid,
                                              const map_msgs::OccupancyGridUpdate& update,
                                              const std::string& where);

}  // namespace occusg_ros
