// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "occusg/mapping/free_space.hpp"
#include "occusg/regions/dude_decomposer.hpp"
#include "occusg/regions/region.hpp"

namespace occusg {

/// Draws how the dual-space decomposition came to its cuts over the map, y up: bridges of the hull
/// and the pockets behind them, tinted by level; minima, the larger the deeper, those shallower
/// than the threshold hollow; feet; ignored holes; candidate cuts thin and chosen ones thick, with
/// their depth; title, legend and scale bar. The longer side is 1600 pixels. Equal input gives
/// equal pixels.
/// @param decomposition of `layer`, whose steps `trace` holds.
/// @return CV_8UC3, BGR.
[[nodiscard]] cv::Mat drawDecomposition(const FreeSpace& layer, const Decomposition& decomposition,
                                        const DudeTrace& trace, double depth_threshold_m,
                                        const std::string& title);

}  // namespace occusg
