// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <occusg/OverheadGaps.h>
#include <std_msgs/Header.h>

#include <string>

#include "occusg/mapping/free_space.hpp"

namespace occusg_ros {

/// What an OccupancyGrid has no room for: the gaps under what hangs over the cells of `layer`.
[[nodiscard]] occusg::OverheadGaps toGapsMsg(const occusg::FreeSpace& layer,
                                             const std_msgs::Header& header);

/// Adds to `layer`, made from the grid `gaps` belong to, the evidence that lintels need.
/// @param where opens every sentence; the topic.
/// @throws occusg::Error, and leaves `layer` as it is, when its cells are not those of the layer.
void addGaps(const occusg::OverheadGaps& gaps, const std::string& where, occusg::FreeSpace& layer);

}  // namespace occusg_ros
