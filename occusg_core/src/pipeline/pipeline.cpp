// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/pipeline.hpp"

#include <cmath>
#include <utility>

#include "occusg/error.hpp"

namespace occusg {
namespace {

// Stamps are read from decimal text: 0.5 s may arrive as 0.49999999.
constexpr double kStampTolerance_s = 1e-6;

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

Pipeline::Pipeline(const PipelineConfig& config)
    : config_(checked(config)),
      projector_(config.depth),
      occupancy_(config.occupancy),
      free_space_(config.free_space, GridFrame{config.occupancy.resolution_m}),
      decomposer_(makeDecomposer(config)),
      tracker_(config.tracker),
      graph_(config.graph) {}

void Pipeline::startFrom(OccupancyMap map) {
  if (last_stamp_s_)
    throw refuse("map", "comes after the first frame", "a map to start from comes before it");
  changed_since_regions_ = changed_since_regions_.including(free_space_.recompute(map).changed);
  occupancy_ = std::move(map);
}

void Pipeline::process(const DepthFrame& frame) {
  if (!std::isfinite(frame.stamp_s))
    throw refuse("frame", "its stamp is not a number", "seconds are needed");
  if (last_stamp_s_ && frame.stamp_s <= *last_stamp_s_) {
    throw refuse("frame",
                 "its stamp " + shortestText(frame.stamp_s) + " s is not after " +
                     shortestText(*last_stamp_s_) + " s",
                 "frames must come in order of time");
  }
  timed(times_, Stage::kTotal, [&] {
    map(frame);
    last_stamp_s_ = frame.stamp_s;
    last_pose_ = frame.T_map_camera;
    if (regionsAreDue(frame.stamp_s)) {
      updateRegions(frame.T_map_camera, frame.stamp_s);
    } else {
      graph_.observePose(frame.T_map_camera, frame.stamp_s);
    }
    return true;
  });
}

void Pipeline::finish() {
  if (!last_stamp_s_) return;
  if (last_region_stamp_s_ != last_stamp_s_) updateRegions(last_pose_, *last_stamp_s_);
  timed(times_, Stage::kGraph,
        [&]() -> const SceneGraph& { return graph_.finish(*last_stamp_s_); });
}

void Pipeline::map(const DepthFrame& frame) {
  const PointCloud cloud = timed(times_, Stage::kPointCloud, [&] {
    return projector_.project(frame.depth, frame.camera, frame.T_map_camera);
  });
  const MapChange change =
      timed(times_, Stage::kOccupancy, [&] { return occupancy_.insert(cloud); });
  const FreeSpace& layer = timed(times_, Stage::kFreeSpace, [&]() -> const FreeSpace& {
    return free_space_.update(occupancy_, change);
  });
  changed_since_regions_ = changed_since_regions_.including(layer.changed);

  ++counts_.frames;
  counts_.points += cloud.points.size();
  counts_.points_outside_map += change.points_outside_map;
  counts_.frames_outside_map += change.origin_outside_map ? 1 : 0;
  add(counts_.pixel_drops, cloud.drops);
}

bool Pipeline::regionsAreDue(double stamp_s) const {
  return !last_region_stamp_s_ ||
         stamp_s - *last_region_stamp_s_ >= config_.region_period_s - kStampTolerance_s;
}

void Pipeline::updateRegions(const Pose& T_map_camera, double stamp_s) {
  const Decomposition& decomposition =
      timed(times_, Stage::kDecomposition, [&]() -> const Decomposition& {
        return decomposer_->update(free_space_.freeSpace(), changed_since_regions_);
      });
  changed_since_regions_ = {};
  const TrackedRegions& tracked = timed(times_, Stage::kTracking, [&]() -> const TrackedRegions& {
    return tracker_.update(decomposition);
  });
  timed(times_, Stage::kGraph,
        [&]() -> const SceneGraph& { return graph_.update(tracked, T_map_camera, stamp_s); });
  last_region_stamp_s_ = stamp_s;
  ++counts_.region_updates;
  counts_.rejected_region_updates += tracked.stale ? 1 : 0;
}

StageTimes Pipeline::times() const {
  StageTimes times = times_;
  times.setMemory(Stage::kOccupancy, occupancy_.tree().memoryUsage());
  times.setMemory(Stage::kFreeSpace, freeSpace().cells.values().size());
  times.setMemory(Stage::kTracking,
                  regions().decomposition.labels.values().size() * sizeof(std::int32_t));
  return times;
}

}  // namespace occusg
