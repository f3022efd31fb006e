// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "occusg/perception/range_image.hpp"

namespace occusg {

/// Where a frame's rays are cut and what a voxel is.
struct RayLimits {
  double resolution_m = 0.05;
  double max_range_m = 8.0;
};

/// Voxel by world-aligned indices.
struct VoxelIndex {
  int x = 0;
  int y = 0;
  int z = 0;
};

/// Voxel in which a ray ends, and what that says about it.
struct MarkedVoxel {
  VoxelIndex voxel;
  RayEnd kind = RayEnd::kNone;
};

/// So many rays are tested at once.
inline constexpr int kRaysAtOnce = 8;

/// The rays of one frame in voxels from the sensor, cut at the maximum range, by pixel of the
/// lattice. Arrays are longer than the lattice by kRaysAtOnce rays that meet nothing.
class FrameRays {
 public:
  /// @return the number of rays left out: they end outside the map or nowhere.
  std::size_t prepare(const RangeImage& image, const RayLimits& limits);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Along the optical axis, of the rays' ends; 0 where there is no ray.
  [[nodiscard]] const std::vector<float>& depth() const { return depth_; }
  /// 1 / (end - sensor) by axis; kNoRay on all of them where there is no ray.
  [[nodiscard]] const std::array<std::vector<float>, 3>& inverse() const { return inverse_; }
  /// Distinct neighbours in row-major order; a voxel may come again later.
  [[nodiscard]] const std::vector<MarkedVoxel>& marks() const { return marks_; }
  /// Sensor position.
  [[nodiscard]] const std::array<double, 3>& origin() const { return origin_; }
  /// Bounds of all rays; the lower corner is in, the upper is not.
  [[nodiscard]] const std::array<VoxelIndex, 2>& bounds() const { return bounds_; }

  /// Inverse of a direction that is no ray's: large, and small enough for products to stay finite.
  static constexpr float kNoRay = 1e20F;

 private:
  /// One row of the lattice on its way through `prepare`.
  struct Row {
    std::array<std::vector<float>, 3> direction;  ///< Uncut [m].
    std::vector<float> squared_range;             ///< [m2]
    std::vector<float> cut;                       ///< Share of the ray that counts, 1 for all.
    std::array<std::vector<int>, 3> voxel;        ///< Of the uncut end.
    std::vector<RayEnd> kinds;
  };

  void resize(const RangeImage& image);
  void measure(const RangeImage& image, std::size_t first);
  [[nodiscard]] std::size_t dropUnusable(const RangeImage& image);
  void cutAndInvert(std::size_t first);
  void mark(const RangeImage& image, std::size_t first);
  void findVoxels(const RangeImage& image, std::size_t first);
  void setBounds();

  RayLimits limits_;
  int width_ = 0;
  int height_ = 0;
  std::array<float, 3> forward_{};  ///< Optical axis in the map frame.
  std::array<double, 3> origin_{};
  std::array<float, 3> lowest_{};  ///< Of the cut rays, from the sensor [m].
  std::array<float, 3> highest_{};
  std::array<VoxelIndex, 2> bounds_{};
  std::vector<float> depth_;
  std::array<std::vector<float>, 3> inverse_;
  std::vector<MarkedVoxel> marks_;
  Row row_;
};

}  // namespace occusg
