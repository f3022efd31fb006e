// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/ghost_check.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace occusg {
namespace {

constexpr int kMostSteps = 16;          // a side: 4096 points
constexpr double kMostOccupied = 0.02;  // single voxels are noise
constexpr double kMostUnknown = 0.2;

}  // namespace

bool isSeenThrough(const octomap::OcTree& map, const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return false;
  // Walls and the floor are not the object; but its top may be all there is of it, as of a table.
  const double margin_m = map.getResolution();
  const Eigen::AlignedBox3d inside(
      Eigen::Vector3d(box.min() + Eigen::Vector3d::Constant(margin_m)),
      Eigen::Vector3d(box.max() - Eigen::Vector3d(margin_m, margin_m, 0.0)));
  if (inside.isEmpty()) return false;
  const Eigen::Vector3d size = inside.sizes();
  std::array<int, 3> steps{};
  int points = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double wanted = std::ceil(size[axis] / map.getResolution());
    steps[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(kMostSteps)));
    points *= steps[static_cast<std::size_t>(axis)];
  }
  int unknown = 0;
  int occupied = 0;
  for (int i = 0; i < points; ++i) {
    const std::array<int, 3> step{i % steps[0], i / steps[0] % steps[1], i / steps[0] / steps[1]};
    const Eigen::Vector3d share((step[0] + 0.5) / steps[0], (step[1] + 0.5) / steps[1],
                                (step[2] + 0.5) / steps[2]);
    const Eigen::Vector3d at = inside.min() + size.cwiseProduct(share);
    const octomap::OcTreeNode* const voxel = map.search(at.x(), at.y(), at.z());
    if (voxel == nullptr) {
      ++unknown;
    } else if (map.isNodeOccupied(voxel)) {
      ++occupied;
    }
    if (occupied > kMostOccupied * points || unknown > kMostUnknown * points) return false;
  }
  return true;
}

}  // namespace occusg
