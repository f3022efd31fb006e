// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/map_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "io/grey_picture.hpp"
#include "io/json_text.hpp"
#include "io/map_yaml.hpp"
#include "occusg/error.hpp"
#include "occusg/io/rooms_file.hpp"

namespace occusg {
namespace {

constexpr double kDefaultOccupied = 0.65;
constexpr double kDefaultFree = 0.196;
constexpr double kFinestResolution_m = 1e-3;
constexpr double kCoarsestResolution_m = 100.0;

bool isYaml(const std::filesystem::path& path) {
  return path.extension() == ".yaml" || path.extension() == ".yml";
}

MapDescription barePicture(const std::string& path, const MapReaderOptions& options) {
  if (!options.resolution_m) {
    throw refuse(path, "says nothing of its scale",
                 "the metres of a pixel are needed (--resolution)");
  }
  return {path,
          *options.resolution_m,
          options.origin.value_or(Point2{}),
          options.occupied_threshold.value_or(kDefaultOccupied),
          options.free_threshold.value_or(kDefaultFree),
          options.polarity.value_or(MapPolarity::kDarkIsOccupied),
          options.mode.value_or(MapMode::kTrinary)};
}

void check(const MapDescription& map, const std::string& path) {
  // Written so that NaN fails.
  if (!(map.resolution_m >= kFinestResolution_m && map.resolution_m <= kCoarsestResolution_m)) {
    throw refuse(path, "has a resolution of " + toText(map.resolution_m) + " m",
                 "a number from " + toText(kFinestResolution_m) + " to " +
                     toText(kCoarsestResolution_m) + " m is needed");
  }
  const double low = map.free_threshold;
  const double high = map.occupied_threshold;
  if (!(low >= 0.0 && low < high && high <= 1.0)) {
    throw refuse(path, "has the thresholds free " + toText(low) + " and occupied " + toText(high),
                 "0 <= free_thresh < occupied_thresh <= 1 is needed");
  }
}

/// The map's box, and how far the map really lies beside it.
struct Placement {
  CellBox box;
  Point2 offset;
};

Placement placed(const MapDescription& map, const cv::Mat& pixels, const std::string& path) {
  const double resolution = map.resolution_m;
  const auto isNear = [](double metres) { return std::abs(metres) <= kMaxRoomCoordinate_m; };
  const Point2 far_corner{map.origin.x + pixels.cols * resolution,
                          map.origin.y + pixels.rows * resolution};
  if (!isNear(map.origin.x) || !isNear(map.origin.y) || !isNear(far_corner.x) ||
      !isNear(far_corner.y)) {
    throw refuse(path,
                 "reaches from " + toText(map.origin.x) + ", " + toText(map.origin.y) + " to " +
                     toText(far_corner.x) + ", " + toText(far_corner.y) + " m",
                 "coordinates up to " + toText(kMaxRoomCoordinate_m) + " m are used");
  }
  const Cell corner{static_cast<int>(std::lround(map.origin.x / resolution)),
                    static_cast<int>(std::lround(map.origin.y / resolution))};
  const auto residual = [resolution](double origin, int cell) {
    const double metres = origin - cell * resolution;
    // The rounding of a multiple of the resolution is no offset.
    return std::abs(metres) < kOnBoundaryTolerance_m ? 0.0 : metres;
  };
  return {{corner, {corner.x + pixels.cols, corner.y + pixels.rows}},
          {residual(map.origin.x, corner.x), residual(map.origin.y, corner.y)}};
}

std::int8_t cellValue(int grey, const MapDescription& map) {
  if (map.polarity == MapPolarity::kDarkIsFree) grey = 255 - grey;
  if (map.mode == MapMode::kRaw)
    return grey <= kFullObstacle ? static_cast<std::int8_t>(grey) : kUnknown;
  const double occupied = (255 - grey) / 255.0;
  if (occupied > map.occupied_threshold) return kFullObstacle;
  if (occupied < map.free_threshold) return kFree;
  if (map.mode == MapMode::kTrinary) return kUnknown;
  const double share =
      (occupied - map.free_threshold) / (map.occupied_threshold - map.free_threshold);
  return static_cast<std::int8_t>(1 + static_cast<int>(98.0 * share));
}

Grid<std::int8_t> cellsOf(const cv::Mat& pixels, const CellBox& box, const MapDescription& map) {
  std::array<std::int8_t, 256> values{};
  for (int grey = 0; grey < 256; ++grey)
    values[static_cast<std::size_t>(grey)] = cellValue(grey, map);
  Grid<std::int8_t> cells(box, kUnknown);
  for (int row = 0; row < pixels.rows; ++row) {
    const auto* source = pixels.ptr<std::uint8_t>(row);
    std::transform(source, source + pixels.cols, &cells.at({box.min.x, box.max.y - 1 - row}),
                   [&](std::uint8_t grey) { return values[grey]; });
  }
  return cells;
}

void checkHasFreeCell(const Grid<std::int8_t>& cells, const MapDescription& map,
                      const std::string& path) {
  const std::vector<std::int8_t>& values = cells.values();
  if (std::find(values.begin(), values.end(), kFree) != values.end()) return;
  throw refuse(
      path, "has no free cell",
      map.mode == MapMode::kRaw
          ? std::string("in raw mode free pixels are 0")
          : "free are cells whose occupancy is below free_thresh = " + toText(map.free_threshold));
}

}  // namespace

GridMap readMap(const std::string& path, const MapReaderOptions& options) {
  if (options.max_cells < 1 || options.max_cells > kMaxMapCells) {
    throw refuse("max_cells", "is " + std::to_string(options.max_cells),
                 "a number from 1 to " + std::to_string(kMaxMapCells) + " is needed");
  }
  const MapDescription map = isYaml(path) ? readMapYaml(path, options) : barePicture(path, options);
  check(map, path);
  const cv::Mat pixels = readGreyPicture(map.picture_path, options.max_cells);
  const Placement place = placed(map, pixels, path);
  const Grid<std::int8_t> cells = cellsOf(pixels, place.box, map);
  checkHasFreeCell(cells, map, path);
  return {std::filesystem::path(path).stem().string(),
          {GridFrame{map.resolution_m}, FreeSpaceCells(cells), place.box},
          place.offset};
}

}  // namespace occusg
