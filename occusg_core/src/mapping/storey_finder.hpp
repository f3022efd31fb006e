// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "mapping/column_bits.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

class VoxelColumns;

/// Finds the storeys of a building from the heights at which a robot had a floor around it.
///
/// The level near a pose is the height, at the sensor's usual height below it, at which most of the
/// columns within 2.5 m show a floor. Where that lies within 0.8 m of a storey's floor the robot is
/// on that storey: steps, ramps and drift do not make another one. Elsewhere it is a new storey
/// once the robot has 8 m2 of it around, or 4 m2 and has moved over 2 m of it: landings of stairs
/// offer neither.
///
///     StoreyFinder finder(0.05);
///     if (finder.observe(map.columns(), camera)) // finder.building() has one storey more
class StoreyFinder {
 public:
  /// @param resolution_m of the map.
  explicit StoreyFinder(double resolution_m) : resolution_m_(resolution_m) {}

  /// Takes a pose of the sensor, after the map has taken in what it saw from there.
  /// @param position in the map frame [m].
  /// @return whether a storey was found.
  bool observe(const VoxelColumns& columns, const Eigen::Vector3d& position);

  /// What was found. Without storeys until a floor was seen; every way between two storeys is there
  /// once, whichever way and however often the robot went it.
  [[nodiscard]] const Building& building() const { return building_; }

  /// Goes on with what another finder found. Before the first pose.
  void resumeFrom(const Building& building);

 private:
  /// A level floor near a pose.
  struct Level {
    double z_m = 0.0;
    double area_m2 = 0.0;
  };

  /// A level that may be a storey's.
  struct Candidate {
    double z_m = 0.0;
    std::size_t looks = 0;
    Eigen::AlignedBox2d path;  ///< Where the robot was on it [m].
  };

  [[nodiscard]] std::optional<Level> levelNear(const VoxelColumns& columns,
                                               const Eigen::Vector3d& position);
  /// Index of the storey whose floor is nearest; empty when none is near.
  [[nodiscard]] std::optional<std::size_t> storeyAt(double z_m) const;
  void standOn(std::size_t storey, const Level& level, double sensor_z_m);
  void followFeet(const VoxelColumns& columns, const Eigen::Vector3d& position);
  void addPassage(const VoxelColumns& columns, std::size_t from, std::size_t to);
  [[nodiscard]] int risersAlong(const VoxelColumns& columns,
                                const std::vector<Eigen::Vector3d>& path);
  [[nodiscard]] bool isStorey(const Level& level, const Eigen::Vector3d& position);
  void add(double floor_z_m);

  double resolution_m_;
  Building building_;
  std::optional<Candidate> candidate_;
  std::optional<Eigen::Vector3d> last_position_;  ///< Of the last look.
  std::size_t frames_on_the_spot_ = 0;            ///< Since the last look.
  std::size_t heights_ = 0;                       ///< How many went into the sensor's height.
  std::optional<std::size_t> stood_on_;  ///< The storey whose floor was under the feet last.
  std::vector<Eigen::Vector3d> trail_;   ///< Feet since then, that place first.
  ColumnBits bits_;                      ///< Reused between columns.
};

}  // namespace occusg
