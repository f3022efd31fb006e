// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "occusg/io/rooms_file.hpp"

namespace occusg {

/// What a `.house` file of Matterport3D (Chang et al., 3DV 2017) says of its rooms.
struct HouseTruth {
  RoomsFile rooms;                 ///< A room a region, id = its index + 1; doors = its portals.
  std::vector<std::string> notes;  ///< One sentence for each region that could not be taken as is.
};

inline constexpr std::size_t kMaxHouseBytes = std::size_t{256} << 20U;
inline constexpr std::size_t kMaxHouseRegions = 10'000;
inline constexpr std::size_t kMaxHouseSurfaces = 1'000'000;
inline constexpr std::size_t kMaxHouseVertices = 5'000'000;

/// Annotated rooms as the paper's evaluation takes them: the footprint of a region is the union
/// over its surfaces that are labelled floor or whose normal is nearly vertical (|n_z| > 0.85, so
/// ceilings count) of the surface's vertices in the ground plane; without such a surface, the
/// convex hull of all its vertices. Regions without a footprint are left out; all labels count.
/// @param level only regions of this level; without it all of them, above each other.
/// @param where opens every sentence; the file's path.
/// @throws Error naming the line: a record that is too short or holds no number where one belongs,
/// references to what is not there, more than the limits; and when no region is left.
[[nodiscard]] HouseTruth parseHouse(const std::string& text, const std::string& where,
                                    const std::optional<int>& level);

/// @throws Error as `parseHouse`, or when the file cannot be read.
[[nodiscard]] HouseTruth readHouse(const std::string& path, const std::optional<int>& level);

}  // namespace occusg
