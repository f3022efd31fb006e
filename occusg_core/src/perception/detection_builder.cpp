// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/detection_builder.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "occusg/error.hpp"
#include "perception/euclidean_cluster.hpp"

namespace occusg {
namespace {

/// Nothing nearer is a measurement (the published system).
constexpr double kMinDepth_m = 0.001;
/// Farther from the camera nothing is believed, whatever a focal length near zero makes of it.
constexpr double kMaxRange_m = 1e4;
/// However far away, things farther apart are two.
constexpr double kWidestGap_m = 0.5;
/// Colour and depth sensors of one device differ by a per cent (1280 x 720, 848 x 480).
constexpr double kMaxAspectDifference = 0.02;

std::string sizeText(const cv::Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

void check(const DepthFrame& frame) {
  check(frame.camera, "camera");
  const cv::Mat& pixels = frame.depth.pixels;
  if (pixels.type() != CV_16UC1 && pixels.type() != CV_32FC1) {
    throw refuse("depth image", "has OpenCV type " + std::to_string(pixels.type()),
                 "it must be CV_16UC1 or CV_32FC1");
  }
  if (pixels.cols != frame.camera.width || pixels.rows != frame.camera.height) {
    throw refuse("depth image", "is " + sizeText(pixels.size()) + " pixels",
                 "the camera model wants " + sizeText({frame.camera.width, frame.camera.height}));
  }
  if (!std::isfinite(frame.depth.units_per_m) || frame.depth.units_per_m <= 0.0) {
    throw refuse("depth image", "units_per_m is " + std::to_string(frame.depth.units_per_m),
                 "it must be finite and positive: 1000 for millimetres, 1 for metres");
  }
  if (!isFinite(frame.T_map_camera))
    throw refuse("camera pose", "is not finite", "all its numbers must be finite");
  if (!std::isfinite(frame.stamp_s))
    throw refuse("depth image", "its stamp is not finite", "a time in seconds is needed");
}

void checkSameView(const cv::Size& image, const cv::Size& depth) {
  if (isSameView(image, depth)) return;
  throw refuse("instance masks", "their image is " + sizeText(image) + " pixels",
               "it must have the aspect ratio of the depth image, " + sizeText(depth) +
                   ", and be registered to it");
}

/// "mask 3 (chair)"
std::string nameOf(std::size_t index, const InstanceMask& mask) {
  const std::string name = mask.class_name.empty() ? "" : " (" + mask.class_name + ")";
  return "mask " + std::to_string(index) + name;
}

/// True when the mask is well-formed; otherwise counts why it is not.
bool accept(const InstanceMask& mask, std::size_t index, const cv::Size& image,
            RefusedMasks& refused) {
  if (!(mask.score >= 0.0 && mask.score <= 1.0)) {
    refused.add(MaskRefusal::kBadNumber, [&] {
      return nameOf(index, mask) + ": score is " + std::to_string(mask.score) +
             "; it must be in [0, 1]";
    });
    return false;
  }
  if (mask.class_name.empty()) {
    refused.add(MaskRefusal::kUnknownClass, [&] {
      return nameOf(index, mask) + ": class id " + std::to_string(mask.class_id) + " of object " +
             std::to_string(mask.source_object_id) + " has no name; the list of names is too short";
    });
    return false;
  }
  if (mask.box.empty() || mask.pixels.empty()) {
    refused.add(MaskRefusal::kEmpty, [&] {
      return nameOf(index, mask) + ": is empty; it must hold at least one pixel";
    });
    return false;
  }
  const cv::Rect& box = mask.box;
  const bool is_inside = box.x >= 0 && box.y >= 0 && box.x <= image.width - box.width &&
                         box.y <= image.height - box.height;
  if (!is_inside || mask.pixels.type() != CV_8UC1 || mask.pixels.size() != box.size()) {
    refused.add(MaskRefusal::kWrongSize, [&] {
      return nameOf(index, mask) + ": has " + sizeText(mask.pixels.size()) +
             " pixels of OpenCV type " + std::to_string(mask.pixels.type()) + " for a box of " +
             sizeText(box.size()) + " at (" + std::to_string(box.x) + ", " + std::to_string(box.y) +
             "); it must be CV_8UC1, of the box's size, and inside the image of " + sizeText(image);
    });
    return false;
  }
  return true;
}

/// Keeps the `limit` masks of the best score, in the order they have.
void keepBest(std::size_t limit, const std::vector<InstanceMask>& masks,
              std::vector<std::size_t>& indices, RefusedMasks& refused) {
  if (indices.size() <= limit) return;
  refused.add(
      MaskRefusal::kOverLimit,
      [&] {
        return "instance masks: there are " + std::to_string(indices.size()) + "; the best " +
               std::to_string(limit) + " are taken";
      },
      indices.size() - limit);
  std::stable_sort(indices.begin(), indices.end(),
                   [&](std::size_t a, std::size_t b) { return masks[a].score > masks[b].score; });
  indices.resize(limit);
  std::sort(indices.begin(), indices.end());
}

/// Depth pixels under a mask, back-projected with the camera of the depth image.
class MaskPoints {
 public:
  MaskPoints(const DepthFrame& frame, const cv::Size& image, double max_depth_m)
      : frame_(frame),
        max_depth_m_(max_depth_m),
        image_column_(imagePixels(frame.depth.pixels.cols, image.width)),
        image_row_(imagePixels(frame.depth.pixels.rows, image.height)) {}

  /// Camera optical frame [m], row by row.
  [[nodiscard]] std::vector<Eigen::Vector3d> under(const InstanceMask& mask) const {
    const cv::Range rows = depthPixels(image_row_, mask.box.y, mask.box.height);
    const cv::Range columns = depthPixels(image_column_, mask.box.x, mask.box.width);
    std::vector<Eigen::Vector3d> points;
    for (int row = rows.start; row < rows.end; ++row) {
      const auto* inside = mask.pixels.ptr<std::uint8_t>(at(image_row_, row) - mask.box.y);
      for (int column = columns.start; column < columns.end; ++column)
        if (inside[at(image_column_, column) - mask.box.x] != 0) addPoint(row, column, points);
    }
    return points;
  }

 private:
  /// For each pixel of a side of the depth image: the pixel of the image that holds its centre.
  static std::vector<int> imagePixels(int depth_side, int image_side) {
    std::vector<int> pixels(static_cast<std::size_t>(depth_side));
    for (int i = 0; i < depth_side; ++i) {
      pixels[static_cast<std::size_t>(i)] =
          static_cast<int>((2 * std::int64_t{i} + 1) * image_side / (2 * std::int64_t{depth_side}));
    }
    return pixels;
  }

  /// The pixels of a side of the depth image that fall into [first, first + count) of the image.
  static cv::Range depthPixels(const std::vector<int>& image_pixels, int first, int count) {
    const auto begin = image_pixels.begin();
    const auto start = std::lower_bound(begin, image_pixels.end(), first);
    const auto end = std::lower_bound(start, image_pixels.end(), first + count);
    return {static_cast<int>(start - begin), static_cast<int>(end - begin)};
  }

  static int at(const std::vector<int>& pixels, int i) {
    return pixels[static_cast<std::size_t>(i)];
  }

  /// NaN when the pixel holds no usable depth.
  [[nodiscard]] double depthAt(int row, int column) const {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const cv::Mat& pixels = frame_.depth.pixels;
    if (pixels.type() == CV_32FC1)
      return static_cast<double>(pixels.at<float>(row, column)) / frame_.depth.units_per_m;
    const std::uint16_t value = pixels.at<std::uint16_t>(row, column);
    if (value == std::numeric_limits<std::uint16_t>::max()) return kNone;
    return value / frame_.depth.units_per_m;
  }

  void addPoint(int row, int column, std::vector<Eigen::Vector3d>& points) const {
    const double depth_m = depthAt(row, column);
    if (!(depth_m > kMinDepth_m && depth_m <= max_depth_m_)) return;
    const CameraModel& camera = frame_.camera;
    const Eigen::Vector3d point((column - camera.cx) / camera.fx * depth_m,
                                (row - camera.cy) / camera.fy * depth_m, depth_m);
    if (point.cwiseAbs().maxCoeff() <= kMaxRange_m) points.push_back(point);
  }

  const DepthFrame& frame_;
  double max_depth_m_;
  std::vector<int> image_column_;
  std::vector<int> image_row_;
};

/// How far apart points of one object may be, at the depth its mask is seen at.
double clusterDistance(const std::vector<Eigen::Vector3d>& points, const CameraModel& camera,
                       const DetectionBuilderConfig& config) {
  if (points.empty()) return config.cluster_eps_m;
  std::vector<double> depths_m(points.size());
  std::transform(points.begin(), points.end(), depths_m.begin(),
                 [](const Eigen::Vector3d& point) { return point.z(); });
  const auto median = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
  std::nth_element(depths_m.begin(), median, depths_m.end());
  const double pixel_m = *median / std::min(camera.fx, camera.fy);
  return std::max(config.cluster_eps_m,
                  std::min(kWidestGap_m, config.cluster_gap_pixels * pixel_m));
}

Detection detectionOf(const InstanceMask& mask, const std::vector<Eigen::Vector3d>& points,
                      const std::vector<std::size_t>& cluster, const DepthFrame& frame) {
  Detection detection;
  detection.stamp_s = frame.stamp_s;
  detection.class_id = mask.class_id;
  detection.class_name = mask.class_name;
  detection.score = mask.score;
  detection.source_object_id = mask.source_object_id;
  detection.point_count = cluster.size();
  // In the map frame, whose z axis is up, so the box stands upright however the camera is tilted.
  for (const std::size_t index : cluster) {
    const Eigen::Vector3d point = frame.T_map_camera * points[index];
    detection.centroid += point;
    detection.box.extend(point);
  }
  detection.centroid /= static_cast<double>(cluster.size());
  return detection;
}

}  // namespace

bool isSameView(const cv::Size& image, const cv::Size& depth) {
  const bool is_sane = image.width > 0 && image.height > 0 && image.width <= kMaxImageSide &&
                       image.height <= kMaxImageSide;
  if (!is_sane) return false;
  const double ratio = (static_cast<double>(image.width) * depth.height) /
                       (static_cast<double>(image.height) * depth.width);
  return std::abs(ratio - 1.0) <= kMaxAspectDifference;
}

DetectionBuilder::DetectionBuilder(const DetectionBuilderConfig& config) : config_(config) {
  (void)checked(config_);
}

DetectionResult DetectionBuilder::build(const InstanceMasks& masks, const DepthFrame& frame) const {
  check(frame);
  checkSameView(masks.image_size, frame.depth.pixels.size());

  DetectionResult result;
  result.refused = masks.refused;
  std::vector<std::size_t> accepted;
  for (std::size_t i = 0; i < masks.masks.size(); ++i)
    if (accept(masks.masks[i], i, masks.image_size, result.refused)) accepted.push_back(i);
  keepBest(static_cast<std::size_t>(config_.max_masks), masks.masks, accepted, result.refused);

  const MaskPoints mask_points(frame, masks.image_size, config_.max_depth_m);
  for (const std::size_t index : accepted) {
    const InstanceMask& mask = masks.masks[index];
    if (cv::countNonZero(mask.pixels) == 0) {
      result.refused.add(MaskRefusal::kEmpty, [&] {
        return nameOf(index, mask) + ": is empty; it must hold at least one pixel";
      });
      continue;
    }
    const std::vector<Eigen::Vector3d> points = mask_points.under(mask);
    const std::vector<std::size_t> cluster =
        largestCluster(points, clusterDistance(points, frame.camera, config_));
    if (cluster.size() < static_cast<std::size_t>(config_.min_cluster_points)) {
      result.refused.add(MaskRefusal::kTooFewPoints, [&] {
        return nameOf(index, mask) + ": its largest cluster has " + std::to_string(cluster.size()) +
               " of " + std::to_string(points.size()) + " points; a detection needs " +
               std::to_string(config_.min_cluster_points);
      });
      continue;
    }
    result.detections.push_back(detectionOf(mask, points, cluster, frame));
  }
  return result;
}

}  // namespace occusg
