// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/grid_conversions.hpp"

#include <sensor_msgs/image_encodings.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "occusg_ros/pose_conversions.hpp"

namespace occusg_ros {
namespace {

using occusg::Cell;
using occusg::CellBox;
using occusg::FreeSpace;
using occusg::FreeSpaceCells;
using occusg::GridFrame;
using occusg::Point2;
using occusg::refuse;

// Coordinates beyond this are not those of a building and would not fit cells of a millimetre.
constexpr double kMaxCoordinate_m = 1e5;
constexpr double kMinResolution_m = 0.001;
constexpr double kMaxResolution_m = 10.0;
constexpr double kLevel_rad = 1e-3;  // a map lies in the ground plane

/// Where a grid lies: its cells' own axes in the map frame.
struct Placement {
  Point2 origin;
  double yaw_rad = 0.0;

  [[nodiscard]] Point2 toMap(double x, double y) const {
    return {origin.x + std::cos(yaw_rad) * x - std::sin(yaw_rad) * y,
            origin.y + std::sin(yaw_rad) * x + std::cos(yaw_rad) * y};
  }
  [[nodiscard]] Point2 fromMap(const Point2& point) const {
    const double dx = point.x - origin.x;
    const double dy = point.y - origin.y;
    return {std::cos(yaw_rad) * dx + std::sin(yaw_rad) * dy,
            -std::sin(yaw_rad) * dx + std::cos(yaw_rad) * dy};
  }
};

void checkSize(const nav_msgs::MapMetaData& info, std::size_t values, const std::string& where) {
  // Also false for NaN.
  if (!(info.resolution >= kMinResolution_m && info.resolution <= kMaxResolution_m)) {
    throw refuse(where, "the map's resolution is " + std::to_string(info.resolution) + " m",
                 "0.001 to 10 m are allowed");
  }
  const std::uint64_t cells = std::uint64_t{info.width} * info.height;
  if (cells != values) {
    throw refuse(where, "the map carries " + std::to_string(values) + " cells",
                 "width times height is " + std::to_string(cells));
  }
  if (cells > occusg::kMaxLayerCells) {
    throw refuse(where, "the map has " + std::to_string(cells) + " cells",
                 std::to_string(occusg::kMaxLayerCells) + " are allowed");
  }
}

Placement placementOf(const nav_msgs::MapMetaData& info, const std::string& where) {
  // Drivers that never think of rotation leave the quaternion all zero.
  geometry_msgs::Pose pose = info.origin;
  if (pose.orientation.x == 0.0 && pose.orientation.y == 0.0 && pose.orientation.z == 0.0 &&
      pose.orientation.w == 0.0)
    pose.orientation.w = 1.0;
  const occusg::Pose origin = toPose(pose, where + ": origin");
  if (origin.linear()(2, 2) < std::cos(kLevel_rad))
    throw refuse(where, "the map's origin is tilted", "a map lies in the ground plane");
  if (origin.translation().head<2>().cwiseAbs().maxCoeff() > kMaxCoordinate_m) {
    throw refuse(where, "the map's origin is farther away than 100 km",
                 "choose an origin near the robot");
  }
  return {{origin.translation().x(), origin.translation().y()},
          std::atan2(origin.linear()(1, 0), origin.linear()(0, 0))};
}

std::int8_t meaningOf(std::int8_t value, const CellValues& values, const std::string& where) {
  if (value < occusg::kUnknown || value > occusg::kFullObstacle) {
    throw refuse(where, "a cell has the value " + std::to_string(value),
                 "-1 (unknown) and 0 to 100 are allowed");
  }
  return value < 0 ? occusg::kUnknown : values[static_cast<std::size_t>(value)];
}

bool liesOnCells(const Placement& placement) { return std::abs(placement.yaw_rad) < 1e-9; }

FreeSpace movedToCells(const nav_msgs::OccupancyGrid& grid, const Placement& placement,
                       const CellValues& values, const std::string& where) {
  const double resolution_m = grid.info.resolution;
  const Cell min{static_cast<int>(std::lround(placement.origin.x / resolution_m)),
                 static_cast<int>(std::lround(placement.origin.y / resolution_m))};
  const CellBox box{
      min, {min.x + static_cast<int>(grid.info.width), min.y + static_cast<int>(grid.info.height)}};
  occusg::Grid<std::int8_t> cells(box, occusg::kUnknown);
  std::transform(grid.data.begin(), grid.data.end(), cells.values().begin(),
                 [&](std::int8_t value) { return meaningOf(value, values, where); });
  return {GridFrame{resolution_m}, FreeSpaceCells(cells), box};
}

CellBox boundsOf(const nav_msgs::MapMetaData& info, const Placement& placement) {
  const GridFrame frame{info.resolution};
  const double width_m = info.width * static_cast<double>(info.resolution);
  const double height_m = info.height * static_cast<double>(info.resolution);
  CellBox box;
  for (const Point2& corner : {placement.toMap(0.0, 0.0), placement.toMap(width_m, 0.0),
                               placement.toMap(0.0, height_m), placement.toMap(width_m, height_m)})
    box = box.including(frame.cellAt(corner));
  return box;
}

FreeSpace sampledAtCells(const nav_msgs::OccupancyGrid& grid, const Placement& placement,
                         const CellValues& values, const std::string& where) {
  const double resolution_m = grid.info.resolution;
  const CellBox box = boundsOf(grid.info, placement);
  if (static_cast<double>(box.width()) * box.height() > occusg::kMaxLayerCells)
    throw refuse(where, "the turned map is too large", "turn it upright or make it smaller");
  for (const std::int8_t value : grid.data) (void)meaningOf(value, values, where);
  FreeSpace layer{GridFrame{resolution_m}, FreeSpaceCells(box, occusg::kUnknown), box};
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Point2 inside = placement.fromMap(layer.frame.center({x, y}));
      const double column = std::floor(inside.x / resolution_m);
      const double row = std::floor(inside.y / resolution_m);
      if (column < 0.0 || row < 0.0 || column >= grid.info.width || row >= grid.info.height)
        continue;
      const std::int8_t value = grid.data[static_cast<std::size_t>(row) * grid.info.width +
                                          static_cast<std::size_t>(column)];
      layer.cells.at({x, y}) = meaningOf(value, values, where);
    }
  }
  return layer;
}

}  // namespace

nav_msgs::MapMetaData toGridInfo(const FreeSpace& layer, const std_msgs::Header& header) {
  nav_msgs::MapMetaData info;
  info.map_load_time = header.stamp;
  info.resolution = static_cast<float>(layer.frame.resolution_m);
  info.width = static_cast<std::uint32_t>(layer.cells.box().width());
  info.height = static_cast<std::uint32_t>(layer.cells.box().height());
  const Point2 corner = layer.frame.corner(layer.cells.box().min);
  info.origin.position.x = corner.x;
  info.origin.position.y = corner.y;
  info.origin.orientation.w = 1.0;
  return info;
}

nav_msgs::OccupancyGrid toGridMsg(const FreeSpace& layer, const std_msgs::Header& header) {
  nav_msgs::OccupancyGrid grid;
  grid.header = header;
  grid.info = toGridInfo(layer, header);
  grid.data = std::move(layer.cells.dense().values());
  return grid;
}

nav_msgs::OccupancyGrid toDecidedGrid(nav_msgs::OccupancyGrid grid) {
  for (std::int8_t& value : grid.data)
    if (value > occusg::kFree) value = occusg::kFullObstacle;
  return grid;
}

FreeSpace toFreeSpace(const nav_msgs::OccupancyGrid& grid, const std::string& where,
                      const CellValues& values) {
  checkSize(grid.info, grid.data.size(), where);
  const Placement placement = placementOf(grid.info, where);
  FreeSpace layer = liesOnCells(placement) ? movedToCells(grid, placement, values, where)
                                           : sampledAtCells(grid, placement, values, where);
  // The message has room for a float; what was meant is the nearest short decimal.
  layer.frame.resolution_m = std::round(layer.frame.resolution_m * 1e6) / 1e6;
  return layer;
}

sensor_msgs::Image toLabelImage(const occusg::Decomposition& decomposition,
                                const nav_msgs::OccupancyGrid& grid) {
  const Placement placement = placementOf(grid.info, "map");
  sensor_msgs::Image image;
  image.header = grid.header;
  image.encoding = sensor_msgs::image_encodings::TYPE_32SC1;
  image.width = grid.info.width;
  image.height = grid.info.height;
  image.step = image.width * sizeof(std::int32_t);
  image.data.resize(std::size_t{image.step} * image.height);
  auto* const labels = reinterpret_cast<std::int32_t*>(image.data.data());
  const double resolution_m = decomposition.frame.resolution_m;
  std::size_t i = 0;
  for (std::uint32_t row = 0; row < image.height; ++row) {
    for (std::uint32_t column = 0; column < image.width; ++column, ++i) {
      const Point2 center =
          placement.toMap((column + 0.5) * resolution_m, (row + 0.5) * resolution_m);
      labels[i] =
          decomposition.labels.valueOr(decomposition.frame.cellAt(center), occusg::kNoRegion);
    }
  }
  return image;
}

sensor_msgs::PointCloud2 occupiedVoxels(const octomap::OcTree& tree,
                                        const std_msgs::Header& header) {
  std::vector<octomap::point3d> centers;
  const auto finest = static_cast<float>(tree.getResolution());
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    // 64 bits: the root of a tree has 2^48 voxels.
    const auto side = std::int64_t{std::llround(leaf.getSize() / tree.getResolution())};
    const float first = -0.5F * finest * static_cast<float>(side - 1);
    for (std::int64_t i = 0; i < side * side * side && centers.size() < kMaxShownVoxels; ++i) {
      const std::int64_t row = i / side;
      const std::int64_t layer = row / side;
      const octomap::point3d offset(static_cast<float>(i % side), static_cast<float>(row % side),
                                    static_cast<float>(layer));
      centers.push_back(leaf.getCoordinate() + octomap::point3d(first, first, first) +
                        offset * finest);
    }
    if (centers.size() == kMaxShownVoxels) break;
  }
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(centers.size());
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
  for (const octomap::point3d& center : centers) {
    x[0] = center.x();
    x[1] = center.y();
    x[2] = center.z();
    ++x;
  }
  return cloud;
}

}  // namespace occusg_ros
