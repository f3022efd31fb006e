// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>
#include <octomap/OcTree.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "occusg/mapping/free_space.hpp"
#include "occusg/regions/region.hpp"
#include "occusg_ros/grid_reading.hpp"

namespace occusg_ros {

/// Where the cells of `layer` lie; loaded at the header's stamp.
[[nodiscard]] nav_msgs::MapMetaData toGridInfo(const occusg::FreeSpace& layer,
                                               const std_msgs::Header& header);

/// Free cells are 0, unknown ones -1, and obstacles 1..100 to the degree in which they fill the
/// space beside them.
[[nodiscard]] nav_msgs::OccupancyGrid toGridMsg(const occusg::FreeSpace& layer,
                                                const std_msgs::Header& header);
/// The same with every obstacle at 100, as a costmap's static layer and map_saver expect it: they
/// take the degrees below their threshold for free.
[[nodiscard]] nav_msgs::OccupancyGrid toDecidedGrid(nav_msgs::OccupancyGrid grid);

/// The map in `grid` on cells aligned to multiples of its resolution: a grid that lies between them
/// is moved by half a cell at most, a turned one is sampled at the cells' centres. All of it counts
/// as changed.
/// @param where opens every sentence; the topic.
/// @throws occusg::Error, before anything is allocated, when resolution, size or origin cannot be
/// used or the values are not -1..100.
/// @param values what 0..100 mean (`readingOf`).
[[nodiscard]] occusg::FreeSpace toFreeSpace(const nav_msgs::OccupancyGrid& grid,
                                            const std::string& where,
                                            const CellValues& values = unchangedValues());

/// The region of every cell of `grid` as 32SC1, in the grid's order of rows; 0: none.
[[nodiscard]] sensor_msgs::Image toLabelImage(const occusg::Decomposition& decomposition,
                                              const nav_msgs::OccupancyGrid& grid);

/// Voxels shown at most.
inline constexpr std::size_t kMaxShownVoxels = 2'000'000;

/// The centres of all occupied voxels of the finest size, x, y, z as floats; the first
/// `kMaxShownVoxels` of them.
[[nodiscard]] sensor_msgs::PointCloud2 occupiedVoxels(const octomap::OcTree& tree,
                                                      const std_msgs::Header& header);

/// The tree as `octomap_msgs/Octomap` carries it, binary: free, occupied, unknown. A template,
/// because that package is not everywhere.
template <typename OctomapMsg>
[[nodiscard]] OctomapMsg toOctomapMsg(const octomap::OcTree& tree, const std_msgs::Header& header) {
  OctomapMsg msg;
  msg.header = header;
  msg.binary = true;
  msg.id = tree.getTreeType();
  msg.resolution = tree.getResolution();
  std::ostringstream stream;
  tree.writeBinaryData(stream);
  const std::string bytes = stream.str();
  msg.data.assign(bytes.begin(), bytes.end());
  return msg;
}

}  // namespace occusg_ros
