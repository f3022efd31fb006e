// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/perception/range_image.hpp"

namespace occusg {

/// A building of equal rooms, 5.2 m apart and 2.6 m high, with a door to each neighbour, a cupboard
/// and a table in each. Its south-west corner is the origin of the map; the resolution is 0.05 m.
struct GeneratedBuilding {
  int rooms_x = 1;
  int rooms_y = 1;

  [[nodiscard]] double area() const;  ///< [m2]
};

/// The building nearest to a square of so many square metres.
[[nodiscard]] GeneratedBuilding buildingOf(double area_m2);

/// A camera that looks level, 1.2 m above the floor.
struct CameraPlace {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
};

/// What a depth camera of 640 x 480 pixels and 60 degrees sees of the building at every second
/// pixel, up to 10 m.
[[nodiscard]] RangeImage seenIn(const GeneratedBuilding& building, const CameraPlace& place);

enum class RowEnd { kWest, kEast };

/// Fills the map as many frames from everywhere would: all free voxels and the surfaces around them
/// at their clamped values.
/// @param unexplored_rooms so many rooms at one end of the northern row stay unknown.
void explore(const GeneratedBuilding& building, int unexplored_rooms, OccupancyMap& map,
             RowEnd end = RowEnd::kWest);

/// Places along the rooms, row by row and back and forth, through the doors, the camera swinging
/// from side to side.
/// @param first_row where the drive begins; @param step_m between two places.
[[nodiscard]] std::vector<CameraPlace> drive(const GeneratedBuilding& building, int first_row,
                                             double length_m, double step_m);

}  // namespace occusg
