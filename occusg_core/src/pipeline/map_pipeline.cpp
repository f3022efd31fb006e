// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/map_pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace occusg {
namespace {

const PipelineConfig& checked(const PipelineConfig& config) {
  check(config);
  return config;
}

void add(PixelDrops& sum, const PixelDrops& drops) {
  sum.zero += drops.zero;
  sum.nan += drops.nan;
  sum.infinite += drops.infinite;
  sum.negative += drops.negative;
  sum.too_near += drops.too_near;
  sum.too_far += drops.too_far;
  sum.implausible += drops.implausible;
}

}  // namespace

MapPipeline::MapPipeline(const PipelineConfig& config)
    : projector_(checked(config).depth),
      gate_(config.poses),
      occupancy_(config.occupancy),
      free_space_(config.free_space, GridFrame{config.occupancy.resolution_m}) {}

const FreeSpace& MapPipeline::startFrom(OccupancyMap map) {
  const FreeSpace& layer = free_space_.recompute(map);
  occupancy_ = std::move(map);
  return layer;
}

const FreeSpace& MapPipeline::process(const DepthFrame& frame) {
  const RangeImage& image = timed(times_, Stage::kPointCloud, [&]() -> const RangeImage& {
    return projector_.projectLattice(frame.depth, frame.camera, frame.T_map_camera);
  });
  times_.setMemory(Stage::kPointCloud,
                   image.ends.capacity() * sizeof(Point3f) + image.kinds.capacity());
  const MapChange change =
      timed(times_, Stage::kOccupancy, [&] { return insert(image, frame.stamp_s); });
  const FreeSpace& layer = timed(times_, Stage::kFreeSpace, [&]() -> const FreeSpace& {
    return free_space_.update(occupancy_, change);
  });

  ++counts_.frames;
  counts_.points += image.hits;
  counts_.points_outside_map += change.points_outside_map;
  counts_.frames_outside_map += change.origin_outside_map ? 1 : 0;
  counts_.frames_without_depth += change.no_rays ? 1 : 0;
  counts_.frames_from_occupied += change.origin_occupied ? 1 : 0;
  counts_.frames_without_memory += change.memory_exhausted ? 1 : 0;
  add(counts_.pixel_drops, image.drops);
  return layer;
}

MapChange MapPipeline::insert(const RangeImage& image, double stamp_s) {
  last_pose_is_usable_ = false;
  if (!gate_.believes(image.T_map_camera, stamp_s)) {
    ++counts_.frames_too_fast;
    return {};
  }
  if (!staysInSpan(image.origin)) {
    ++counts_.frames_beyond_span;
    return {};
  }
  MapChange change = occupancy_.insert(image);
  last_pose_is_usable_ = !change.origin_outside_map;
  if (last_pose_is_usable_) gate_.used();
  return change;
}

/// Whether the layer can hold all that a frame from there can reach. A place outside the map is for
/// the map to refuse.
bool MapPipeline::staysInSpan(const Point3f& origin) const {
  constexpr double kMapReach_cells = 32768.0;
  const OccupancyMapConfig& config = occupancy_.config();
  const auto cellAt = [&](double metres) {
    return static_cast<int>(std::floor(
        std::clamp(metres / config.resolution_m, -kMapReach_cells, kMapReach_cells - 1.0)));
  };
  const double x = origin.x;
  const double y = origin.y;
  const double reach_m = config.max_range_m;
  CellBox box;
  box = box.including(Cell{cellAt(x - reach_m), cellAt(y - reach_m)});
  box = box.including(Cell{cellAt(x + reach_m), cellAt(y + reach_m)});
  const double limit_m = kMapReach_cells * config.resolution_m;
  const bool is_outside = !(std::abs(x) < limit_m && std::abs(y) < limit_m);
  return is_outside || free_space_.canCover(box);
}

StageTimes MapPipeline::times() const {
  StageTimes times = times_;
  times.setMemory(Stage::kOccupancy, occupancy_.memoryBytes());
  times.setMemory(Stage::kFreeSpace, free_space_.memoryBytes());
  return times;
}

}  // namespace occusg
