// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/perception/depth_frame.hpp"

namespace occusg {

/// How a map lies in the world, as far as frames show it.
struct MapOrientation {
  /// Between gravity, as the frames show it, and the map's -z, 0 to pi [rad].
  double down_off_rad = 0.0;
  /// Length of the mean direction of "down in the images", 0 to 1: near 0 they agree on none.
  double agreement = 0.0;
  /// Against gravity, in the map; of unit length, and +z when the images agree on nothing.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  /// Height of the lowest large level surface along `up`, from the origin [m]; empty when none was
  /// seen.
  std::optional<double> floor_height_m;
  /// Mean of the camera's positions, in the map [m].
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
};

/// Whether the images agree on where down is; those of a camera that looks at the floor do not.
[[nodiscard]] bool hasCommonDown(const MapOrientation& orientation);
/// Whether z is not up in the map: a camera that looks down a table or up a wall is nearer.
[[nodiscard]] bool isTilted(const MapOrientation& orientation);
/// z of the floor beneath the middle of the camera's positions [m]; empty when no floor was seen.
/// Unlike `floor_height_m` it is right for a level map whose estimated `up` is a fraction of a
/// degree off: 500 m from the origin that fraction is metres.
[[nodiscard]] std::optional<double> floorAtMiddle_m(const MapOrientation& orientation);
/// Whether that floor is farther from z = 0 than one a robot of this map drives on.
[[nodiscard]] bool hasFarFloor(const MapOrientation& orientation);

/// Finds out how a map lies from a sample of its frames. Gravity is refined from the mean direction
/// of "down in the images" by the surfaces: as many as possible of them are to be level or upright
/// (Gupta, Arbelaez and Malik, "Perceptual Organization and Recognition of Indoor Scenes from RGB-D
/// Images", CVPR 2013, Sec. 3.1).
///
/// @code
///   MapOrientationEstimator estimator;
///   for (const DepthFrame& frame : frames) estimator.add(frame);
///   const Pose T_level_map = levelling(estimator.estimate());
/// @endcode
class MapOrientationEstimator {
 public:
  /// Takes some thousand points of the frame.
  /// @throws Error when the frame cannot be projected.
  void add(const DepthFrame& frame);

  [[nodiscard]] bool isEmpty() const { return downs_.empty(); }
  /// Of the frames so far; without any, a level map.
  [[nodiscard]] MapOrientation estimate() const;

 private:
  /// A point of a surface and the direction the surface faces.
  struct Patch {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
  };
  [[nodiscard]] Eigen::Vector3d refined(const Eigen::Vector3d& up, double within_rad) const;
  [[nodiscard]] std::optional<double> floorHeight(const Eigen::Vector3d& up) const;

  std::vector<Eigen::Vector3d> downs_;                       ///< Of the images, in the map.
  Eigen::Vector3d positions_sum_ = Eigen::Vector3d::Zero();  ///< Of the camera, in the map [m].
  std::vector<Patch> patches_;
};

/// The transform into a map whose z is up and whose floor is at z = 0.
[[nodiscard]] Pose levelling(const MapOrientation& orientation);

}  // namespace occusg
