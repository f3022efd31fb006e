// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/geometry/tiled_grid.hpp"
#include "occusg/mapping/column_evidence.hpp"

namespace occusg {

/// Side of the tiles that share a local floor.
inline constexpr int kFloorTile_cells = 8;

/// So many columns of a tile must agree on a height for it to be a floor.
inline constexpr int kFloorColumns = 8;

/// The floor a robot stands on near each column, from the heights at which single columns show one,
/// which are table tops and steps too.
///
/// A tile's own floor is the lowest height that, with the voxel below it, at least kFloorColumns of
/// its columns show. Its local floor is the lowest own floor of the tiles around it that belongs to
/// the same storey: it lies at most `storey_voxels` below the tile's own floor or, when it has
/// none, below the highest one around. So a table stands on the floor beside it, and a stairwell
/// does not pull down the floor it opens in.
class LocalFloor {
 public:
  /// @param reach_tiles how many tiles around count.
  LocalFloor(int storey_voxels, int reach_tiles);

  /// The height at which `column` shows a floor, kNoFloor when it shows none.
  void set(const Cell& column, std::int16_t height);

  /// Brings the local floors up to date.
  /// @return the tiles, cell / kFloorTile_cells, whose local floor is another; valid until the next
  /// call.
  const std::vector<Cell>& update();

  /// True when the last update moved the local floor of the column's tile.
  [[nodiscard]] bool hasMoved(const Cell& column) const { return tiles_.at(tileOf(column)).moved; }

  /// kNoFloor where none is known.
  [[nodiscard]] std::int16_t at(const Cell& column) const;

  [[nodiscard]] static Cell tileOf(const Cell& column);
  [[nodiscard]] std::size_t memoryBytes() const;

 private:
  struct Tile {
    std::int16_t own = kNoFloor;
    std::int16_t local = kNoFloor;
    bool own_is_due = false;
    bool local_is_due = false;
    bool moved = false;  ///< In `changed_`.
    friend bool operator==(const Tile& a, const Tile& b) {
      return a.own == b.own && a.local == b.local;
    }
  };

  [[nodiscard]] std::int16_t ownFloor(const Cell& tile);
  [[nodiscard]] std::int16_t localFloor(const Cell& tile) const;

  int storey_voxels_;
  int reach_tiles_;
  TiledGrid<std::int16_t> heights_;  ///< By column.
  TiledGrid<Tile> tiles_;
  std::vector<Cell> own_due_;
  std::vector<Cell> local_due_;
  std::vector<Cell> changed_;
  std::vector<std::int16_t> sorted_;  ///< Reused between tiles.
};

}  // namespace occusg
