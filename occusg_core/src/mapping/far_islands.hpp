// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstddef>
#include <string>

#include "occusg/mapping/occupancy_map.hpp"

namespace occusg {

/// When the map spans more columns than a layer may have (`kMaxLayerCells`), removes what a pose
/// that jumped left far away: the largest part stays, and the others, the larger first, as long as
/// all that stay together fit. A map that fits is untouched. One whose largest part alone is too
/// large keeps that part.
FarIslands removeFarIslands(octomap::OcTree& tree);

}  // namespace occusg
