// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstddef>
#include <string>

namespace occusg {

/// Parts that were cut off a map because it spanned more than a free-space layer can.
struct FarIslands {
  std::size_t islands = 0;  ///< Parts with nothing known between them and the others.
  std::size_t nodes = 0;    ///< Nodes of the tree that went with them.
  double farthest_m = 0.0;  ///< Largest distance of one of them from what was kept, along an axis.

  [[nodiscard]] bool none() const { return islands == 0; }
};

/// When the map spans more columns than a layer may have (`kMaxLayerCells`), removes what a pose
/// that jumped left far away: the largest part stays, and the others, the larger first, as long as
/// all that stay together fit. A map that fits is untouched. One whose largest part alone is too
/// large keeps that part.
FarIslands removeFarIslands(octomap::OcTree& tree);

/// "2 islands (1234 nodes, up to 900 m away) were cut off ...", for who loaded the map.
[[nodiscard]] std::string sentenceOn(const FarIslands& cut);

}  // namespace occusg
