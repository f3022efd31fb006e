// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/frame_rays.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
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

Eigen::Map<const Float8> at(const std::vector<float>& values, std::size_t first) {
  return Eigen::Map<const Float8>(values.data() + first);
}

/// The first of eight values.
void store(const Float8& values, std::size_t count, float* to) {
  if (count == kRaysAtOnce) {
    Eigen::Map<Float8>{to} = values;
  } else {
    std::copy_n(values.data(), count, to);
  }
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
/// precision; roundings in single precision, of which there are fewer than these, come on top.
constexpr float kUncertain = 0.001F;
constexpr float kRoundings = 16.0F;

/// In the names of ends: these two never name the same voxel as any other.
constexpr std::uint32_t kUncertainName = std::uint32_t{1} << 31;
constexpr std::uint32_t kNoName = ~std::uint32_t{0};
constexpr unsigned kKindShift = 16;
constexpr int kBandsPerThread = 10;   ///< Rows differ in what there is to do.
constexpr std::uint32_t kBeyond = 4;  ///< Beside the kind: the ray is cut.
constexpr std::uint32_t kNameMask = 0xFFFF;

/// Of a ray that is none, or hits something beyond the range.
bool marksNothing(std::uint32_t z_and_kind) {
  const std::uint32_t kind = (z_and_kind >> kKindShift) & 7U;
  return (kind & 3U) == static_cast<std::uint32_t>(RayEnd::kNone) ||
         kind == (static_cast<std::uint32_t>(RayEnd::kHit) | kBeyond);
}

/// The value, or 0 whatever it is, without a jump: pixels without a ray come and go.
float keptIf(bool keep, float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  bits &= keep ? ~std::uint32_t{0} : 0U;
  std::memcpy(&value, &bits, sizeof(bits));
  return value;
}

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
  const int bands = workers.threads() == 1 ? 1 : kBandsPerThread * workers.threads();
  resize(image, bands);
  workers.run(bands, [&](int index) {
    Band& band = bands_[static_cast<std::size_t>(index)];
    const int end = height_ * (index + 1) / bands;
    for (int row = height_ * index / bands; row < end; ++row)
      prepareRow(image, static_cast<std::size_t>(row) * static_cast<std::size_t>(width_), band);
  });
  setBounds();
  std::size_t dropped = 0;
  largest_depth_ = 0.0F;
  for (const Band& band : bands_) {
    dropped += band.dropped;
    largest_depth_ = std::max(largest_depth_, band.largest_depth);
  }
  return dropped;
}

void FrameRays::resize(const RangeImage& image, int bands) {
  width_ = image.camera.width;
  height_ = image.camera.height;
  const std::size_t padded = image.ends.size() + kRaysAtOnce;
  depth_.resize(padded);
  std::fill(depth_.end() - kRaysAtOnce, depth_.end(), 0.0F);
  const double reach = std::ceil(limits_.max_range_m / limits_.resolution_m) + 2.0;
  double farthest = reach;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    inverse_[axis].resize(padded);
    std::fill(inverse_[axis].end() - kRaysAtOnce, inverse_[axis].end(), kNoRay);
    forward_[axis] =
        static_cast<float>(image.T_map_camera.linear()(static_cast<Eigen::Index>(axis), 2));
    origin_[axis] = static_cast<double>(coordinate(image.origin, axis));
    const double place = origin_[axis] / limits_.resolution_m;
    farthest = std::max(farthest, std::abs(place));
    name_base_[axis] = floorToInt(place) - static_cast<int>(reach);
    name_origin_[axis] = static_cast<float>(place - std::floor(place) + reach);
  }
  surely_inside_ =
      0.5F - kUncertain -
      kRoundings * std::numeric_limits<float>::epsilon() * static_cast<float>(farthest);
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t row = (width + kRaysAtOnce - 1) / kRaysAtOnce * kRaysAtOnce;
  bands_.resize(static_cast<std::size_t>(bands));
  for (Band& band : bands_) {
    for (auto& direction : band.direction) direction.resize(row, 0.0F);
    band.squared_range.resize(row, 0.0F);
    band.cut.resize(row);
    band.kinds.resize(row, RayEnd::kNone);
    band.is_new.assign(row, 0);
    for (RowNames* names : {&band.names, &band.names_above}) {
      names->xy.resize(width);
      names->z_and_kind.assign(width, kNoName);
    }
    band.lowest = {};
    band.highest = {};
    band.largest_depth = 0.0F;
    band.marks.clear();
    band.dropped = 0;
  }
}

void FrameRays::prepareRow(const RangeImage& image, std::size_t first, Band& band) {
  std::copy_n(image.kinds.begin() + static_cast<std::ptrdiff_t>(first), width_, band.kinds.begin());
  measure(image, first, band);
  dropUnusable(band);
  cutAndInvert(first, band);
  mark(image, first, band);
}

void FrameRays::measure(const RangeImage& image, std::size_t first, Band& band) const {
  const Point3f* ends = image.ends.data() + first;
  const auto [from_x, from_y, from_z] = image.origin;
  const auto count = static_cast<std::size_t>(width_);
  const RayEnd* kinds = band.kinds.data();
  float* x = band.direction[0].data();
  float* y = band.direction[1].data();
  float* z = band.direction[2].data();
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = ends[i].x - from_x;
    y[i] = ends[i].y - from_y;
    z[i] = ends[i].z - from_z;
  }
  for (float* values : {x, y, z}) {
    for (std::size_t i = 0; i < count; ++i)
      values[i] = keptIf(kinds[i] != RayEnd::kNone, values[i]);
  }
  const auto dx = view(band.direction[0], 0, count);
  const auto dy = view(band.direction[1], 0, count);
  const auto dz = view(band.direction[2], 0, count);
  view(band.squared_range, 0, count) = dx * dx + dy * dy + dz * dz;
}

/// Takes rays that end nowhere or outside the map out of the row.
void FrameRays::dropUnusable(Band& band) const {
  const auto count = static_cast<std::size_t>(width_);
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
  const auto count = static_cast<std::size_t>(width_);
  const auto resolution_m = static_cast<float>(limits_.resolution_m);
  const auto max_range_m = static_cast<float>(limits_.max_range_m);
  std::array<Float8, 3> lowest;
  std::array<Float8, 3> highest;
  Float8 largest = Float8::Constant(band.largest_depth);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lowest[axis] = band.lowest[axis];
    highest[axis] = band.highest[axis];
  }
  for (std::size_t i = 0; i < count; i += kRaysAtOnce) {
    const std::size_t rays = std::min<std::size_t>(count - i, kRaysAtOnce);
    const Float8 cut = (max_range_m / at(band.squared_range, i).sqrt()).min(1.0F);
    Eigen::Map<Float8>(band.cut.data() + i) = cut;
    Float8 depth = forward_[0] * at(band.direction[0], i) + forward_[1] * at(band.direction[1], i) +
                   forward_[2] * at(band.direction[2], i);
    depth = (depth * cut * (1.0F / resolution_m)).max(0.0F);
    largest = largest.max(depth);
    store(depth, rays, depth_.data() + first + i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Float8 direction = at(band.direction[axis], i) * cut;
      lowest[axis] = lowest[axis].min(direction);
      highest[axis] = highest[axis].max(direction);
      store((resolution_m / direction).min(kNoRay).max(-kNoRay), rays,
            inverse_[axis].data() + first + i);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    band.lowest[axis] = lowest[axis].minCoeff();
    band.highest[axis] = highest[axis].maxCoeff();
  }
  band.largest_depth = largest.maxCoeff();
}

void FrameRays::nameEnds(Band& band) const {
  const auto count = static_cast<std::size_t>(width_);
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
  const float surely_inside = surely_inside_;
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
    const std::uint32_t beyond = squared_range[i] > max_squared ? kBeyond : 0U;
    const std::uint32_t uncertain = off > surely_inside ? kUncertainName : 0U;
    xy[i] = static_cast<std::uint32_t>(cell_x) | static_cast<std::uint32_t>(cell_y) << 16;
    z_and_kind[i] = static_cast<std::uint32_t>(cell_z) | (kind | beyond) << kKindShift | uncertain;
  }
}

/// Flags the rays that end elsewhere than those of the pixels to the left and above, or may do so.
void FrameRays::findNewEnds(Band& band) const {
  const auto count = static_cast<std::size_t>(width_);
  const std::uint32_t* xy = band.names.xy.data();
  const std::uint32_t* z = band.names.z_and_kind.data();
  const std::uint32_t* xy_above = band.names_above.xy.data();
  const std::uint32_t* z_above = band.names_above.z_and_kind.data();
  std::uint8_t* is_new = band.is_new.data();
  is_new[0] = 1;
  for (std::size_t i = 1; i < count; ++i) {
    const std::uint32_t from_left = (xy[i] ^ xy[i - 1]) | (z[i] ^ z[i - 1]);
    const std::uint32_t from_above = (xy[i] ^ xy_above[i]) | (z[i] ^ z_above[i]);
    const std::uint32_t differs = (from_left != 0 ? 1U : 0U) & (from_above != 0 ? 1U : 0U);
    is_new[i] = static_cast<std::uint8_t>(differs | z[i] >> 31);
  }
}

void FrameRays::mark(const RangeImage& image, std::size_t first, Band& band) const {
  nameEnds(band);
  findNewEnds(band);
  for (std::size_t i = 0; i < band.is_new.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t any = 0;
    std::memcpy(&any, band.is_new.data() + i, sizeof(any));
    if (any == 0) continue;
    for (std::size_t k = i; k < i + sizeof(any); ++k) {
      if (band.is_new[k] != 0 && !marksNothing(band.names.z_and_kind[k]))
        markEnd(image, first, k, band);
    }
  }
  std::swap(band.names, band.names_above);
}

void FrameRays::markEnd(const RangeImage& image, std::size_t first, std::size_t column,
                        Band& band) const {
  const std::uint32_t xy = band.names.xy[column];
  const std::uint32_t z = band.names.z_and_kind[column];
  MarkedVoxel& mark = band.marks.emplace_back();
  mark.kind = band.kinds[column];
  if ((z & kUncertainName) == 0) {
    mark.voxel.x = name_base_[0] + static_cast<int>(xy & kNameMask);
    mark.voxel.y = name_base_[1] + static_cast<int>(xy >> 16);
    mark.voxel.z = name_base_[2] + static_cast<int>(z & kNameMask);
  } else if ((z & kBeyond << kKindShift) == 0) {
    mark.voxel = voxelAt(image.ends[first + column], limits_.resolution_m);
  } else {
    const float cut = band.cut[column];
    const Point3f end{image.origin.x + band.direction[0][column] * cut,
                      image.origin.y + band.direction[1][column] * cut,
                      image.origin.z + band.direction[2][column] * cut};
    mark.voxel = voxelAt(end, limits_.resolution_m);
  }
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
