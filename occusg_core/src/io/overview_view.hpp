// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>

#include "io/overview_picture.hpp"
#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// Finite and near enough to the origin to be drawn.
[[nodiscard]] bool isDrawable(const Point2& point);

/// Bounds of everything an overview shows [m]; empty when there is nothing.
/// @pre everything in `content` is drawable.
[[nodiscard]] std::optional<Bounds2> shownBounds(const FreeSpace& layer,
                                                 const OverviewContent& content);

/// Layout of an overview: title above, map, legend below; and where metres land in it.
struct OverviewView {
  cv::Size size;      ///< Of the picture [pixels].
  cv::Rect2d map;     ///< Of the map in it.
  Point2 upper_left;  ///< Of `map`, map frame [m].
  double px_per_m = 1.0;

  [[nodiscard]] cv::Point2d pixelAt(const Point2& point) const {
    return {map.x + (point.x - upper_left.x) * px_per_m,
            map.y + (upper_left.y - point.y) * px_per_m};
  }
  [[nodiscard]] Point2 pointAt(const cv::Point2d& pixel) const {
    return {upper_left.x + (pixel.x - map.x) / px_per_m,
            upper_left.y - (pixel.y - map.y) / px_per_m};
  }
};

inline constexpr double kOverviewMargin_px = 40.0;
inline constexpr double kTitleHeight_px = 112.0;
inline constexpr double kLegendHeight_px = 88.0;

[[nodiscard]] OverviewView viewOf(const Bounds2& shown);

}  // namespace occusg
