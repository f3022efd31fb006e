// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "io/map_picture.hpp"
#include "io/map_yaml.hpp"
#include "occusg/geometry/grid.hpp"

namespace occusg {

/// Which thresholds of a map its user has given; these are kept whatever the picture looks like.
struct GivenThresholds {
  bool free = false;
  bool occupied = false;
};

/// The cells a map's pixels stand for, row 0 of the picture on top (map_server's image_loader).
/// Adds to `assumptions` a sentence for each meaning that the picture suggests against the
/// thresholds of the file: the middle of three greys is unknown, as map_saver writes it; a picture
/// of probabilities is free below and occupied above one half.
[[nodiscard]] Grid<std::int8_t> mapCells(const MapPicture& picture, const MapDescription& map,
                                         const GivenThresholds& given, const CellBox& box,
                                         std::vector<std::string>& assumptions);

}  // namespace occusg
