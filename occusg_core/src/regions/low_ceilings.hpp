// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/geometry/cell.hpp"

namespace occusg {

/// The inner cells of rooms whose whole ceiling is as low as a lintel, in row-major order.
///
/// A lintel, a beam or a pipe is narrow; where a disc of 1.5 m finds room under what hangs
/// overhead, it is a ceiling. The cells given are those of such discs without an outermost ring, so
/// that a strip like a lintel stays between the room and whatever is around it.
/// @param cells a 4-connected set of free cells under lintels, within `bounds`.
/// @param resolution_m side of a cell [m].
[[nodiscard]] std::vector<Cell> cellsUnderLowCeilings(const std::vector<Cell>& cells,
                                                      const CellBox& bounds, double resolution_m);

}  // namespace occusg
