// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

namespace occusg {

/// Heights between which evidence about a column is gathered.
struct ColumnEvidenceConfig {
  /// Shares are taken between the floor and this height above it, below usual ceilings [m]. A floor
  /// at most so far below another belongs to the same storey.
  double ceiling_height_m = 2.2;
  double body_bottom_m = 0.3;  ///< The body band, above the floor [m].
  double body_top_m = 1.5;
};

/// Height of a floor that is not known.
inline constexpr std::int16_t kNoFloor = std::numeric_limits<std::int16_t>::min();

/// What lies on top of the largest gap of a column.
enum class Overhead : std::uint8_t { kUnknown, kOccupied };

/// What is known about one column above the local floor. All zero, without a floor, when no voxel
/// of the column is known or no floor is known near it. Heights count in voxels, shares are rounded
/// down.
struct ColumnEvidence {
  std::int16_t floor = kNoFloor;       ///< Height of the local floor; in metres times resolution.
  std::uint8_t observed = 0;           ///< Known voxels between floor and ceiling height [%].
  std::uint8_t occupied = 0;           ///< Occupied voxels between floor and ceiling height [%].
  std::uint8_t free_in_body_band = 0;  ///< Free voxels of the body band [%].
  Overhead overhead = Overhead::kUnknown;
  /// The longest free run that begins below the ceiling height, counted up to twice that height:
  /// from `gap_bottom` to `gap_top` above the floor; both zero when there is none. With an occupied
  /// overhead, `gap_top` is the height of the lintel, beam or ceiling.
  std::uint16_t gap_bottom = 0;
  std::uint16_t gap_top = 0;

  [[nodiscard]] bool hasFloor() const { return floor != kNoFloor; }
  [[nodiscard]] int gapLength() const { return gap_top - gap_bottom; }

  friend bool operator==(const ColumnEvidence& a, const ColumnEvidence& b) {
    return a.floor == b.floor && a.observed == b.observed && a.occupied == b.occupied &&
           a.free_in_body_band == b.free_in_body_band && a.overhead == b.overhead &&
           a.gap_bottom == b.gap_bottom && a.gap_top == b.gap_top;
  }
  friend bool operator!=(const ColumnEvidence& a, const ColumnEvidence& b) { return !(a == b); }
};

/// True when the gap and what ends it above are the same.
[[nodiscard]] inline bool haveSameGap(const ColumnEvidence& a, const ColumnEvidence& b) {
  return a.overhead == b.overhead && a.gap_bottom == b.gap_bottom && a.gap_top == b.gap_top;
}

}  // namespace occusg
