// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "geometry/cell_outline.hpp"

namespace occusg {

/// One of the eight symmetries of the square lattice, followed by a shift.
class GridSymmetry {
 public:
  /// The identity.
  GridSymmetry() = default;
  /// The symmetry numbered 0..7: the low two bits count quarter turns counter-clockwise, the third
  /// mirrors x first.
  explicit GridSymmetry(int number);

  [[nodiscard]] bool mirrors() const { return xx_ * yy_ - xy_ * yx_ < 0; }
  [[nodiscard]] Cell corner(const Cell& corner) const;
  /// The cell itself, not its lower left corner, is moved.
  [[nodiscard]] Cell cell(const Cell& cell) const;
  [[nodiscard]] CellBox box(const CellBox& box) const;
  [[nodiscard]] CellOutline outline(const CellOutline& outline) const;
  [[nodiscard]] GridSymmetry inverse() const;
  /// This symmetry, then a shift by `shift`.
  [[nodiscard]] GridSymmetry shifted(const Cell& shift) const;

 private:
  int xx_ = 1, xy_ = 0, yx_ = 0, yy_ = 1;  ///< Row-major matrix.
  Cell shift_;
};

/// The symmetry that takes `outline` to its canonical place: of the eight images moved to the
/// origin, the one whose corners come first in lexicographic order. Two outlines that differ by a
/// shift, a quarter turn or a mirror image have the same canonical image, so whatever is computed
/// there does not depend on how the map lies.
[[nodiscard]] GridSymmetry canonicalSymmetry(const CellOutline& outline);

}  // namespace occusg
