// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "occusg/geometry/pose.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg_ros {

/// The storeys of a building as somebody tells them: for a robot with 2D maps, one for each storey,
/// that rides a lift from map to map. Where such a robot localises in a plane, its poses have no
/// height; they get that of the storey's floor.
class GivenStoreys {
 public:
  /// @param floor_z_m of the first storey.
  explicit GivenStoreys(double floor_z_m);

  /// Goes on with what is known of a building.
  void resumeFrom(const occusg::Building& building);

  /// From now on the robot is on that storey; the next free id makes a new one.
  /// @throws occusg::Error when the id is beyond that, or the floor of a new storey is less than
  /// 0.8 m from that of another.
  void enter(int floor_id, double floor_z_m);

  /// A pose of the robot on the storey it is on; the first one after `enter` ends the ride from the
  /// last one before.
  void observe(const occusg::Pose& T_map_robot);

  /// The pose, or the box or place, at the height of the storey it is on.
  /// @param z_m height as the robot's localisation has it.
  [[nodiscard]] double heightOnStorey(double z_m) const;
  [[nodiscard]] occusg::Pose onStorey(occusg::Pose T_map_robot) const;

  [[nodiscard]] const occusg::Building& building() const { return building_; }

 private:
  void addLift(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int from_storey);

  occusg::Building building_;
  std::optional<Eigen::Vector3d> last_feet_;  ///< Where the robot was last.
  int last_storey_ = 0;                       ///< On which storey that was.
};

}  // namespace occusg_ros
