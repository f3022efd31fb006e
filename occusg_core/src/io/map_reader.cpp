// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/map_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <system_error>
#include <utility>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "io/map_picture.hpp"
#include "io/map_values.hpp"
#include "io/map_yaml.hpp"
#include "io/picture_size.hpp"
#include "occusg/error.hpp"
#include "occusg/io/rooms_file.hpp"

namespace occusg {
namespace {

constexpr double kDefaultOccupied = 0.65;
constexpr double kDefaultFree = 0.196;
constexpr double kFinestResolution_m = 1e-3;
constexpr double kCoarsestResolution_m = 100.0;

/// The ending of a file's name in lower case, as in ".yaml".
std::string endingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// By its ending; any file without one of a YAML file by its text, whatever it is called.
bool isYaml(const std::string& path, const std::string& beginning) {
  const std::string ending = endingOf(path);
  if (ending == ".yaml" || ending == ".yml") return true;
  return pictureKind(beginning) == PictureKind::kUnknown &&
         (beginning.rfind("image:", 0) == 0 || beginning.find("\nimage:") != std::string::npos);
}

/// What the file begins with. @throws Error for what is no file, and for a 3D map.
std::string beginningOf(const std::string& path) {
  constexpr std::size_t kBeginning = 4096;
  constexpr const char* kMapIsNeeded = "a map_server YAML file or a picture is needed";
  if (path.empty()) throw refuse("the map", "has an empty name", kMapIsNeeded);
  std::error_code failed;
  if (std::filesystem::is_directory(path, failed)) throw refuse(path, "is a folder", kMapIsNeeded);
  std::string beginning = readBeginning(path, kBeginning);
  const std::string ending = endingOf(path);
  if (beginning.rfind("# Octomap", 0) == 0 || ending == ".bt" || ending == ".ot")
    throw refuse(path, "is an OctoMap", "'occusg project' reads it and makes such a map");
  return beginning;
}

MapDescription barePicture(const std::string& path, const MapReaderOptions& options) {
  if (!options.resolution_m) {
    requirePicture(path);
    throw refuse(path, "says nothing of its scale",
                 "the metres of a pixel are needed (--resolution)");
  }
  return {path,
          *options.resolution_m,
          options.origin.value_or(Point2{}),
          0.0,
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

void checkReach(const MapDescription& map, const cv::Mat& pixels, const std::string& path) {
  const double length_m = std::hypot(pixels.cols, pixels.rows) * map.resolution_m;
  const double reach_m = std::max(std::abs(map.origin.x), std::abs(map.origin.y)) + length_m;
  // Written so that NaN fails.
  if (reach_m <= kMaxRoomCoordinate_m) return;
  throw refuse(path,
               "lies at " + toText(map.origin.x) + ", " + toText(map.origin.y) + " m and is " +
                   toText(length_m) + " m across",
               "coordinates up to " + toText(kMaxRoomCoordinate_m) + " m are used");
}

/// The map's box, and how its cells lie in the map frame.
struct Placement {
  CellBox box;
  MapPlacement in_map;
};

Placement placed(const MapDescription& map, const cv::Mat& pixels) {
  // A turned picture keeps its cells and is turned about its corner.
  if (map.yaw_rad != 0.0) return {{{0, 0}, {pixels.cols, pixels.rows}}, {map.origin, map.yaw_rad}};
  const double resolution = map.resolution_m;
  const Cell corner{static_cast<int>(std::lround(map.origin.x / resolution)),
                    static_cast<int>(std::lround(map.origin.y / resolution))};
  const auto residual = [resolution](double origin, int cell) {
    const double metres = origin - cell * resolution;
    // The rounding of a multiple of the resolution is no offset.
    return std::abs(metres) < kOnBoundaryTolerance_m ? 0.0 : metres;
  };
  return {{corner, {corner.x + pixels.cols, corner.y + pixels.rows}},
          {{residual(map.origin.x, corner.x), residual(map.origin.y, corner.y)}, 0.0}};
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

Point2 MapPlacement::operator()(const Point2& point) const {
  if (yaw_rad == 0.0) return {point.x + offset.x, point.y + offset.y};
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  return {offset.x + c * point.x - s * point.y, offset.y + s * point.x + c * point.y};
}

Polygon MapPlacement::operator()(const Polygon& polygon) const {
  Polygon placed_polygon = polygon;
  for (Point2& point : placed_polygon.outer) point = (*this)(point);
  for (Ring& hole : placed_polygon.holes)
    for (Point2& point : hole) point = (*this)(point);
  return placed_polygon;
}

GridMap readMap(const std::string& path, const MapReaderOptions& options) {
  if (options.max_cells < 1 || options.max_cells > kMaxMapCells) {
    throw refuse("max_cells", "is " + std::to_string(options.max_cells),
                 "a number from 1 to " + std::to_string(kMaxMapCells) + " is needed");
  }
  std::vector<std::string> assumptions;
  const MapDescription map = isYaml(path, beginningOf(path))
                                 ? readMapYaml(path, options, assumptions)
                                 : barePicture(path, options);
  check(map, path);
  const MapPicture picture = readMapPicture(map.picture_path, options.max_cells);
  checkReach(map, picture.grey, path);
  assumptions.insert(assumptions.end(), picture.assumptions.begin(), picture.assumptions.end());
  const Placement place = placed(map, picture.grey);
  const GivenThresholds given{options.free_threshold.has_value(),
                              options.occupied_threshold.has_value()};
  const Grid<std::int8_t> cells = mapCells(picture, map, given, place.box, assumptions);
  checkHasFreeCell(cells, map, path);
  return {std::filesystem::path(path).stem().string(),
          {GridFrame{map.resolution_m}, FreeSpaceCells(cells), place.box},
          place.in_map,
          std::move(assumptions),
          map.picture_path};
}

}  // namespace occusg
