// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <array>
#include <cstdint>

namespace occusg {

/// The voxels of a block of 8 x 8 x 8 that one more miss leaves as they are, because they stand at
/// the lower clamp; bits as in `VoxelBlock`.
/// @param code Morton code of the block.
[[nodiscard]] std::array<std::uint64_t, 8> settledFree(const octomap::OcTree& tree,
                                                       std::uint64_t code);

}  // namespace occusg
