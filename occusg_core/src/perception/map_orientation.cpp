// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/map_orientation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "occusg/perception/depth_projector.hpp"

namespace occusg {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Points of a frame in a row.
constexpr int kColumns = 64;
/// Neighbours farther apart than this share of their distance lie on two surfaces.
constexpr double kMaxStepShare = 0.1;
constexpr double kCoarse_rad = 45.0 * kPi / 180.0;
constexpr double kFine_rad = 15.0 * kPi / 180.0;
constexpr int kRounds = 5;
constexpr double kLevel_rad = 15.0 * kPi / 180.0;
constexpr double kBin_m = 0.05;
/// A level surface counts as large from this share of the largest one's points on.
constexpr double kLargeShare = 0.2;
constexpr std::size_t kFewestLevelPatches = 50;

Eigen::Vector3d asVector(const Point3f& point) { return {point.x, point.y, point.z}; }

DepthProjectorConfig samplingOf(const CameraModel& camera) {
  DepthProjectorConfig config;
  config.stride = std::max(1, camera.width / kColumns);
  config.beyond_max_depth = BeyondMaxDepth::kDrop;
  return config;
}

constexpr double kLeastAgreement = 0.5;
constexpr double kMostTilt_rad = 60.0 * kPi / 180.0;
constexpr double kFarthestFloor_m = 1.0;

}  // namespace

bool hasCommonDown(const MapOrientation& orientation) {
  return orientation.agreement >= kLeastAgreement;
}

bool isTilted(const MapOrientation& orientation) {
  return hasCommonDown(orientation) && orientation.down_off_rad > kMostTilt_rad;
}

std::optional<double> floorAtMiddle_m(const MapOrientation& orientation) {
  if (!orientation.floor_height_m) return std::nullopt;
  const double camera_above_floor_m =
      orientation.middle.dot(orientation.up) - *orientation.floor_height_m;
  return orientation.middle.z() - camera_above_floor_m;
}

bool hasFarFloor(const MapOrientation& orientation) {
  const std::optional<double> floor_z_m = floorAtMiddle_m(orientation);
  return floor_z_m && std::abs(*floor_z_m) > kFarthestFloor_m;
}

void MapOrientationEstimator::add(const DepthFrame& frame) {
  DepthProjector projector(samplingOf(frame.camera));
  const RangeImage& image = projector.projectLattice(frame.depth, frame.camera, frame.T_map_camera);
  downs_.emplace_back(frame.T_map_camera.linear().col(1));
  const Eigen::Vector3d camera = frame.T_map_camera.translation();
  positions_sum_ += camera;
  const auto width = static_cast<std::size_t>(image.camera.width);
  const auto height = static_cast<std::size_t>(image.camera.height);
  for (std::size_t v = 0; v + 1 < height; ++v) {
    for (std::size_t u = 0; u + 1 < width; ++u) {
      const std::size_t here = v * width + u;
      const bool all_hit = image.kinds[here] == RayEnd::kHit &&
                           image.kinds[here + 1] == RayEnd::kHit &&
                           image.kinds[here + width] == RayEnd::kHit;
      if (!all_hit) continue;
      const Eigen::Vector3d position = asVector(image.ends[here]);
      const Eigen::Vector3d right = asVector(image.ends[here + 1]) - position;
      const Eigen::Vector3d below = asVector(image.ends[here + width]) - position;
      const double farthest = kMaxStepShare * (position - camera).norm();
      const Eigen::Vector3d normal = below.cross(right);
      if (right.norm() > farthest || below.norm() > farthest || normal.norm() == 0.0) continue;
      const double side = normal.dot(camera - position) >= 0.0 ? 1.0 : -1.0;
      patches_.push_back({position, side * normal.normalized()});
    }
  }
}

Eigen::Vector3d MapOrientationEstimator::refined(const Eigen::Vector3d& up,
                                                 double within_rad) const {
  // The direction along which level normals are longest and upright ones shortest.
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  const double level = std::cos(within_rad);
  const double upright = std::sin(within_rad);
  for (const Patch& patch : patches_) {
    const double along = std::abs(patch.normal.dot(up));
    if (along > level) scatter -= patch.normal * patch.normal.transpose();
    if (along < upright) scatter += patch.normal * patch.normal.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d direction = solver.eigenvectors().col(0);
  return direction.dot(up) >= 0.0 ? direction : Eigen::Vector3d(-direction);
}

std::optional<double> MapOrientationEstimator::floorHeight(const Eigen::Vector3d& up) const {
  std::vector<double> heights;
  for (const Patch& patch : patches_)
    if (patch.normal.dot(up) > std::cos(kLevel_rad)) heights.push_back(patch.position.dot(up));
  if (heights.size() < kFewestLevelPatches) return std::nullopt;
  std::sort(heights.begin(), heights.end());
  // Points within a bin above each height, by two ends that move upwards.
  const auto within = [&](std::size_t first) {
    const auto end = std::upper_bound(heights.begin() + static_cast<std::ptrdiff_t>(first),
                                      heights.end(), heights[first] + kBin_m);
    return static_cast<std::size_t>(end - heights.begin()) - first;
  };
  std::size_t largest = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) largest = std::max(largest, within(i));
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const std::size_t count = within(i);
    if (static_cast<double>(count) >= kLargeShare * static_cast<double>(largest))
      return heights[i + count / 2];
  }
  return std::nullopt;
}

MapOrientation MapOrientationEstimator::estimate() const {
  MapOrientation orientation;
  if (downs_.empty()) return orientation;
  orientation.middle = positions_sum_ / static_cast<double>(downs_.size());
  Eigen::Vector3d down = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& direction : downs_) down += direction;
  down /= static_cast<double>(downs_.size());
  orientation.agreement = down.norm();
  if (orientation.agreement > 0.0) {
    down.normalize();
    orientation.up = -down;
  }
  if (!patches_.empty()) {
    for (int round = 0; round < kRounds; ++round)
      orientation.up = refined(orientation.up, kCoarse_rad);
    for (int round = 0; round < kRounds; ++round)
      orientation.up = refined(orientation.up, kFine_rad);
  }
  orientation.down_off_rad = std::acos(std::clamp(orientation.up.z(), -1.0, 1.0));
  orientation.floor_height_m = floorHeight(orientation.up);
  return orientation;
}

Pose levelling(const MapOrientation& orientation) {
  Pose T_level_map = Pose::Identity();
  T_level_map.linear() =
      Eigen::Quaterniond::FromTwoVectors(orientation.up, Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  T_level_map.translation() = Eigen::Vector3d(0, 0, -orientation.floor_height_m.value_or(0.0));
  return T_level_map;
}

}  // namespace occusg
