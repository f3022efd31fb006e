// SPDX-License-Identifier: BSD-3-Clause
#include "graph/ghost_check.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace occusg {
namespace {

constexpr std::array<int, 3> kLeastSteps{1, 1, 2};
constexpr std::array<int, 3> kMostSteps{10, 10, 40};  // 4000 points
constexpr double kMostOccupied = 0.02;                // single voxels are noise
constexpr double kMostOccupiedOfLayer = 0.1;          // a table is one layer of many
constexpr double kMostUnknown = 0.2;

}  // namespace

bool isSeenThrough(const octomap::OcTree& map, const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return false;
  // Walls and the floor are not the object; but its top may be all there is of it, as of a table.
  const double margin_m = map.getResolution();
  Eigen::AlignedBox3d inside(Eigen::Vector3d(box.min() + Eigen::Vector3d::Constant(margin_m)),
                             Eigen::Vector3d(box.max() - Eigen::Vector3d(margin_m, margin_m, 0.0)));
  if (inside.isEmpty()) return false;
  // The top of a box is as noisy as the depth it was seen at: that of a plate may lie in the free
  // voxel above it. So there are always two layers, the lower one half a voxel down at least.
  inside.min().z() = std::min(inside.min().z(), inside.max().z() - margin_m);
  const Eigen::Vector3d size = inside.sizes();
  std::array<int, 3> steps{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto index = static_cast<std::size_t>(axis);
    const auto voxels = static_cast<int>(
        std::min(std::ceil(size[axis] / margin_m), static_cast<double>(kMostSteps[index])));
    steps[index] = std::max(voxels, kLeastSteps[index]);
  }
  const int points_of_layer = steps[0] * steps[1];
  const int points = points_of_layer * steps[2];
  int unknown = 0;
  int occupied = 0;
  for (int layer = 0; layer < steps[2]; ++layer) {
    const int occupied_below = occupied;
    for (int i = 0; i < points_of_layer; ++i) {
      const int column = i % steps[0];
      const int row = i / steps[0];
      // The last layer is the very top of the box.
      const Eigen::Vector3d share((column + 0.5) / steps[0], (row + 0.5) / steps[1],
                                  (layer + 1.0) / steps[2]);
      const Eigen::Vector3d at = inside.min() + size.cwiseProduct(share);
      const octomap::OcTreeNode* const voxel = map.search(at.x(), at.y(), at.z());
      if (voxel == nullptr) {
        ++unknown;
      } else if (map.isNodeOccupied(voxel)) {
        ++occupied;
      }
    }
    if (occupied - occupied_below > kMostOccupiedOfLayer * points_of_layer) return false;
    if (occupied > kMostOccupied * points || unknown > kMostUnknown * points) return false;
  }
  return true;
}

}  // namespace occusg
