// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace occusg {

/// What a scene graph may hold so that its files can be read again: those who add to a graph, write
/// and read it keep to the same limits.

/// Farthest from the origin of the map frame, along each axis [m].
inline constexpr double kMaxGraphCoordinate_m = 1e6;
inline constexpr std::size_t kMaxGraphNodes = 500'000;
inline constexpr std::size_t kMaxGraphEdges = 1'000'000;
inline constexpr std::size_t kMaxGraphVertices = 500'000;  ///< Of all rooms together.
/// Values, arrays and objects in the JSON text: those of 100 000 m2 of building and more.
inline constexpr std::size_t kMaxGraphValues = 8'000'000;

/// Whether a node can be at a place: finite and near enough.
[[nodiscard]] inline bool isWithinGraph(const Eigen::Vector3d& place) {
  return place.allFinite() && place.cwiseAbs().maxCoeff() <= kMaxGraphCoordinate_m;
}

}  // namespace occusg
