// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace occusg {

/// The low three bits of a number, three places apart.
inline constexpr std::array<unsigned, 8> kSpread = {0, 1, 8, 9, 64, 65, 72, 73};

/// The bits of a block coordinate (13 bits), three places apart.
inline std::uint64_t spread(unsigned coordinate) {
  std::uint64_t bits = 0;
  for (unsigned shift = 0; shift < 15; shift += 3)
    bits |= static_cast<std::uint64_t>(kSpread[(coordinate >> shift) & 7U]) << (3 * shift);
  return bits;
}

/// Path of a block from the root of the octree, 3 bits a level, from its 13-bit coordinates.
inline std::uint64_t mortonCode(unsigned x, unsigned y, unsigned z) {
  return spread(x) | spread(y) << 1 | spread(z) << 2;
}

/// Place of a voxel in its block of 8 x 8 x 8, in Morton order, 0..511.
inline unsigned placeInBlock(unsigned x, unsigned y, unsigned z) {
  return kSpread[x & 7U] | kSpread[y & 7U] << 1 | kSpread[z & 7U] << 2;
}

}  // namespace occusg
