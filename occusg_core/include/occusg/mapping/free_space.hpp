// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "occusg/geometry/cell.hpp"
#include "occusg/geometry/tiled_grid.hpp"
#include "occusg/mapping/column_evidence.hpp"
#include "occusg/mapping/free_space_cells.hpp"

namespace occusg {

/// The 2D free-space layer.
struct FreeSpace {
  GridFrame frame;
  FreeSpaceCells cells;
  CellBox changed;  ///< Bounds of the cells that differ from the previous update's.
  TiledGrid<ColumnEvidence> evidence{};  ///< What the cells follow from; empty for a 2D map.
  CellBox gaps_changed{};  ///< Bounds of the cells whose gap or overhead differs likewise.
};

}  // namespace occusg
