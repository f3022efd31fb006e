// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/gap_conversions.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "occusg/error.hpp"
#include "occusg_ros/grid_conversions.hpp"

namespace occusg_ros {
namespace {

using occusg::Cell;
using occusg::CellBox;
using occusg::ColumnEvidence;
using occusg::FreeSpace;
using occusg::refuse;

// Resolution and origin went through the float and the corner of a message.
constexpr double kSamePlace_cells = 0.01;

void checkCells(const occusg::OverheadGaps& gaps, const std::string& where,
                const FreeSpace& layer) {
  const nav_msgs::MapMetaData& info = gaps.info;
  const CellBox& box = layer.cells.box();
  const std::size_t cells = layer.cells.size();
  if (info.width != static_cast<std::uint32_t>(box.width()) ||
      info.height != static_cast<std::uint32_t>(box.height()) || gaps.gap_bottom.size() != cells ||
      gaps.gap_top.size() != cells) {
    throw refuse(where,
                 "it tells of " + std::to_string(info.width) + " x " + std::to_string(info.height) +
                     " cells with " + std::to_string(gaps.gap_top.size()) + " gaps",
                 "the free space of its stamp has " + std::to_string(box.width()) + " x " +
                     std::to_string(box.height()) + " cells");
  }
  const double resolution_m = layer.frame.resolution_m;
  const occusg::Point2 corner = layer.frame.corner(box.min);
  const auto isNear = [&](double told_m, double known_m) {
    return std::abs(told_m - known_m) <= kSamePlace_cells * resolution_m;
  };
  if (!isNear(info.resolution, resolution_m) || !isNear(info.origin.position.x, corner.x) ||
      !isNear(info.origin.position.y, corner.y))
    throw refuse(where, "its cells lie elsewhere", "they must be those of the free space");
}

}  // namespace

occusg::OverheadGaps toGapsMsg(const FreeSpace& layer, const std_msgs::Header& header) {
  occusg::OverheadGaps gaps;
  gaps.header = header;
  gaps.info = toGridInfo(layer, header);
  const CellBox& box = layer.cells.box();
  const std::size_t cells = layer.cells.size();
  gaps.gap_bottom.resize(cells);
  gaps.gap_top.resize(cells);
  std::size_t i = 0;
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x, ++i) {
      const ColumnEvidence& evidence = layer.evidence.at({x, y});
      if (evidence.overhead != occusg::Overhead::kOccupied) continue;
      gaps.gap_bottom[i] = evidence.gap_bottom;
      gaps.gap_top[i] = evidence.gap_top;
    }
  }
  return gaps;
}

void addGaps(const occusg::OverheadGaps& gaps, const std::string& where, FreeSpace& layer) {
  checkCells(gaps, where, layer);
  const CellBox& box = layer.cells.box();
  std::size_t i = 0;
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x, ++i) {
      if (gaps.gap_top[i] == 0) continue;
      ColumnEvidence& evidence = layer.evidence.touch({x, y});
      evidence.overhead = occusg::Overhead::kOccupied;
      evidence.gap_bottom = gaps.gap_bottom[i];
      evidence.gap_top = gaps.gap_top[i];
    }
  }
}

}  // namespace occusg_ros
