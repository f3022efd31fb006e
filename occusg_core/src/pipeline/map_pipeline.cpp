// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/map_pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mapping/storey_finder.hpp"

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

HeightSpan heightsSeen(const RangeImage& image, double resolution_m) {
  double lowest_m = image.origin.z;
  double highest_m = image.origin.z;
  for (std::size_t i = 0; i < image.ends.size(); ++i) {
    if (image.kinds[i] == RayEnd::kNone) continue;
    lowest_m = std::min<double>(lowest_m, image.ends[i].z);
    highest_m = std::max<double>(highest_m, image.ends[i].z);
  }
  return {lowest_m - resolution_m, highest_m + resolution_m};
}

}  // namespace

MapPipeline::MapPipeline(const PipelineConfig& config, Storeys storeys)
    : projector_(usable(config).depth),
      gate_(config.poses),
      occupancy_(config.occupancy),
      finder_(storeys == Storeys::kFound
                  ? std::make_unique<StoreyFinder>(config.occupancy.resolution_m).release()
                  : nullptr),
      building_{std::vector<Storey>(1), {}, 0, 0.0},
      layers_(1, FreeSpaceLayer(config.free_space, GridFrame{config.occupancy.resolution_m})),
      changes_(1),
      layer_config_(config.free_space) {}

void MapPipeline::DeleteFinder::operator()(StoreyFinder* finder) const noexcept {
  std::default_delete<StoreyFinder>{}(finder);
}

const FreeSpace& MapPipeline::startFrom(OccupancyMap map, const Building& building) {
  const bool has_storeys = finder_ && building.storeys.size() > 1;
  if (has_storeys) {
    std::vector<Storey> storeys = building.storeys;
    divideHeights(storeys);
    layers_ = layersOf(map, storeys);
  } else {
    layers_.front().recompute(map);
  }
  occupancy_ = std::move(map);
  if (finder_ && !building.storeys.empty()) {
    finder_->resumeFrom(building);
    takeOver(finder_->building());
  }
  changes_.resize(layers_.size());
  for (std::size_t storey = 0; storey < layers_.size(); ++storey) note(storey);
  return freeSpace();
}

std::vector<FreeSpaceLayer> MapPipeline::layersOf(const OccupancyMap& map,
                                                  const std::vector<Storey>& storeys) const {
  const FreeSpaceLayer empty(layer_config_, layers_.front().freeSpace().frame);
  std::vector<FreeSpaceLayer> layers(storeys.size(), empty);
  for (std::size_t storey = 0; storey < storeys.size(); ++storey)
    layers[storey].confine(map, storeys[storey].span);
  return layers;
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
    updateLayers(image, change);
    if (report.hasUsablePose()) followStoreys(image.T_map_camera.translation());
    return freeSpace();
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

/// A frame changes voxels between its lowest and its highest ray alone.
void MapPipeline::updateLayers(const RangeImage& image, const MapChange& change) {
  if (layers_.size() == 1) {
    layers_.front().update(occupancy_, change);
    note(0);
    return;
  }
  const double resolution_m = occupancy_.config().resolution_m;
  const HeightSpan seen = heightsSeen(image, resolution_m);
  for (std::size_t storey = 0; storey < layers_.size(); ++storey) {
    const HeightSpan& span = building_.storeys[storey].span;
    // A column matters to a storey down to the least fall below it, in whole voxels.
    const double lowest_m = span.bottom_m - kLeastFall_m - resolution_m;
    const bool is_touched = seen.bottom_m < span.top_m && seen.top_m > lowest_m;
    layers_[storey].update(occupancy_, is_touched ? change : MapChange{});
    note(storey);
  }
}

void MapPipeline::followStoreys(const Eigen::Vector3d& position) {
  if (!finder_) return;
  const bool is_new = finder_->observe(occupancy_.columns(), position);
  takeOver(finder_->building());
  if (!is_new || building_.storeys.size() == 1) return;
  layers_.resize(building_.storeys.size(),
                 FreeSpaceLayer(layer_config_, layers_.front().freeSpace().frame));
  changes_.resize(building_.storeys.size());
  for (std::size_t storey = 0; storey < layers_.size(); ++storey) {
    layers_[storey].confine(occupancy_, building_.storeys[storey].span);
    note(storey);
  }
}

/// Storeys and ways are only ever added, so that their numbers tell whether there is anything new.
void MapPipeline::takeOver(const Building& building) {
  if (building.storeys.empty()) return;
  building_.current = building.current;
  building_.sensor_height_m = building.sensor_height_m;
  if (!has_floor_ || building.storeys.size() != building_.storeys.size())
    building_.storeys = building.storeys;
  has_floor_ = true;
  if (building.passages.size() != building_.passages.size()) building_.passages = building.passages;
}

void MapPipeline::note(std::size_t storey) {
  const FreeSpace& layer = freeSpace(storey);
  changes_[storey].cells = changes_[storey].cells.including(layer.changed);
  changes_[storey].gaps = changes_[storey].gaps.including(layer.gaps_changed);
}

LayerChange MapPipeline::takeChange(std::size_t storey) {
  return std::exchange(changes_[storey], LayerChange{});
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
  return is_outside ||
         std::all_of(layers_.begin(), layers_.end(),
                     [&box](const FreeSpaceLayer& layer) { return layer.canCover(box); });
}

StageTimes MapPipeline::times() const {
  StageTimes times = times_;
  times.setMemory(Stage::kOccupancy, occupancy_.memoryBytes());
  std::size_t layers_bytes = 0;
  for (const FreeSpaceLayer& layer : layers_) layers_bytes += layer.memoryBytes();
  times.setMemory(Stage::kFreeSpace, layers_bytes);
  return times;
}

}  // namespace occusg
