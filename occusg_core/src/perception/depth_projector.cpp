// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/depth_projector.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

bool sameCamera(const CameraModel& a, const CameraModel& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy;
}

std::string size(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

const DepthProjectorConfig& usable(const DepthProjectorConfig& config) {
  if (checked(config).min_depth_m < config.max_depth_m) return config;
  throw refuse("perception.depth.max_depth_m", "is " + shortestText(config.max_depth_m) + " m",
               "it must be above min_depth_m = " + shortestText(config.min_depth_m));
}

void check(const DepthImage& image, const CameraModel& camera) {
  const cv::Mat& pixels = image.pixels;
  if (pixels.type() != CV_16UC1 && pixels.type() != CV_32FC1) {
    throw refuse("depth image",
                 "has OpenCV depth code " + std::to_string(pixels.depth()) + " and " +
                     std::to_string(pixels.channels()) + " channels",
                 "it must be CV_16UC1 or CV_32FC1 (codes " + std::to_string(CV_16U) + " and " +
                     std::to_string(CV_32F) + ", one channel)");
  }
  if (pixels.cols != camera.width || pixels.rows != camera.height) {
    throw refuse("depth image", "is " + size(pixels.cols, pixels.rows) + " pixels",
                 "the camera model wants " + size(camera.width, camera.height));
  }
  if (!std::isfinite(image.units_per_m) || image.units_per_m <= 0.0) {
    throw refuse("depth image", "units_per_m is " + std::to_string(image.units_per_m),
                 "it must be finite and positive: 1000 for millimetres, 1 for metres");
  }
}

void check(const Pose& T_map_camera) {
  if (isFinite(T_map_camera)) return;
  const auto t = T_map_camera.translation();
  throw refuse("camera pose",
               "translation (" + std::to_string(t.x()) + ", " + std::to_string(t.y()) + ", " +
                   std::to_string(t.z()) + ") or rotation is not finite",
               "all its numbers must be finite");
}

/// (pixel - center) / focal_length for every `stride`-th pixel of a side.
std::vector<double> rayTable(int side, int stride, double center, double focal_length) {
  std::vector<double> slopes;
  slopes.reserve(static_cast<std::size_t>(side / stride) + 1);
  for (int pixel = 0; pixel < side; pixel += stride)
    slopes.push_back((pixel - center) / focal_length);
  return slopes;
}

/// The camera whose pixels are every `stride`-th one of `camera`, from (0, 0).
CameraModel latticeCamera(const CameraModel& camera, int stride) {
  const double step = stride;
  return {(camera.width + stride - 1) / stride,
          (camera.height + stride - 1) / stride,
          camera.fx / step,
          camera.fy / step,
          camera.cx / step,
          camera.cy / step};
}

Point3f toMap(const Pose& T_map_camera, double slope_x, double slope_y, double depth_m) {
  const Eigen::Vector3d in_map =
      T_map_camera * Eigen::Vector3d(slope_x * depth_m, slope_y * depth_m, depth_m);
  return {static_cast<float>(in_map.x()), static_cast<float>(in_map.y()),
          static_cast<float>(in_map.z())};
}

/// The counter of the reason why `value` is no depth; null when it is one.
std::size_t* noDepth(std::uint16_t value, PixelDrops& drops) {
  if (value == 0) return &drops.zero;
  // Drivers saturate "no return" and "out of range" to the largest value; it is no measurement.
  if (value == std::numeric_limits<std::uint16_t>::max()) return &drops.infinite;
  return nullptr;
}

std::size_t* noDepth(float value, PixelDrops& drops) {
  if (std::isnan(value)) return &drops.nan;
  if (std::isinf(value)) return &drops.infinite;
  if (value == 0.0F) return &drops.zero;
  if (value < 0.0F) return &drops.negative;
  return nullptr;
}

/// Back-projects the lattice of an image of pixel type `Value`.
template <typename Value>
class Lattice {
 public:
  Lattice(const DepthProjectorConfig& config, const DepthImage& image, const Pose& T_map_camera)
      : config_(config), image_(image), T_map_camera_(T_map_camera) {}

  void project(const std::vector<double>& ray_x, const std::vector<double>& ray_y,
               RangeImage& result) const {
    std::size_t index = 0;
    for (std::size_t row = 0; row < ray_y.size(); ++row) {
      const Value* pixels = image_.pixels.ptr<Value>(static_cast<int>(row) * config_.stride);
      for (std::size_t column = 0; column < ray_x.size(); ++column, ++index) {
        const Value value = pixels[column * static_cast<std::size_t>(config_.stride)];
        const double depth_m = static_cast<double>(value) / image_.units_per_m;
        const RayEnd kind = kindOf(value, depth_m, result.drops);
        result.kinds[index] = kind;
        if (kind == RayEnd::kNone) continue;
        const bool is_hit = kind == RayEnd::kHit;
        result.hits += is_hit ? 1 : 0;
        result.ends[index] =
            toMap(T_map_camera_, ray_x[column], ray_y[row], is_hit ? depth_m : config_.max_depth_m);
      }
    }
  }

 private:
  RayEnd kindOf(Value value, double depth_m, PixelDrops& drops) const {
    if (std::size_t* reason = noDepth(value, drops)) {
      ++*reason;
      return RayEnd::kNone;
    }
    if (depth_m < config_.min_depth_m) {
      ++drops.too_near;
      return RayEnd::kNone;
    }
    if (depth_m <= config_.max_depth_m) return RayEnd::kHit;
    if (depth_m > config_.max_plausible_depth_m) {
      ++drops.implausible;
      return RayEnd::kNone;
    }
    if (config_.beyond_max_depth == BeyondMaxDepth::kClear) return RayEnd::kMiss;
    ++drops.too_far;
    return RayEnd::kNone;
  }

  const DepthProjectorConfig& config_;
  const DepthImage& image_;
  const Pose& T_map_camera_;
};

}  // namespace

DepthProjector::DepthProjector(const DepthProjectorConfig& config) : config_(config) {
  (void)usable(config_);
}

PointCloud DepthProjector::project(const DepthImage& image, const CameraModel& camera,
                                   const Pose& T_map_camera) {
  return toPointCloud(projectLattice(image, camera, T_map_camera));
}

const RangeImage& DepthProjector::projectLattice(const DepthImage& image, const CameraModel& camera,
                                                 const Pose& T_map_camera) {
  prepareRays(camera);
  check(image, camera);
  check(T_map_camera);

  image_.camera = latticeCamera(camera, config_.stride);
  image_.T_map_camera = T_map_camera;
  image_.origin = toMap(T_map_camera, 0.0, 0.0, 0.0);
  image_.hits = 0;
  image_.drops = {};
  image_.ends.resize(ray_x_.size() * ray_y_.size());
  image_.kinds.resize(image_.ends.size());
  if (image.pixels.type() == CV_16UC1) {
    Lattice<std::uint16_t>(config_, image, T_map_camera).project(ray_x_, ray_y_, image_);
  } else {
    Lattice<float>(config_, image, T_map_camera).project(ray_x_, ray_y_, image_);
  }
  return image_;
}

void DepthProjector::prepareRays(const CameraModel& camera) {
  if (!ray_x_.empty() && sameCamera(camera, camera_)) return;
  check(camera, "camera");
  ray_x_ = rayTable(camera.width, config_.stride, camera.cx, camera.fx);
  ray_y_ = rayTable(camera.height, config_.stride, camera.cy, camera.fy);
  camera_ = camera;
}

}  // namespace occusg
