// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "mapping/depth_bounds.hpp"
#include "mapping/frame_rays.hpp"
#include "occusg/perception/range_image.hpp"

namespace occusg {

/// A place seen from the camera, in voxels; x and y are multiplied by the focal lengths, so that
/// x / z and y / z are pixels from the principal point.
struct ViewPoint {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
};

inline ViewPoint operator+(const ViewPoint& a, const ViewPoint& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline ViewPoint operator*(float scale, const ViewPoint& point) {
  return {scale * point.x, scale * point.y, scale * point.z};
}

/// The corners of a cube about its centre, in Morton order (bit 0: +x, 1: +y, 2: +z of the map).
struct CubeCorners {
  Float8 x;
  Float8 y;
  Float8 z;
  float width = 0.0F;  ///< Half extents, as the corners.
  float height = 0.0F;
  float depth = 0.0F;  ///< Along the optical axis.

  [[nodiscard]] ViewPoint operator[](unsigned corner) const {
    return {x[corner], y[corner], z[corner]};
  }
};

/// Whether every ray that could cross a cube is in the image.
enum class Coverage { kNone, kPart, kWhole };

/// Where cubes of voxels lie on the pixel lattice of one frame.
class LatticeProjection {
 public:
  /// Cubes have edges of 8, 4, 2 and 1 voxels.
  static constexpr std::size_t kSizes = 4;

  /// @param slack_pixels by which rays may miss the pixel's exact direction.
  LatticeProjection(const RangeImage& image, float slack_pixels);
  LatticeProjection() = default;

  [[nodiscard]] const CubeCorners& corners(std::size_t size) const { return corners_[size]; }
  /// A step of one voxel along an axis of the map.
  [[nodiscard]] const ViewPoint& step(std::size_t axis) const { return steps_[axis]; }

  /// The pixels whose rays can cross a cube; `box` is set unless there are none.
  [[nodiscard]] Coverage boxOf(const ViewPoint& center, std::size_t size, PixelBox& box) const {
    const CubeCorners& cube = corners_[size];
    if (center.z - cube.depth < kNearest) {
      // The cube reaches behind the camera, where projection means nothing.
      box = {0, width_ - 1, 0, height_ - 1};
      return mayCross(center, size, box) ? Coverage::kPart : Coverage::kNone;
    }
    const Float8 inverse = (cube.z + center.z).inverse();
    const Float8 u = (cube.x + center.x) * inverse;
    const Float8 v = (cube.y + center.y) * inverse;
    const float left = u.minCoeff() + cx_ - slack_pixels_;
    const float right = u.maxCoeff() + cx_ + slack_pixels_;
    const float top = v.minCoeff() + cy_ - slack_pixels_;
    const float bottom = v.maxCoeff() + cy_ + slack_pixels_;
    if (!(right >= 0.0F && left <= last_column_ && bottom >= 0.0F && top <= last_row_))
      return Coverage::kNone;
    box.left = ceilOf(std::max(left, 0.0F));
    box.right = static_cast<int>(std::min(right, last_column_));
    box.top = ceilOf(std::max(top, 0.0F));
    box.bottom = static_cast<int>(std::min(bottom, last_row_));
    if (box.empty()) return Coverage::kNone;
    const bool whole = left >= 0.0F && right <= last_column_ && top >= 0.0F && bottom <= last_row_;
    return whole ? Coverage::kWhole : Coverage::kPart;
  }

  /// False when a cube lies wholly to one side of all rays of the box.
  [[nodiscard]] bool mayCross(const ViewPoint& center, std::size_t size,
                              const PixelBox& box) const {
    const CubeCorners& cube = corners_[size];
    const Float8 x = cube.x + center.x;
    const Float8 y = cube.y + center.y;
    const Float8 z = cube.z + center.z;
    const float left = static_cast<float>(box.left) - slack_pixels_ - cx_;
    const float right = static_cast<float>(box.right) + slack_pixels_ - cx_;
    const float top = static_cast<float>(box.top) - slack_pixels_ - cy_;
    const float bottom = static_cast<float>(box.bottom) + slack_pixels_ - cy_;
    return z.maxCoeff() > 0.0F && (x - left * z).maxCoeff() >= 0.0F &&
           (x - right * z).minCoeff() <= 0.0F && (y - top * z).maxCoeff() >= 0.0F &&
           (y - bottom * z).minCoeff() <= 0.0F;
  }

  /// The pixel nearest to where the centre of a voxel is seen.
  struct CenterPixel {
    int column = 0;
    int row = 0;
    bool surely_crossed = false;  ///< The pixel's ray, if there is one, crosses the voxel.
  };

  /// For each of the eight voxels about `center`.
  [[nodiscard]] std::array<CenterPixel, 8> centerPixels(const ViewPoint& center) const {
    const CubeCorners& offsets = corners_[kSizes - 1];
    const Float8 z = (offsets.z + center.z).max(kNearest);
    const Float8 inverse = z.inverse();
    const Float8 u = (offsets.x + center.x) * inverse + cx_;
    const Float8 v = (offsets.y + center.y) * inverse + cy_;
    const Float8 column = u.max(0.0F).min(last_column_) + 0.5F;
    const Float8 row = v.max(0.0F).min(last_row_) + 0.5F;
    std::array<CenterPixel, 8> pixels{};
    for (int i = 0; i < 8; ++i) {
      CenterPixel& pixel = pixels[static_cast<std::size_t>(i)];
      pixel.column = static_cast<int>(column[i]);
      pixel.row = static_cast<int>(row[i]);
      const float x = (static_cast<float>(pixel.column) - u[i]) * pitch_x_ * z[i];
      const float y = (static_cast<float>(pixel.row) - v[i]) * pitch_y_ * z[i];
      pixel.surely_crossed = z[i] > kNearest && x * x + y * y <= kSurelyCrossed * kSurelyCrossed;
    }
    return pixels;
  }

  /// Columns to both sides of its centre's pixel a cube covers, when it is not far off the axis.
  [[nodiscard]] int columnsAbout(const ViewPoint& center, std::size_t size) const {
    return static_cast<int>(corners_[size].width / std::max(center.z, kNearest) + kToNearest);
  }
  [[nodiscard]] int rowsAbout(const ViewPoint& center, std::size_t size) const {
    return static_cast<int>(corners_[size].height / std::max(center.z, kNearest) + kToNearest);
  }
  /// Rows over a length at a depth, both in voxels.
  [[nodiscard]] float rowsOver(float length, float depth) const {
    return length / (pitch_y_ * std::max(depth, kNearest));
  }

  /// Up to this depth every voxel is crossed by a ray, if none is missing.
  [[nodiscard]] float denseDepth() const { return dense_depth_; }

 private:
  static constexpr float kToNearest = 0.5F;       ///< Makes a cast round; nothing is negative here.
  static constexpr float kNearest = 0.05F;        ///< Voxels in front of the camera.
  static constexpr float kSurelyCrossed = 0.48F;  ///< Below the radius of a voxel's inner sphere.

  static int ceilOf(float value) {
    const int truncated = static_cast<int>(value);
    return truncated + (static_cast<float>(truncated) < value ? 1 : 0);
  }

  std::array<CubeCorners, kSizes> corners_;
  std::array<ViewPoint, 3> steps_;
  int width_ = 0;
  int height_ = 0;
  float last_column_ = 0.0F;
  float last_row_ = 0.0F;
  float cx_ = 0.0F;
  float cy_ = 0.0F;
  float pitch_x_ = 0.0F;  ///< Distance of two pixels at depth 1.
  float pitch_y_ = 0.0F;
  float dense_depth_ = 0.0F;
  float slack_pixels_ = 0.0F;
};

}  // namespace occusg
