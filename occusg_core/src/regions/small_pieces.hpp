// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace occusg {

/// How many cell edges a piece shares with every piece beside it.
using SharedEdges = std::map<std::int32_t, std::int64_t>;

/// What becomes of pieces of free space: each of fewer than `min_cells` cells, smallest first,
/// joins the neighbour it shares most edges with (ties: the lower number).
/// @param cells by piece; number 0 stands for no piece.
/// @param shared by piece, symmetrical.
/// @return by piece: itself, the piece that has it in the end, or kNoRegion: nothing is beside it.
[[nodiscard]] std::vector<std::int32_t> heirsOfSmallPieces(std::vector<std::int64_t> cells,
                                                           std::vector<SharedEdges> shared,
                                                           std::int64_t min_cells);

}  // namespace occusg
