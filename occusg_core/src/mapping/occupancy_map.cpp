// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/occupancy_map.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "mapping/far_islands.hpp"
#include "mapping/frame_carver.hpp"
#include "mapping/frame_rays.hpp"
#include "mapping/frame_voxels.hpp"
#include "mapping/settled_voxels.hpp"
#include "mapping/voxel_tree.hpp"
#include "mapping/workers.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

const OccupancyMapConfig& usable(const OccupancyMapConfig& config) {
  const double longest_m = kMaxRangeVoxels * config.resolution_m;
  if (checked(config).max_range_m >= config.resolution_m && config.max_range_m <= longest_m)
    return config;
  throw refuse("mapping.occupancy.max_range_m", "is " + shortestText(config.max_range_m),
               "it must be at least a voxel, " + shortestText(config.resolution_m) +
                   " m, and at most " + shortestText(longest_m) + " m");
}

constexpr double kMebibyte = 1048576.0;

/// What a node takes on the heap: 32 bytes for the node (16 and what the allocator adds), and in
/// every inner node 80 for the array of its children (64 and the same). 15 to 18 of 100 nodes are
/// inner ones in the maps of the recordings and the deep building: 44 to 46 bytes a node. Without
/// the allocator's part, as `memoryUsage` counts, it is 26 to 27.
constexpr std::size_t kBytesPerNode = 48;

/// A frame that spans more is walked ray by ray: its window would take too much memory.
constexpr std::size_t kMaxWindowBlocks = std::size_t{1} << 22;

/// Files carry the resolution in six digits.
void checkAgreement(double configured_m, double found_m) {
  constexpr double kRounding = 1e-5;
  if (std::abs(found_m - configured_m) <= kRounding * configured_m) return;
  throw refuse("map", "has voxels of " + std::to_string(found_m) + " m",
               "the configuration asks for resolution_m " + std::to_string(configured_m));
}

void clampLeaves(octomap::OcTree& tree, float lowest, float highest) {
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf)
    leaf->setLogOdds(std::min(std::max(leaf->getLogOdds(), lowest), highest));
}

octomap::point3d toOctomap(const Point3f& point) { return {point.x, point.y, point.z}; }

/// OctoMap converts coordinates to int before it compares, and prints when they are out of bounds.
bool insideMap(const octomap::OcTree& tree, const octomap::point3d& point) {
  const double reach_m = (kZeroKey + 1) * tree.getResolution();
  for (unsigned axis = 0; axis < 3; ++axis)
    if (!(std::abs(static_cast<double>(point(axis))) <= reach_m)) return false;
  octomap::OcTreeKey key;
  return tree.coordToKeyChecked(point, key);
}

}  // namespace

OccupancyMap::OccupancyMap(const OccupancyMapConfig& config)
    : config_(usable(config)),
      tree_(std::make_unique<VoxelTree>(config.resolution_m)),
      frame_(std::make_unique<FrameVoxels>()),
      rays_(std::make_unique<FrameRays>()),
      carver_(std::make_unique<FrameCarver>()),
      settled_(std::make_unique<SettledVoxels>()),
      workers_(std::make_unique<Workers>(config.threads)),
      ray_(std::make_unique<octomap::KeyRay>()) {
  tree_->setProbHit(config_.hit_probability);
  tree_->setProbMiss(config_.miss_probability);
  tree_->setClampingThresMin(config_.min_probability);
  tree_->setClampingThresMax(config_.max_probability);
}

OccupancyMap::OccupancyMap(const OccupancyMapConfig& config,
                           std::unique_ptr<octomap::OcTree> content)
    : OccupancyMap(config) {
  checkAgreement(config_.resolution_m, content->getResolution());
  cut_islands_ = removeFarIslands(*content);
  clampLeaves(*content, tree_->getClampingThresMinLog(), tree_->getClampingThresMaxLog());
  content->updateInnerOccupancy();
  content->prune();
  tree_->swapContent(*content);
  tree_->rebuildColumns();
}

OccupancyMap::OccupancyMap(OccupancyMap&&) noexcept = default;
OccupancyMap& OccupancyMap::operator=(OccupancyMap&&) noexcept = default;
OccupancyMap::~OccupancyMap() = default;

MapChange OccupancyMap::insert(const PointCloud& cloud) {
  MapChange change = refusal(cloud.origin);
  change.no_rays = cloud.points.empty() && cloud.misses.empty();
  if (change.ignored()) return change;
  const octomap::point3d origin = toOctomap(cloud.origin);
  frame_->clear();
  for (const Point3f& point : cloud.points)
    if (!markRay(origin, point, RayEnd::kHit)) ++change.points_outside_map;
  for (const Point3f& point : cloud.misses)
    if (!markRay(origin, point, RayEnd::kMiss)) ++change.points_outside_map;
  change.columns = integrate(frame_->settled());
  return change;
}

MapChange OccupancyMap::insert(const RangeImage& image) {
  if (config_.mode == IntegrationMode::kReference) return insert(toPointCloud(image));
  MapChange change = refusal(image.origin);
  change.origin_outside_map |= !isFinite(image.T_map_camera);
  change.no_rays = std::all_of(image.kinds.begin(), image.kinds.end(),
                               [](RayEnd kind) { return kind == RayEnd::kNone; });
  if (change.ignored()) return change;
  const octomap::OcTreeNode* voxel = tree_->search(toOctomap(image.origin));
  change.origin_occupied = voxel != nullptr && tree_->isNodeOccupied(voxel);
  if (change.ignored()) return change;
  change.points_outside_map =
      rays_->prepare(image, {config_.resolution_m, config_.max_range_m}, *workers_);
  if (FrameCarver::blocksBetween(rays_->bounds()) > kMaxWindowBlocks)
    return insert(toPointCloud(image));
  const Carving carving =
      config_.mode == IntegrationMode::kExact ? Carving::kExact : Carving::kFast;
  change.columns = integrate(carver_->carve(*rays_, image, *settled_, carving, *workers_));
  return change;
}

/// Says why a frame from `origin` cannot be used, if so.
MapChange OccupancyMap::refusal(const Point3f& origin) const {
  MapChange change;
  change.origin_outside_map = !insideMap(*tree_, toOctomap(origin));
  change.memory_exhausted = static_cast<double>(treeBytes()) >= config_.max_memory_mb * kMebibyte;
  return change;
}

std::size_t OccupancyMap::treeBytes() const {
  return tree_->size() * kBytesPerNode + settled_->memoryBytes();
}

std::size_t OccupancyMap::memoryBytes() const {
  return treeBytes() + tree_->columns().memoryBytes();
}

std::vector<Cell> OccupancyMap::integrate(const std::vector<VoxelBlock>& blocks) {
  return tree_->integrate(blocks, *settled_, *workers_);
}

/// @return false when the ray leaves the map or is none; nothing is marked then.
bool OccupancyMap::markRay(const octomap::point3d& origin, const Point3f& end, RayEnd meaning) {
  const octomap::point3d measured = toOctomap(end);
  const octomap::point3d ray = measured - origin;
  const double range_m = ray.norm();
  if (!std::isfinite(range_m)) return false;
  const bool cut = range_m > config_.max_range_m;
  // The arithmetic, in single precision, is that of insertPointCloud.
  const octomap::point3d last =
      cut ? origin + ray.normalized() * static_cast<float>(config_.max_range_m) : measured;
  if (!insideMap(*tree_, last)) return false;

  (void)tree_->computeRayKeys(origin, last, *ray_);  // false only when an end is outside the map
  for (const octomap::OcTreeKey& key : *ray_) frame_->markFree(key);
  if (meaning == RayEnd::kMiss) {
    frame_->markFree(tree_->coordToKey(last));
  } else if (!cut) {
    frame_->markOccupied(tree_->coordToKey(last));
  }
  return true;
}

const octomap::OcTree& OccupancyMap::tree() const { return *tree_; }

const VoxelColumns& OccupancyMap::columns() const { return tree_->columns(); }

void OccupancyMap::reset() {
  tree_->clear();
  settled_->clear();
}

}  // namespace occusg
