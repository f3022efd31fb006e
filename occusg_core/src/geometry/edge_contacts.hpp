// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <polyclipping/clipper.hpp>

namespace occusg {

/// True when more than `limit` pairs of edges of the closed `paths` cross or touch, neighbours in
/// one path not counted, or when finding that out would take more than about a second.
///
/// Clipper's time and memory grow with the square of the crossings, so a file of 40 kB could keep
/// it busy for minutes; this is asked first. Coordinates are lattice units.
[[nodiscard]] bool hasMoreContactsThan(std::size_t limit, const ClipperLib::Paths& paths);

}  // namespace occusg
