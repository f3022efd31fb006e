// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "occusg/geometry/cell.hpp"
#include "occusg/parameter.hpp"
#include "occusg/perception/point_cloud.hpp"
#include "occusg/perception/range_image.hpp"

namespace occusg {

/// Parts that were cut off a map because it spanned more than a free-space layer can.
struct FarIslands {
  std::size_t islands = 0;  ///< Parts with nothing known between them and the others.
  std::size_t nodes = 0;    ///< Nodes of the tree that went with them.
  double farthest_m = 0.0;  ///< Largest distance of one of them from what was kept, along an axis.

  [[nodiscard]] bool none() const { return islands == 0; }
};

/// "2 islands (1234 nodes, up to 900 m away) were cut off ...", for the user who loaded the map.
[[nodiscard]] std::string sentenceOn(const FarIslands& cut);

class FrameCarver;
class FrameRays;
class FrameVoxels;
class SettledVoxels;
class VoxelColumns;
class VoxelTree;
class Workers;
struct VoxelBlock;

/// How the voxels are found that a frame saw free.
enum class IntegrationMode {
  kReference,  ///< One ray a point, walked voxel by voxel: `insertPointCloud` node by node.
  /// The same voxels from the whole image at once: voxels differ only where a ray passes an edge of
  /// theirs within rounding.
  kExact,
  /// Voxels at the rim of what was seen are left out unless the ray nearest to their centre passes
  /// them: no voxel is free that is not in `kExact`.
  kFast,
};

/// Resolution, sensor model and limits of the map.
struct OccupancyMapConfig {
  double resolution_m = 0.05;     ///< Voxel edge [m], [0.001, 10].
  double max_range_m = 8.0;       ///< Rays are cut here, and a cut ray hits nothing [m].
  double hit_probability = 0.7;   ///< (0.5, 1).
  double miss_probability = 0.4;  ///< (0, 0.5).
  double min_probability = 0.12;  ///< Lower clamp, (0, 0.5).
  double max_probability = 0.97;  ///< Upper clamp, (0.5, 1).
  IntegrationMode mode = IntegrationMode::kExact;
  int threads = 1;  ///< That share a frame, [1, kMaxThreads]; results do not depend on it.
  double max_memory_mb = 2048.0;  ///< The tree takes no more frames beyond it [MiB], positive.
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(OccupancyMapConfig& config);

/// Longest range, in voxels.
inline constexpr double kMaxRangeVoxels = 30000.0;

inline constexpr int kMaxThreads = 64;

/// What one frame did to the map.
struct MapChange {
  /// Columns in which a voxel became known, free or occupied; row-major, unique.
  std::vector<Cell> columns;
  std::size_t points_outside_map = 0;  ///< Beyond OctoMap's 16-bit keys or not finite; ignored.
  bool origin_outside_map = false;     ///< The whole frame was ignored.
  bool origin_occupied = false;        ///< So it was: the sensor stood in an occupied voxel.
  bool no_rays = false;                ///< Nothing was measured.
  bool memory_exhausted = false;  ///< The whole frame was ignored: the map has reached its limit.

  /// Whether the frame reached the map at all.
  [[nodiscard]] bool ignored() const {
    return origin_outside_map || origin_occupied || no_rays || memory_exhausted;
  }
};

/// The 3D occupancy map, an `octomap::OcTree` others can read (paper, Sec. 3.2).
///
/// One update per voxel and frame: the voxels a ray passes get a miss, the voxel it ends in a hit,
/// and a hit wins over misses of the same frame. For a cloud without misses the tree equals that of
/// `octomap::OcTree::insertPointCloud(points, origin, max_range_m)`, node by node. So a ray that is
/// cut at the maximum range stops short of the voxel it is cut in; one that ends in a point of
/// `misses` clears that voxel too.
class OccupancyMap {
 public:
  /// @throws Error naming the field, its value and the allowed range; the maximum range must lie in
  /// [1, kMaxRangeVoxels] voxels.
  explicit OccupancyMap(const OccupancyMapConfig& config);
  /// A map that starts from `content`: its nodes are taken, and its inner values made the largest
  /// of the children, what can be pruned is, values are held within the clamps, and parts too far
  /// away for a free-space layer are cut off.
  /// @throws Error when the configuration is wrong or its resolution is not that of `content`.
  OccupancyMap(const OccupancyMapConfig& config, std::unique_ptr<octomap::OcTree> content);
  OccupancyMap(OccupancyMap&&) noexcept;
  OccupancyMap& operator=(OccupancyMap&&) noexcept;
  OccupancyMap(const OccupancyMap&) = delete;
  OccupancyMap& operator=(const OccupancyMap&) = delete;
  ~OccupancyMap();

  /// Integrates one frame. Linear in the voxels its rays pass.
  MapChange insert(const PointCloud& cloud);
  /// Integrates one frame that has its pixel lattice, which the modes other than `kReference` make
  /// use of: linear in the surface of the space its rays pass. They also ignore a frame from inside
  /// an occupied voxel: the pose or the map is wrong there.
  MapChange insert(const RangeImage& image);

  [[nodiscard]] const octomap::OcTree& tree() const;
  /// The states of the tree's voxels by column, for the free-space layer.
  [[nodiscard]] const VoxelColumns& columns() const;
  /// What the map and its columns hold, the tree estimated from the number of its nodes [bytes].
  [[nodiscard]] std::size_t memoryBytes() const;
  [[nodiscard]] const OccupancyMapConfig& config() const { return config_; }
  /// What was cut off the content the map started from.
  [[nodiscard]] const FarIslands& cutIslands() const { return cut_islands_; }
  /// Forgets everything.
  void reset();

 private:
  [[nodiscard]] std::size_t treeBytes() const;
  [[nodiscard]] MapChange refusal(const Point3f& origin) const;
  [[nodiscard]] std::vector<Cell> integrate(const std::vector<VoxelBlock>& blocks);
  [[nodiscard]] bool markRay(const octomap::point3d& origin, const Point3f& end, RayEnd meaning);

  OccupancyMapConfig config_;
  FarIslands cut_islands_;
  std::unique_ptr<VoxelTree> tree_;
  std::unique_ptr<FrameVoxels> frame_;  ///< Reused between frames, as what follows.
  std::unique_ptr<FrameRays> rays_;
  std::unique_ptr<FrameCarver> carver_;
  std::unique_ptr<SettledVoxels> settled_;
  std::unique_ptr<Workers> workers_;
  /// Reused between rays. Behind a pointer, as moving a KeyRay may throw.
  std::unique_ptr<octomap::KeyRay> ray_;
};

}  // namespace occusg
