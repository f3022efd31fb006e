// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/column_bits.hpp"
#include "occusg/geometry/cell.hpp"

namespace occusg {

/// A block of 8 x 8 x 8 voxels of which some have a new state; bits as in `VoxelBlock`.
struct BlockChange {
  std::array<std::uint64_t, 8> changed{};
  std::array<std::uint64_t, 8> occupied{};  ///< Among the changed ones; the others are free.
};

/// Largest number of blocks with a known voxel, 2 GiB of them; a building of 100 000 m2 and 3 m of
/// height has 5 million.
inline constexpr std::size_t kMaxColumnBlocks = std::size_t{1} << 24;

/// The state of every known voxel by column, a cache of the octree: reading a column takes a few
/// bytes that lie together instead of a descent through the tree. Kept in tiles of 8 x 8 columns;
/// a tile holds 128 bytes for every 8 voxels of height in which a voxel is known.
class VoxelColumns {
 public:
  /// The columns of a tree.
  /// @throws Error when it has more than kMaxColumnBlocks blocks.
  [[nodiscard]] static VoxelColumns of(const octomap::OcTree& tree);

  VoxelColumns();
  void clear();

  /// @param tile cell / 8 of the block's columns, @param block_z its height / 8.
  /// @return the columns in which something changed, bit 8 * (cell y % 8) + cell x % 8.
  std::uint64_t apply(const Cell& tile, int block_z, const BlockChange& change);

  /// @param bits is cleared first.
  void read(const Cell& column, ColumnBits& bits) const;

  /// Columns with a known voxel, tile by tile.
  [[nodiscard]] std::vector<Cell> knownColumns() const;
  [[nodiscard]] std::size_t memoryBytes() const;

  /// True when every voxel has the same state in both.
  friend bool operator==(const VoxelColumns& a, const VoxelColumns& b);

 private:
  /// 8 x 8 columns, 8 voxels high: byte 8 * y + x is a column, its lowest bit the lowest voxel.
  struct Slab {
    int block_z = 0;
    std::array<std::uint8_t, 64> free{};
    std::array<std::uint8_t, 64> occupied{};
  };

  struct Tile {
    Cell name;
    std::vector<Slab> slabs;  ///< From the lowest up.
  };

  /// 64 x 64 numbers of tiles, from 1; 0 where there is none.
  using Page = std::vector<std::uint32_t>;

  [[nodiscard]] const Tile* find(const Cell& name) const;
  [[nodiscard]] Tile& tileAt(const Cell& name);
  [[nodiscard]] static Slab& slabAt(Tile& tile, int block_z);
  void addNode(const octomap::OcTree& tree, const octomap::OcTreeNode* node, unsigned level,
               const std::array<int, 3>& corner);
  void addBlocks(const std::array<int, 3>& corner, int side, const BlockChange& change);

  std::vector<std::uint32_t> directory_;  ///< 128 x 128 numbers of pages, from 1; 0: none.
  std::vector<Page> pages_;
  std::vector<Tile> tiles_;
};

}  // namespace occusg
