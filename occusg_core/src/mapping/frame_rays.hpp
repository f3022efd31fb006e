// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/workers.hpp"
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

/// So many rays are treated at once.
inline constexpr int kRaysAtOnce = 8;
using Float8 = Eigen::Array<float, kRaysAtOnce, 1>;

/// The rays of one frame in voxels from the sensor, cut at the maximum range, by pixel of the
/// lattice. Arrays are longer than the lattice by kRaysAtOnce rays that meet nothing.
class FrameRays {
 public:
  /// @return the number of rays left out: they end outside the map or nowhere.
  std::size_t prepare(const RangeImage& image, const RayLimits& limits, Workers& workers);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] double resolution_m() const { return limits_.resolution_m; }
  /// Along the optical axis, of the rays' ends; 0 where there is no ray.
  [[nodiscard]] const std::vector<float>& depth() const { return depth_; }
  [[nodiscard]] float largestDepth() const { return largest_depth_; }
  /// 1 / (end - sensor) by axis; kNoRay on all of them where there is no ray.
  [[nodiscard]] const std::array<std::vector<float>, 3>& inverse() const { return inverse_; }
  /// Calls `visit` with every voxel a ray ends in, some of them several times.
  template <typename Visit>
  void forEachMark(Visit&& visit) const {
    for (const Band& band : bands_)
      for (const MarkedVoxel& mark : band.marks) visit(mark);
  }
  /// Sensor position.
  [[nodiscard]] const std::array<double, 3>& origin() const { return origin_; }
  /// Bounds of all rays; the lower corner is in, the upper is not.
  [[nodiscard]] const std::array<VoxelIndex, 2>& bounds() const { return bounds_; }

  /// Inverse of a direction that is no ray's: large, and small enough for products to stay finite.
  static constexpr float kNoRay = 1e20F;

 private:
  /// Names of the voxels the rays of a row end in, to tell whether two rays end in the same one.
  struct RowNames {
    std::vector<std::uint32_t> xy;
    std::vector<std::uint32_t> z_and_kind;
  };

  /// Rows of the lattice that one thread prepares, and one row on its way.
  struct Band {
    std::array<std::vector<float>, 3> direction;  ///< Uncut [m].
    std::vector<float> squared_range;             ///< [m2]
    std::vector<float> cut;                       ///< Share of the ray that counts, 1 for all.
    std::vector<RayEnd> kinds;
    RowNames names;
    RowNames names_above;
    std::vector<std::uint8_t> is_new;  ///< Whether a ray's end is no neighbour's.
    std::array<float, 3> lowest{};     ///< Of the cut rays, from the sensor [m].
    std::array<float, 3> highest{};
    float largest_depth = 0.0F;
    std::vector<MarkedVoxel> marks;
    std::size_t dropped = 0;
  };

  void resize(const RangeImage& image, int bands);
  void prepareRow(const RangeImage& image, std::size_t first, Band& band);
  void measure(const RangeImage& image, std::size_t first, Band& band) const;
  void dropUnusable(Band& band) const;
  void cutAndInvert(std::size_t first, Band& band);
  void nameEnds(Band& band) const;
  void findNewEnds(Band& band) const;
  void mark(const RangeImage& image, std::size_t first, Band& band) const;
  void markEnd(const RangeImage& image, std::size_t first, std::size_t column, Band& band) const;
  void setBounds();

  RayLimits limits_;
  float max_squared_range_ = 0.0F;      ///< The largest that is not beyond the range [m2].
  std::array<float, 3> name_origin_{};  ///< Place of the sensor in the names of voxels.
  std::array<int, 3> name_base_{};      ///< Voxel of the name 0.
  float surely_inside_ = 0.0F;          ///< A voxel, so far from its centre at most.
  int width_ = 0;
  int height_ = 0;
  std::array<float, 3> forward_{};  ///< Optical axis in the map frame.
  std::array<double, 3> origin_{};
  std::array<VoxelIndex, 2> bounds_{};
  float largest_depth_ = 0.0F;
  std::vector<float> depth_;
  std::array<std::vector<float>, 3> inverse_;
  std::vector<Band> bands_;
};

}  // namespace occusg
