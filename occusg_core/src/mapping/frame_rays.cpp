// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/frame_rays.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace occusg {
namespace {

using Floats = Eigen::Map<Eigen::ArrayXf>;

/// OctoMap's keys reach from -2^15 to 2^15 - 1.
constexpr int kLowestVoxel = -32768;
constexpr int kHighestVoxel = 32767;

Floats view(std::vector<float>& values, std::size_t first, std::size_t count) {
  return {values.data() + first, static_cast<Eigen::Index>(count)};
}

int floorToInt(double number) {
  // Far beyond the map, and not a number, is as good as this far beyond it.
  const double value = std::min(1e9, std::max(-1e9, number));
  const int truncated = static_cast<int>(value);
  return truncated - (value < truncated ? 1 : 0);
}

float coordinate(const Point3f& point, std::size_t axis) {
  return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

bool insideMap(double voxels) {
  return voxels >= kLowestVoxel && voxels < static_cast<double>(kHighestVoxel) + 1.0;
}

}  // namespace

std::size_t FrameRays::prepare(const RangeImage& image, const RayLimits& limits) {
  limits_ = limits;
  resize(image);
  std::size_t dropped = 0;
  const auto width = static_cast<std::size_t>(width_);
  for (std::size_t first = 0; first < image.ends.size(); first += width) {
    std::copy_n(image.kinds.begin() + static_cast<std::ptrdiff_t>(first), width,
                row_.kinds.begin());
    measure(image, first);
    dropped += dropUnusable(image);
    cutAndInvert(first);
    findVoxels(image, first);
    mark(image, first);
  }
  setBounds();
  return dropped;
}

void FrameRays::resize(const RangeImage& image) {
  width_ = image.camera.width;
  height_ = image.camera.height;
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t padded = image.ends.size() + kRaysAtOnce;
  depth_.resize(padded);
  std::fill(depth_.end() - kRaysAtOnce, depth_.end(), 0.0F);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    inverse_[axis].resize(padded);
    std::fill(inverse_[axis].end() - kRaysAtOnce, inverse_[axis].end(), kNoRay);
    row_.direction[axis].resize(width);
    row_.voxel[axis].resize(width);
    forward_[axis] = static_cast<float>(
        image.T_map_camera.linear()(static_cast<Eigen::Index>(axis), 2));
    origin_[axis] = static_cast<double>(coordinate(image.origin, axis));
  }
  row_.squared_range.resize(width);
  row_.cut.resize(width);
  row_.kinds.resize(width);
  lowest_ = {};
  highest_ = {};
  marks_.clear();
}

void FrameRays::measure(const RangeImage& image, std::size_t first) {
  const Point3f* ends = image.ends.data() + first;
  const Point3f origin = image.origin;
  const std::size_t count = row_.kinds.size();
  float* x = row_.direction[0].data();
  float* y = row_.direction[1].data();
  float* z = row_.direction[2].data();
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_ray = row_.kinds[i] != RayEnd::kNone;
    x[i] = is_ray ? ends[i].x - origin.x : 0.0F;
    y[i] = is_ray ? ends[i].y - origin.y : 0.0F;
    z[i] = is_ray ? ends[i].z - origin.z : 0.0F;
  }
  const auto dx = view(row_.direction[0], 0, count);
  const auto dy = view(row_.direction[1], 0, count);
  const auto dz = view(row_.direction[2], 0, count);
  view(row_.squared_range, 0, count) = dx * dx + dy * dy + dz * dz;
}

/// Takes rays that end nowhere or outside the map out of the row.
std::size_t FrameRays::dropUnusable(const RangeImage& image) {
  const std::size_t count = row_.kinds.size();
  bool near_edge = false;
  for (const double origin_m : origin_)
    near_edge |= !insideMap((std::abs(origin_m) + limits_.max_range_m) / limits_.resolution_m + 2);
  const bool finite = std::isfinite(view(row_.squared_range, 0, count).sum());
  if (finite && !near_edge) return 0;
  (void)image;
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (row_.kinds[i] == RayEnd::kNone) continue;
    const auto squared = static_cast<double>(row_.squared_range[i]);
    bool usable = std::isfinite(squared);
    if (usable) {
      const double cut = std::min(1.0, limits_.max_range_m / std::sqrt(squared));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double end_m =
            origin_[axis] + (squared > 0.0 ? cut : 1.0) * static_cast<double>(row_.direction[axis][i]);
        usable = usable && insideMap(std::floor(end_m / limits_.resolution_m));
      }
    }
    if (usable) continue;
    ++dropped;
    row_.kinds[i] = RayEnd::kNone;
    row_.squared_range[i] = 0.0F;
    for (auto& direction : row_.direction) direction[i] = 0.0F;
  }
  return dropped;
}

void FrameRays::cutAndInvert(std::size_t first) {
  const std::size_t count = row_.kinds.size();
  auto cut = view(row_.cut, 0, count);
  const auto resolution_m = static_cast<float>(limits_.resolution_m);
  cut = (static_cast<float>(limits_.max_range_m) / view(row_.squared_range, 0, count).sqrt())
            .min(1.0F);
  auto depth = view(depth_, first, count);
  depth = forward_[0] * view(row_.direction[0], 0, count) +
          forward_[1] * view(row_.direction[1], 0, count) +
          forward_[2] * view(row_.direction[2], 0, count);
  depth = (depth * cut * (1.0F / resolution_m)).max(0.0F);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto inverse = view(inverse_[axis], first, count);
    inverse = view(row_.direction[axis], 0, count) * cut;
    lowest_[axis] = std::min(lowest_[axis], inverse.minCoeff());
    highest_[axis] = std::max(highest_[axis], inverse.maxCoeff());
    inverse = (resolution_m / inverse).min(kNoRay).max(-kNoRay);
  }
}

/// Voxels of the ends, as OctoMap finds them: in double precision.
void FrameRays::findVoxels(const RangeImage& image, std::size_t first) {
  const double voxels_per_m = 1.0 / limits_.resolution_m;
  const Point3f* ends = image.ends.data() + first;
  const std::size_t count = row_.kinds.size();
  int* x = row_.voxel[0].data();
  int* y = row_.voxel[1].data();
  int* z = row_.voxel[2].data();
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = floorToInt(voxels_per_m * static_cast<double>(ends[i].x));
    y[i] = floorToInt(voxels_per_m * static_cast<double>(ends[i].y));
    z[i] = floorToInt(voxels_per_m * static_cast<double>(ends[i].z));
  }
}

void FrameRays::mark(const RangeImage& image, std::size_t first) {
  const double max_squared = limits_.max_range_m * limits_.max_range_m;
  const double voxels_per_m = 1.0 / limits_.resolution_m;
  MarkedVoxel last;
  for (std::size_t i = 0; i < row_.kinds.size(); ++i) {
    const RayEnd kind = row_.kinds[i];
    if (kind == RayEnd::kNone) continue;
    VoxelIndex voxel{row_.voxel[0][i], row_.voxel[1][i], row_.voxel[2][i]};
    if (static_cast<double>(row_.squared_range[i]) > max_squared) {
      if (kind == RayEnd::kHit) continue;
      const float cut = row_.cut[i];
      voxel = {floorToInt(voxels_per_m *
                          static_cast<double>(image.origin.x + row_.direction[0][i] * cut)),
               floorToInt(voxels_per_m *
                          static_cast<double>(image.origin.y + row_.direction[1][i] * cut)),
               floorToInt(voxels_per_m *
                          static_cast<double>(image.origin.z + row_.direction[2][i] * cut))};
    }
    if (voxel.x == last.voxel.x && voxel.y == last.voxel.y && voxel.z == last.voxel.z &&
        kind == last.kind)
      continue;
    last = {voxel, kind};
    marks_.push_back(last);
  }
  (void)first;
}

void FrameRays::setBounds() {
  const double voxels_per_m = 1.0 / limits_.resolution_m;
  std::array<std::array<int, 3>, 2> bounds{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = (origin_[axis] + static_cast<double>(lowest_[axis])) * voxels_per_m;
    const double high = (origin_[axis] + static_cast<double>(highest_[axis])) * voxels_per_m;
    bounds[0][axis] = std::max(floorToInt(low) - 1, kLowestVoxel);
    bounds[1][axis] = std::min(floorToInt(high) + 1, kHighestVoxel) + 1;
  }
  bounds_ = {VoxelIndex{bounds[0][0], bounds[0][1], bounds[0][2]},
             VoxelIndex{bounds[1][0], bounds[1][1], bounds[1][2]}};
}

}  // namespace occusg
