// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/geometry/grid.hpp"
#include "regions/dude_candidates.hpp"
#include "regions/dude_mesh.hpp"

namespace occusg {

/// Piece number of every face: faces connected across edges that are no candidate share one.
/// Numbers count up from 0 in the order of the pieces' first faces.
struct DudeFlood {
  std::vector<int> piece_of_face;
  int count = 0;
};

[[nodiscard]] DudeFlood floodedPieces(const DudeMesh& mesh, const std::vector<DudeCandidate>& cuts);

/// Piece number of every cell, -1 outside the mesh. A cell belongs to the piece that holds its
/// middle; a middle on a cut belongs to the piece on the side of larger x.
[[nodiscard]] Grid<std::int32_t> rasterised(const DudeMesh& mesh, const DudeFlood& flood);

/// Gives the smaller parts of every value's cells that are not 4-connected to its largest part to a
/// neighbouring value; a part without a neighbour gets a value of its own, counted on from `count`.
/// Cutting along a slanted line may leave such crumbs beside it. @return the new count.
int joinCrumbs(int count, Grid<std::int32_t>& values);

}  // namespace occusg
