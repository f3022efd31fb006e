// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "occusg/geometry/grid.hpp"
#include "occusg/geometry/tiled_grid.hpp"
#include "occusg/mapping/column_evidence.hpp"

namespace occusg {

/// Values of a free-space cell, those of nav_msgs/OccupancyGrid: unknown, free, and 1..100 the
/// share to which an obstacle fills the free height beside it.
inline constexpr std::int8_t kUnknown = -1;
inline constexpr std::int8_t kFree = 0;
inline constexpr std::int8_t kFullObstacle = 100;

/// The 2D free-space layer.
struct FreeSpace {
  GridFrame frame;
  Grid<std::int8_t> cells;
  CellBox changed;  ///< Bounds of the cells that differ from the previous update's.
  TiledGrid<ColumnEvidence> evidence{};  ///< What the cells follow from; empty for a 2D map.
};

}  // namespace occusg
