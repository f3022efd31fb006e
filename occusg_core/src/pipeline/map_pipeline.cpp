// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/map_pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace occusg {
namespace {

const PipelineConfig& usable(const PipelineConfig& config) {
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
    : projector_(usable(config).depth),
      gate_(config.poses),
      occupancy_(config.occupancy),
      free_space_(config.free_space, GridFrame{config.occupancy.resolution_m}) {}

const FreeSpace& MapPipeline::startFrom(OccupancyMap map) {
  const FreeSpace& layer = free_space_.recompute(map);
  occupancy_ = std::move(map);
  return layer;
}

FrameReport MapPipeline::process(const DepthFrame& frame) {
  const RangeImage& image = timed(times_, Stage::kPointCloud, [&]() -> const RangeImage& {
    return projector_.projectLattice(frame.depth, frame.camera, frame.T_map_camera);
  });
  times_.setMemory(Stage::kPointCloud,
                   image.ends.capacity() * sizeof(Point3f) + image.kinds.capacity());
  MapChange change;
  FrameReport report;
  report.verdict =
      timed(times_, Stage::kOccupancy, [&] { return insert(image, frame.stamp_s, change); });
  const FreeSpace& layer = timed(times_, Stage::kFreeSpace, [&]() -> const FreeSpace& {
    return free_space_.update(occupancy_, change);
  });
  report.changed = layer.changed;
  report.gaps_changed = layer.gaps_changed;
  report.changed_columns = change.columns.size();
  report.points = image.hits;
  report.points_outside_map = change.points_outside_map;
  report.pixel_drops = image.drops;
  count(report);
  return report;
}

void MapPipeline::count(const FrameReport& report) {
  ++counts_.frames;
  counts_.points += report.points;
  counts_.points_outside_map += report.points_outside_map;
  const auto one = [&report](FrameVerdict verdict) { return report.verdict == verdict ? 1U : 0U; };
  counts_.frames_outside_map += one(FrameVerdict::kOutsideMap);
  counts_.frames_without_depth += one(FrameVerdict::kWithoutDepth);
  counts_.frames_from_occupied += one(FrameVerdict::kFromOccupied);
  counts_.frames_without_memory += one(FrameVerdict::kMapIsFull);
  counts_.frames_too_fast += one(FrameVerdict::kTooFast);
  counts_.frames_beyond_span += one(FrameVerdict::kBeyondSpan);
  add(counts_.pixel_drops, report.pixel_drops);
}

FrameVerdict MapPipeline::insert(const RangeImage& image, double stamp_s, MapChange& change) {
  if (!gate_.believes(image.T_map_camera, stamp_s)) return FrameVerdict::kTooFast;
  if (!staysInSpan(image.origin)) return FrameVerdict::kBeyondSpan;
  change = occupancy_.insert(image);
  if (change.origin_outside_map) return FrameVerdict::kOutsideMap;
  gate_.used();
  if (change.memory_exhausted) return FrameVerdict::kMapIsFull;
  if (change.origin_occupied) return FrameVerdict::kFromOccupied;
  return change.no_rays ? FrameVerdict::kWithoutDepth : FrameVerdict::kUsed;
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
