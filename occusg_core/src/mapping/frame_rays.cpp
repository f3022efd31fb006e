// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/frame_rays.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

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

/// As OctoMap finds it: in double precision.
VoxelIndex voxelAt(const Point3f& point, double resolution_m) {
  const double voxels_per_m = 1.0 / resolution_m;
  return {floorToInt(voxels_per_m * static_cast<double>(point.x)),
          floorToInt(voxels_per_m * static_cast<double>(point.y)),
          floorToInt(voxels_per_m * static_cast<double>(point.z))};
}

/// Places in a voxel, 0 to 1, closer to its faces may be in the next one when found in double
/// precision: 1 / 128 voxel is the rounding at the map's far end.
constexpr float kUncertain = 0.01F;

/// In the names of ends: these two never name the same voxel as any other.
constexpr std::uint32_t kUncertainName = std::uint32_t{1} << 31;
constexpr std::uint32_t kNoName = ~std::uint32_t{0};
constexpr unsigned kKindShift = 16;

float coordinate(const Point3f& point, std::size_t axis) {
  return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

bool insideMap(double voxels) {
  return voxels >= kLowestVoxel && voxels < static_cast<double>(kHighestVoxel) + 1.0;
}

}  // namespace

std::size_t FrameRays::prepare(const RangeImage& image, const RayLimits& limits, Workers& workers) {
  limits_ = limits;
  const double max_squared = limits.max_range_m * limits.max_range_m;
  max_squared_range_ = static_cast<float>(max_squared);
  if (static_cast<double>(max_squared_range_) > max_squared)
    max_squared_range_ = std::nextafter(max_squared_range_, 0.0F);
  resize(image, workers.threads());
  workers.run(workers.threads(), [&](int index) {
    Band& band = bands_[static_cast<std::size_t>(index)];
    const int end = height_ * (index + 1) / workers.threads();
    for (int row = height_ * index / workers.threads(); row < end; ++row)
      prepareRow(image, static_cast<std::size_t>(row) * static_cast<std::size_t>(width_), band);
  });
  setBounds();
  std::size_t dropped = 0;
  for (const Band& band : bands_) dropped += band.dropped;
  return dropped;
}

void FrameRays::resize(const RangeImage& image, int bands) {
  width_ = image.camera.width;
  height_ = image.camera.height;
  const std::size_t padded = image.ends.size() + kRaysAtOnce;
  depth_.resize(padded);
  std::fill(depth_.end() - kRaysAtOnce, depth_.end(), 0.0F);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    inverse_[axis].resize(padded);
    std::fill(inverse_[axis].end() - kRaysAtOnce, inverse_[axis].end(), kNoRay);
    forward_[axis] =
        static_cast<float>(image.T_map_camera.linear()(static_cast<Eigen::Index>(axis), 2));
    origin_[axis] = static_cast<double>(coordinate(image.origin, axis));
    const double place = origin_[axis] / limits_.resolution_m;
    const double reach = std::ceil(limits_.max_range_m / limits_.resolution_m) + 2.0;
    name_origin_[axis] = static_cast<float>(place - std::floor(place) + reach);
  }
  const auto width = static_cast<std::size_t>(width_);
  bands_.resize(static_cast<std::size_t>(bands));
  for (Band& band : bands_) {
    for (auto& direction : band.direction) direction.resize(width);
    band.squared_range.resize(width);
    band.cut.resize(width);
    band.kinds.resize(width);
    band.columns.resize(width);
    for (RowNames* names : {&band.names, &band.names_above}) {
      names->xy.resize(width);
      names->z_and_kind.assign(width, kNoName);
    }
    band.lowest = {};
    band.highest = {};
    band.marks.clear();
    band.dropped = 0;
  }
}

void FrameRays::prepareRow(const RangeImage& image, std::size_t first, Band& band) {
  std::copy_n(image.kinds.begin() + static_cast<std::ptrdiff_t>(first), band.kinds.size(),
              band.kinds.begin());
  measure(image, first, band);
  dropUnusable(band);
  cutAndInvert(first, band);
  mark(image, first, band);
}

void FrameRays::measure(const RangeImage& image, std::size_t first, Band& band) const {
  const Point3f* ends = image.ends.data() + first;
  const Point3f origin = image.origin;
  const std::size_t count = band.kinds.size();
  const RayEnd* kinds = band.kinds.data();
  float* x = band.direction[0].data();
  float* y = band.direction[1].data();
  float* z = band.direction[2].data();
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_ray = kinds[i] != RayEnd::kNone;
    const float away_x = ends[i].x - origin.x;
    const float away_y = ends[i].y - origin.y;
    const float away_z = ends[i].z - origin.z;
    x[i] = is_ray ? away_x : 0.0F;
    y[i] = is_ray ? away_y : 0.0F;
    z[i] = is_ray ? away_z : 0.0F;
  }
  const auto dx = view(band.direction[0], 0, count);
  const auto dy = view(band.direction[1], 0, count);
  const auto dz = view(band.direction[2], 0, count);
  view(band.squared_range, 0, count) = dx * dx + dy * dy + dz * dz;
}

/// Takes rays that end nowhere or outside the map out of the row.
void FrameRays::dropUnusable(Band& band) const {
  const std::size_t count = band.kinds.size();
  bool is_near_edge = false;
  for (const double origin_m : origin_) {
    is_near_edge |=
        !insideMap((std::abs(origin_m) + limits_.max_range_m) / limits_.resolution_m + 2);
  }
  if (!is_near_edge && std::isfinite(view(band.squared_range, 0, count).sum())) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (band.kinds[i] == RayEnd::kNone) continue;
    const auto squared = static_cast<double>(band.squared_range[i]);
    const double range_m = std::sqrt(squared);
    const double cut = range_m > limits_.max_range_m ? limits_.max_range_m / range_m : 1.0;
    bool is_usable = std::isfinite(squared);
    for (std::size_t axis = 0; is_usable && axis < 3; ++axis) {
      const double end_m = origin_[axis] + cut * static_cast<double>(band.direction[axis][i]);
      is_usable = insideMap(std::floor(end_m / limits_.resolution_m));
    }
    if (is_usable) continue;
    ++band.dropped;
    band.kinds[i] = RayEnd::kNone;
    band.squared_range[i] = 0.0F;
    for (auto& direction : band.direction) direction[i] = 0.0F;
  }
}

void FrameRays::cutAndInvert(std::size_t first, Band& band) {
  const std::size_t count = band.kinds.size();
  auto cut = view(band.cut, 0, count);
  const auto resolution_m = static_cast<float>(limits_.resolution_m);
  cut = (static_cast<float>(limits_.max_range_m) / view(band.squared_range, 0, count).sqrt())
            .min(1.0F);
  auto depth = view(depth_, first, count);
  depth = forward_[0] * view(band.direction[0], 0, count) +
          forward_[1] * view(band.direction[1], 0, count) +
          forward_[2] * view(band.direction[2], 0, count);
  depth = (depth * cut * (1.0F / resolution_m)).max(0.0F);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto inverse = view(inverse_[axis], first, count);
    inverse = view(band.direction[axis], 0, count) * cut;
    band.lowest[axis] = std::min(band.lowest[axis], inverse.minCoeff());
    band.highest[axis] = std::max(band.highest[axis], inverse.maxCoeff());
    inverse = (resolution_m / inverse).min(kNoRay).max(-kNoRay);
  }
}

void FrameRays::nameEnds(Band& band) const {
  const std::size_t count = band.kinds.size();
  const auto voxels_per_m = static_cast<float>(1.0 / limits_.resolution_m);
  const float* x = band.direction[0].data();
  const float* y = band.direction[1].data();
  const float* z = band.direction[2].data();
  const float* cut = band.cut.data();
  const float* squared_range = band.squared_range.data();
  const RayEnd* kinds = band.kinds.data();
  std::uint32_t* xy = band.names.xy.data();
  std::uint32_t* z_and_kind = band.names.z_and_kind.data();
  const auto [from_x, from_y, from_z] = name_origin_;
  const float max_squared = max_squared_range_;
  for (std::size_t i = 0; i < count; ++i) {
    const float scale = cut[i] * voxels_per_m;
    const float at_x = x[i] * scale + from_x;
    const float at_y = y[i] * scale + from_y;
    const float at_z = z[i] * scale + from_z;
    const auto cell_x = static_cast<std::int32_t>(at_x);
    const auto cell_y = static_cast<std::int32_t>(at_y);
    const auto cell_z = static_cast<std::int32_t>(at_z);
    const float off_x = std::abs(at_x - static_cast<float>(cell_x) - 0.5F);
    const float off_y = std::abs(at_y - static_cast<float>(cell_y) - 0.5F);
    const float off_z = std::abs(at_z - static_cast<float>(cell_z) - 0.5F);
    const float off = std::max(off_x, std::max(off_y, off_z));
    const auto kind = static_cast<std::uint32_t>(kinds[i]);
    // A hit beyond the range marks nothing: its end is that of another kind.
    const std::uint32_t beyond = squared_range[i] > max_squared ? 4U : 0U;
    const std::uint32_t uncertain = off > 0.5F - kUncertain ? kUncertainName : 0U;
    xy[i] = static_cast<std::uint32_t>(cell_x) | static_cast<std::uint32_t>(cell_y) << 16;
    z_and_kind[i] = static_cast<std::uint32_t>(cell_z) | (kind | beyond) << kKindShift | uncertain;
  }
}

/// The columns, in the first entries of `columns`, whose rays end elsewhere than those of the
/// pixels to the left and above, or may do so. @return how many there are.
std::size_t FrameRays::findNewEnds(Band& band) {
  std::size_t found = 0;
  std::uint32_t left_xy = 0;
  std::uint32_t left_z = kNoName;
  for (std::size_t i = 0; i < band.kinds.size(); ++i) {
    const std::uint32_t xy = band.names.xy[i];
    const std::uint32_t z = band.names.z_and_kind[i];
    const std::uint32_t from_left = (xy ^ left_xy) | (z ^ left_z);
    const std::uint32_t from_above =
        (xy ^ band.names_above.xy[i]) | (z ^ band.names_above.z_and_kind[i]);
    const bool is_same = from_left == 0 || from_above == 0;
    band.columns[found] = static_cast<std::uint32_t>(i);
    found += static_cast<std::size_t>(!is_same || z >= kUncertainName);
    left_xy = xy;
    left_z = z;
  }
  return found;
}

void FrameRays::mark(const RangeImage& image, std::size_t first, Band& band) const {
  nameEnds(band);
  const std::size_t found = findNewEnds(band);
  const Point3f* ends = image.ends.data() + first;
  for (std::size_t k = 0; k < found; ++k) {
    const std::size_t i = band.columns[k];
    const RayEnd kind = band.kinds[i];
    if (kind == RayEnd::kNone) continue;
    Point3f end = ends[i];
    if (band.squared_range[i] > max_squared_range_) {
      if (kind == RayEnd::kHit) continue;
      const float cut = band.cut[i];
      end = {image.origin.x + band.direction[0][i] * cut,
             image.origin.y + band.direction[1][i] * cut,
             image.origin.z + band.direction[2][i] * cut};
    }
    band.marks.push_back({voxelAt(end, limits_.resolution_m), kind});
  }
  std::swap(band.names, band.names_above);
}

void FrameRays::setBounds() {
  const double voxels_per_m = 1.0 / limits_.resolution_m;
  std::array<std::array<int, 3>, 2> bounds{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float lowest = 0.0F;
    float highest = 0.0F;
    for (const Band& band : bands_) {
      lowest = std::min(lowest, band.lowest[axis]);
      highest = std::max(highest, band.highest[axis]);
    }
    const double low = (origin_[axis] + static_cast<double>(lowest)) * voxels_per_m;
    const double high = (origin_[axis] + static_cast<double>(highest)) * voxels_per_m;
    bounds[0][axis] = std::max(floorToInt(low) - 1, kLowestVoxel);
    bounds[1][axis] = std::min(floorToInt(high) + 1, kHighestVoxel) + 1;
  }
  bounds_ = {VoxelIndex{bounds[0][0], bounds[0][1], bounds[0][2]},
             VoxelIndex{bounds[1][0], bounds[1][1], bounds[1][2]}};
}

}  // namespace occusg
