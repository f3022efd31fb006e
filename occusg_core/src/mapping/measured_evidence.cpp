// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/measured_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "occusg/error.hpp"

namespace occusg {
namespace {

/// Twice the ceiling height must fit `ColumnEvidence::gap_top`.
constexpr int kMaxCeiling_voxels = 32767;

int roundedToVoxels(double height_m, double resolution_m) {
  return static_cast<int>(std::lround(height_m / resolution_m));
}

std::uint8_t percent(int count, int of) { return static_cast<std::uint8_t>(100 * count / of); }

VoxelRun above(int floor, const VoxelRun& run) { return {floor + run.bottom, floor + run.top}; }

}  // namespace

EvidenceHeights evidenceHeights(const ColumnEvidenceConfig& config, double resolution_m) {
  const double highest_m = kMaxCeiling_voxels * resolution_m;
  if (!(config.ceiling_height_m >= resolution_m && config.ceiling_height_m <= highest_m)) {
    throw refuse(
        "ceiling_height_m", "is " + std::to_string(config.ceiling_height_m) + " m",
        "it must be in [" + std::to_string(resolution_m) + ", " + std::to_string(highest_m) + "]");
  }
  if (!(config.body_bottom_m >= 0.0 && config.body_bottom_m < config.body_top_m)) {
    throw refuse("body_bottom_m", "is " + std::to_string(config.body_bottom_m) + " m",
                 "it must be in [0, body_top_m = " + std::to_string(config.body_top_m) + ")");
  }
  if (!(config.body_top_m <= config.ceiling_height_m)) {
    throw refuse(
        "body_top_m", "is " + std::to_string(config.body_top_m) + " m",
        "it must be at most ceiling_height_m = " + std::to_string(config.ceiling_height_m));
  }
  const int bottom = roundedToVoxels(config.body_bottom_m, resolution_m);
  const int top = roundedToVoxels(config.body_top_m, resolution_m);
  return {roundedToVoxels(config.ceiling_height_m, resolution_m),
          {bottom, std::max(bottom + 1, top)}};
}

std::int16_t shownFloor(const ColumnBits& column, int needed) {
  for (VoxelRun run = column.nextFree(kAllHeights.bottom); !run.empty();
       run = column.nextFree(run.top)) {
    const bool stands_on_something = column.occupiedIn({run.bottom - 1, run.bottom}) == 1;
    if (stands_on_something && run.length() >= needed) return static_cast<std::int16_t>(run.bottom);
  }
  return kNoFloor;
}

ColumnEvidence measuredEvidence(const ColumnBits& column, std::int16_t floor,
                                const EvidenceHeights& heights) {
  ColumnEvidence evidence;
  if (floor == kNoFloor || column.empty()) return evidence;
  evidence.floor = floor;
  const VoxelRun room = above(floor, {0, heights.ceiling});
  const VoxelRun body = above(floor, heights.body);
  const int occupied = column.occupiedIn(room);
  evidence.occupied = percent(occupied, room.length());
  evidence.observed = percent(occupied + column.freeIn(room), room.length());
  evidence.free_in_body_band = percent(column.freeIn(body), body.length());

  const VoxelRun gap = column.longestFree(room, above(floor, {0, 2 * heights.ceiling}));
  if (gap.empty()) return evidence;
  evidence.gap_bottom = static_cast<std::uint16_t>(gap.bottom - floor);
  evidence.gap_top = static_cast<std::uint16_t>(gap.top - floor);
  if (column.occupiedIn({gap.top, gap.top + 1}) == 1) evidence.overhead = Overhead::kOccupied;
  return evidence;
}

}  // namespace occusg
