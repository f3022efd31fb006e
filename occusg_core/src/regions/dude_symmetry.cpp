// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_symmetry.hpp"

#include <algorithm>
#include <utility>

namespace occusg {
namespace {

constexpr int kSymmetries = 8;

bool isBefore(const CornerRing& a, const CornerRing& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

bool isBefore(const CellOutline& a, const CellOutline& b) {
  if (a.outer != b.outer) return isBefore(a.outer, b.outer);
  return std::lexicographical_compare(
      a.holes.begin(), a.holes.end(), b.holes.begin(), b.holes.end(),
      [](const CornerRing& left, const CornerRing& right) { return isBefore(left, right); });
}

CellBox boundsOfRing(const CornerRing& ring) {
  CellBox box;
  for (const Cell& corner : ring) box = box.including(corner);
  return box;
}

}  // namespace

GridSymmetry::GridSymmetry(int number) {
  if ((number & 4) != 0) xx_ = -1;
  for (int turn = 0; turn < (number & 3); ++turn) {
    const int old_xx = std::exchange(xx_, -yx_);
    const int old_xy = std::exchange(xy_, -yy_);
    yx_ = old_xx;
    yy_ = old_xy;
  }
}

Cell GridSymmetry::corner(const Cell& corner) const {
  return {xx_ * corner.x + xy_ * corner.y + shift_.x, yx_ * corner.x + yy_ * corner.y + shift_.y};
}

Cell GridSymmetry::cell(const Cell& cell) const {
  const Cell moved = corner(cell);
  // The lower left corner of the image is that of the moved square, not the moved corner.
  return {moved.x + (xx_ + xy_ - 1) / 2, moved.y + (yx_ + yy_ - 1) / 2};
}

CellBox GridSymmetry::box(const CellBox& box) const {
  if (box.empty()) return {};
  const Cell a = corner(box.min);
  const Cell b = corner(box.max);
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

CellOutline GridSymmetry::outline(const CellOutline& outline) const {
  const auto moved = [this](CornerRing ring) {
    for (Cell& at : ring) at = corner(at);
    if (mirrors()) std::reverse(ring.begin(), ring.end());
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
    return ring;
  };
  CellOutline image;
  image.outer = moved(outline.outer);
  image.holes.reserve(outline.holes.size());
  for (const CornerRing& hole : outline.holes) image.holes.push_back(moved(hole));
  std::sort(image.holes.begin(), image.holes.end(),
            [](const CornerRing& a, const CornerRing& b) { return isBefore(a, b); });
  return image;
}

GridSymmetry GridSymmetry::inverse() const {
  GridSymmetry result;
  // The matrix is orthogonal: its inverse is its transpose.
  result.xx_ = xx_;
  result.xy_ = yx_;
  result.yx_ = xy_;
  result.yy_ = yy_;
  const Cell back = result.corner(shift_);
  result.shift_ = {-back.x, -back.y};
  return result;
}

GridSymmetry GridSymmetry::shifted(const Cell& shift) const {
  GridSymmetry result = *this;
  result.shift_ = {shift_.x + shift.x, shift_.y + shift.y};
  return result;
}

GridSymmetry canonicalSymmetry(const CellOutline& outline) {
  const CellBox bounds = boundsOfRing(outline.outer);
  GridSymmetry best;
  CellOutline best_image;
  for (int number = 0; number < kSymmetries; ++number) {
    const GridSymmetry turned(number);
    // boundsOfRing() holds corners as if they were cells; only its lower left is used.
    const Cell a = turned.corner(bounds.min);
    const Cell b = turned.corner({bounds.max.x - 1, bounds.max.y - 1});
    const GridSymmetry candidate = turned.shifted({-std::min(a.x, b.x), -std::min(a.y, b.y)});
    CellOutline image = candidate.outline(outline);
    if (number != 0 && !isBefore(image, best_image)) continue;
    best = candidate;
    best_image = std::move(image);
  }
  return best;
}

}  // namespace occusg
