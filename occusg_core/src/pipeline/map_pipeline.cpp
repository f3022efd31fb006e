// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/map_pipeline.hpp"

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
}

}  // namespace

MapPipeline::MapPipeline(const PipelineConfig& config)
    : projector_(checked(config).depth),
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
      timed(times_, Stage::kOccupancy, [&] { return occupancy_.insert(image); });
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

StageTimes MapPipeline::times() const {
  StageTimes times = times_;
  times.setMemory(Stage::kOccupancy, occupancy_.memoryBytes());
  times.setMemory(Stage::kFreeSpace, free_space_.memoryBytes());
  return times;
}

}  // namespace occusg
