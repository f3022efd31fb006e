// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "occusg/geometry/polygon.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// What the grey of a pixel between the two thresholds means (`map_server`'s `mode`).
enum class MapMode {
  kTrinary,  ///< Unknown.
  kScale,    ///< Obstacle of level 1..99, the darker the higher.
  kRaw,      ///< Every pixel is the cell's value: 0 free, 1..100 obstacle, above that unknown.
};

/// Whether dark pixels are obstacles (`map_server`'s `negate`).
enum class MapPolarity { kDarkIsOccupied, kDarkIsFree };

/// Cells of a map that are read when nothing else is asked for.
inline constexpr std::size_t kDefaultMaxMapCells = 100'000'000;
/// Cells beyond which no map is read, whatever is asked for.
inline constexpr std::size_t kMaxMapCells = 1'000'000'000;

/// What the user says of a map; goes before what the map's YAML file says.
struct MapReaderOptions {
  std::optional<double> resolution_m;        ///< Edge of a pixel [m].
  std::optional<Point2> origin;              ///< Lower left corner of the picture [m].
  std::optional<double> occupied_threshold;  ///< Occupied above this probability; else 0.65.
  std::optional<double> free_threshold;      ///< Free below this probability; else 0.196.
  std::optional<MapPolarity> polarity;
  std::optional<MapMode> mode;
  std::size_t max_cells = kDefaultMaxMapCells;  ///< At most kMaxMapCells.
};

/// How the cells of a map lie in the map frame: turned about their frame's origin, then moved.
struct MapPlacement {
  Point2 offset;         ///< [m]
  double yaw_rad = 0.0;  ///< Counter-clockwise.

  [[nodiscard]] Point2 operator()(const Point2& point) const;
  [[nodiscard]] Polygon operator()(const Polygon& polygon) const;
};

/// A finished 2D map. Cells are aligned to multiples of the resolution, a map's origin need not be:
/// a picture that is not turned lies at the nearest aligned place, at most half a cell away in x
/// and y; a turned one has its corner at (0, 0).
struct GridMap {
  std::string name;      ///< File name without ending.
  FreeSpace free_space;  ///< Its box is the picture's: a cell a pixel.
  MapPlacement in_map;   ///< Map frame = in_map(frame of `free_space`).
  /// What the file leaves open and was assumed, a sentence each.
  std::vector<std::string> assumptions;
  std::string picture_path = {};  ///< The picture that was read.
};

/// Reads a map as ROS 1 `map_server` does (wiki.ros.org/map_server): a YAML file (`image`,
/// `resolution`, `origin`, `occupied_thresh`, `free_thresh`, and if present `negate`, `mode`) that
/// names a picture (`readMapPicture`), or such a picture alone, whose lower left corner is the
/// origin. With v a pixel's value, a cell is occupied with probability p = (255 - v) / 255, or v /
/// 255 negated.
/// @throws Error naming file and value: a file missing, broken, of another kind, too large (said
/// before anything is allocated), without resolution or without a free cell.
[[nodiscard]] GridMap readMap(const std::string& path, const MapReaderOptions& options = {});

}  // namespace occusg
