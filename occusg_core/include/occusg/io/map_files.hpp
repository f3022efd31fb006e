// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// The two files `map_server` loads.
struct MapFiles {
  std::string pgm;   ///< Binary PGM, 8 bit; the first row is the highest y.
  std::string yaml;  ///< Names the picture; origin = lower left corner of the lower left cell.
};

/// The layer in `map_server`'s trinary convention: free 254, obstacle of any level 0 (a planner
/// that reads the map must not drive through what fills a passage only in part), unknown 205. An
/// empty layer becomes one unknown cell, because `map_server` loads no empty picture.
/// @param picture_name file name of the picture, relative to the YAML file: letters, digits, and
/// "._-".
/// @throws Error when the layer's resolution is not positive and finite or the name has other
/// characters.
[[nodiscard]] MapFiles toMapFiles(const FreeSpace& layer, const std::string& picture_name);

}  // namespace occusg
