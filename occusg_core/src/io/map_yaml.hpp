// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/io/map_reader.hpp"

namespace occusg {

/// What a `map_server` YAML file says.
struct MapDescription {
  std::string picture_path;  ///< Relative names are taken from the YAML file's folder.
  double resolution_m = 0.0;
  Point2 origin;
  double yaw_rad = 0.0;
  double occupied_threshold = 0.0;
  double free_threshold = 0.0;
  MapPolarity polarity = MapPolarity::kDarkIsOccupied;
  MapMode mode = MapMode::kTrinary;
};

/// Reads a `map_server` YAML file, in any spelling YAML allows. Adds to `assumptions` what was
/// assumed. Values that `given` sets may be missing or broken in the file; ranges are left to the
/// caller. Keys that `map_server` does not know are ignored.
/// @throws Error naming the file, the key and its value.
[[nodiscard]] MapDescription readMapYaml(const std::string& path, const MapReaderOptions& given,
                                         std::vector<std::string>& assumptions);

}  // namespace occusg
