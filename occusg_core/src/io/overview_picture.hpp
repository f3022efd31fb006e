// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "occusg/io/rooms_file.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// An object seen from above.
struct DrawnObject {
  std::string label;
  Bounds2 box;  ///< Map frame [m].
};

/// Two adjacent rooms: points in them, and the middle of the door between.
struct RoomLink {
  Point2 from;
  Point2 door;
  Point2 to;
};

/// What an overview shows besides the map.
struct OverviewContent {
  std::string title;
  std::vector<RoomRecord> rooms;
  std::vector<DoorRecord> crossings;
  std::vector<Point2> trajectory;  ///< In the order of travel, map frame [m].
  std::vector<DrawnObject> objects = {};
  std::vector<RoomLink> links = {};
};

/// Draws the map from above, y up: obstacles, free space, rooms tinted by id with id, label and
/// area, crossings, objects, which rooms are adjacent, the trajectory with start and end; title,
/// legend and scale bar. The longer side is 1600 pixels. What is not finite or farther than 1e6 m
/// is left out, and so are the labels of all but the 600 largest rooms; an empty map gives a
/// picture that says so. Equal input gives equal pixels.
/// @return CV_8UC3, BGR.
[[nodiscard]] cv::Mat drawOverview(const FreeSpace& layer, const OverviewContent& content);

/// How long to look for a smaller file: a picture full of lines takes seconds for the last tenth.
enum class PngEffort { kSmallest, kFast };

/// Fast for an overview of so many rooms that a picture of it is all lines.
[[nodiscard]] constexpr PngEffort effortFor(std::size_t rooms) {
  constexpr std::size_t kMany = 100;
  return rooms > kMany ? PngEffort::kFast : PngEffort::kSmallest;
}

/// @throws Error when the picture is empty or cannot be encoded.
[[nodiscard]] std::string encodePng(const cv::Mat& picture,
                                    PngEffort effort = PngEffort::kSmallest);

}  // namespace occusg
