// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace occusg {

/// Voxels above each other in one column, half-open: voxel i covers [i, i + 1) * resolution in
/// height. Default-constructed: empty.
struct VoxelRun {
  int bottom = 0;
  int top = 0;

  [[nodiscard]] int length() const { return std::max(0, top - bottom); }
  [[nodiscard]] bool empty() const { return top <= bottom; }
  [[nodiscard]] int overlap(const VoxelRun& other) const {
    return std::max(0, std::min(top, other.top) - std::max(bottom, other.bottom));
  }
  friend bool operator==(const VoxelRun& a, const VoxelRun& b) {
    return a.bottom == b.bottom && a.top == b.top;
  }
  friend bool operator!=(const VoxelRun& a, const VoxelRun& b) { return !(a == b); }
};

}  // namespace occusg
