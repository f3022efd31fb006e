// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "box_world.hpp"

namespace occusg::testing {

/// Height of the upper floor of `twoStoreyHouse` [m].
inline constexpr double kUpperFloor_m = 3.0;
/// Height of the camera above the floor or the tread it stands on [m].
inline constexpr double kCameraAboveFloor_m = 1.2;

/// Outer walls, and a wall with a door as in `twoRooms`, 2.5 m high.
inline void addWalls(BoxWorld& world, double floor_m) {
  const double top_m = floor_m + 2.5;
  world.add({-0.2, -0.2, floor_m}, {8.4, 0.0, top_m});
  world.add({-0.2, 4.0, floor_m}, {8.4, 4.2, top_m});
  world.add({-0.2, 0.0, floor_m}, {0.0, 4.0, top_m});
  world.add({8.2, 0.0, floor_m}, {8.4, 4.0, top_m});
  world.add({4.0, 0.0, floor_m}, {4.2, 1.55, top_m});
  world.add({4.0, 2.45, floor_m}, {4.2, 4.0, top_m});
  world.add({4.0, 1.55, floor_m + 2.0}, {4.2, 2.45, top_m});
}

/// A slab with a hole over [4.4, 7.2] x [2.9, 4.0].
inline void addSlabWithStairwell(BoxWorld& world, double bottom_m, double top_m) {
  world.add({-0.2, -0.2, bottom_m}, {8.4, 2.9, top_m});
  world.add({-0.2, 2.9, bottom_m}, {4.4, 4.2, top_m});
  world.add({7.2, 2.9, bottom_m}, {8.4, 4.2, top_m});
  world.add({4.4, 4.0, bottom_m}, {7.2, 4.2, top_m});
}

/// Two storeys of two rooms each, those of `twoRooms` above each other; in the east room a straight
/// stair of 15 risers of 0.2 m leads up along its north wall, from x = 4.4 to 7.2. The floors lie
/// at 0 and `kUpperFloor_m`, the ceilings 2.5 m above them.
inline BoxWorld twoStoreyHouse() {
  BoxWorld world;
  world.add({-0.2, -0.2, -0.2}, {8.4, 4.2, 0.0});
  addWalls(world, 0.0);
  addSlabWithStairwell(world, 2.5, kUpperFloor_m);
  for (int riser = 1; riser < 15; ++riser)
    world.add({4.4 + 0.2 * (riser - 1), 2.9, 0.0}, {4.4 + 0.2 * riser, 4.0, 0.2 * riser});
  addWalls(world, kUpperFloor_m);
  world.add({-0.2, -0.2, 5.5}, {8.4, 4.2, 5.7});
  return world;
}

/// What a camera sees that is carried through a world, 5 frames a second.
class Tour {
 public:
  explicit Tour(BoxWorld world) : world_(std::move(world)) {}

  /// Looks round on the spot.
  Tour& lookRound() {
    for (int i = 0; i < 16; ++i) look(6.283185307179586 * i / 16.0);
    return *this;
  }

  /// Goes straight on to `feet`, looking ahead. The first place is where the tour begins.
  Tour& to(const Eigen::Vector3d& feet) {
    if (frames_.empty() && !has_begun_) feet_ = feet;
    has_begun_ = true;
    const Eigen::Vector3d way = feet - feet_;
    const int steps = static_cast<int>(std::ceil(way.norm() / 0.2));
    const Eigen::Vector3d from = feet_;
    const bool is_lift = way.head<2>().norm() < 1e-6;
    if (!is_lift) yaw_rad_ = std::atan2(way.y(), way.x());
    for (int i = 1; i <= steps; ++i) {
      feet_ = from + way * i / steps;
      look(yaw_rad_);
    }
    return *this;
  }

  [[nodiscard]] const std::vector<DepthFrame>& frames() const { return frames_; }

 private:
  void look(double yaw_rad) {
    const Eigen::Vector3d camera = feet_ + kCameraAboveFloor_m * Eigen::Vector3d::UnitZ();
    frames_.push_back(
        world_.seenFrom(camera, yaw_rad + 0.01, 0.2 * static_cast<double>(frames_.size())));
  }

  BoxWorld world_;
  std::vector<DepthFrame> frames_;
  Eigen::Vector3d feet_ = Eigen::Vector3d::Zero();
  double yaw_rad_ = 0.0;
  bool has_begun_ = false;
};

/// Through the rooms of the ground floor, up the stair, through the rooms of the upper floor.
inline std::vector<DepthFrame> tourOfBothStoreys() {
  Tour tour(twoStoreyHouse());
  tour.to({1.9, 2.0, 0.0}).lookRound().to({6.2, 2.0, 0.0}).lookRound();
  tour.to({4.35, 2.4, 0.0}).to({4.35, 3.4, 0.0}).to({7.3, 3.4, kUpperFloor_m});
  tour.to({7.6, 1.8, kUpperFloor_m}).to({6.2, 1.8, kUpperFloor_m}).lookRound();
  tour.to({4.1, 2.0, kUpperFloor_m}).to({1.9, 2.0, kUpperFloor_m}).lookRound();
  return tour.frames();
}

}  // namespace occusg::testing
