// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/sequence_reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "io/recordings/recording.hpp"
#include "occusg/error.hpp"
#include "occusg/io/png_check.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxImageBytes = std::size_t{1} << 30U;

std::string seconds(double value) { return toText(value) + " s"; }

/// The entry nearest to `stamp_s`, the earlier of two equally near; null when all are farther than
/// `max_offset_s`. Entries are sorted by time.
template <typename Entry>
const Entry* nearest(const std::vector<Entry>& entries, double stamp_s, double max_offset_s) {
  const auto after =
      std::lower_bound(entries.begin(), entries.end(), stamp_s,
                       [](const Entry& entry, double stamp) { return entry.stamp_s < stamp; });
  const Entry* best = nullptr;
  double best_offset_s = max_offset_s;
  for (auto it = after == entries.begin() ? after : after - 1; it != entries.end() && it <= after;
       ++it) {
    const double offset_s = std::abs(it->stamp_s - stamp_s);
    if (offset_s > best_offset_s || (best != nullptr && offset_s == best_offset_s)) continue;
    best = &*it;
    best_offset_s = offset_s;
  }
  return best;
}

/// The picture in `bytes`; empty when there is none.
cv::Mat decoded(const std::string& bytes) {
  const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8UC1,
                     const_cast<char*>(bytes.data()));  // cv::Mat has no view of const data
  try {
    return cv::imdecode(view, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // a limit of the decoder
    return {};
  }
}

cv::Mat readDepthPng(const std::string& path, const CameraModel& camera) {
  const std::string bytes = readFile(path, kMaxImageBytes);
  const PngHeader header = checkPng(bytes, path);
  if (header.bit_depth != 16 || header.channels != 1) {
    throw refuse(path,
                 "has " + std::to_string(header.bit_depth) + " bits and " +
                     std::to_string(header.channels) + " channels",
                 "a depth image has 16 bits and one channel");
  }
  if (header.width != camera.width || header.height != camera.height) {
    throw refuse(
        path,
        "is " + std::to_string(header.width) + " x " + std::to_string(header.height) + " pixels",
        "the camera file says " + std::to_string(camera.width) + " x " +
            std::to_string(camera.height));
  }
  cv::Mat pixels = decoded(bytes);
  if (pixels.type() != CV_16UC1 || pixels.cols != camera.width || pixels.rows != camera.height)
    throw refuse(path, "cannot be decoded", "a complete PNG is needed");
  return pixels;
}

/// The pose a share 0..1 of the way from `a` to `b`: straight, and turning evenly.
Pose between(const Pose& a, const Pose& b, double share) {
  const Eigen::Quaterniond from(a.linear());
  Pose pose = Pose::Identity();
  pose.linear() = from.slerp(share, Eigen::Quaterniond(b.linear())).toRotationMatrix();
  pose.translation() = (1.0 - share) * a.translation() + share * b.translation();
  return pose;
}

}  // namespace

SequenceReader::SequenceReader(const std::string& folder, const SequenceReaderConfig& config)
    : folder_(folder), config_(config) {
  if (!(config.max_time_offset_s >= 0.0 && config.max_time_offset_s <= 1.0)) {
    throw refuse("max_time_offset_s", "is " + toText(config.max_time_offset_s),
                 "a value from 0 to 1 s is needed");
  }
  std::error_code failed;
  const fs::path absolute = fs::absolute(folder_, failed).lexically_normal();
  scene_ = (absolute.has_filename() ? absolute : absolute.parent_path()).filename().string();
  recording_ = std::make_shared<const Recording>(readRecording(folder_, config_));
}

std::size_t SequenceReader::size() const { return recording_->depth_images.size(); }

const CameraModel& SequenceReader::camera() const { return recording_->camera; }

const std::string& SequenceReader::layout() const { return recording_->layout; }

const std::vector<std::string>& SequenceReader::unusableLines() const {
  return recording_->unusable_lines;
}

const std::vector<std::string>& SequenceReader::assumptions() const {
  return recording_->assumptions;
}

std::size_t SequenceReader::interpolatedPoses() const {
  const auto& images = recording_->depth_images;
  return static_cast<std::size_t>(
      std::count_if(images.begin(), images.end(), [&](const RecordedImage& image) {
        return image.problem.empty() && !hasPoseNear(image.stamp_s) &&
               interpolatedPose(image.stamp_s).has_value();
      }));
}

bool SequenceReader::hasPoseNear(double stamp_s) const {
  return nearest(recording_->poses, stamp_s, config_.max_time_offset_s) != nullptr ||
         nearest(recording_->unusable_poses, stamp_s, config_.max_time_offset_s) != nullptr;
}

std::optional<Pose> SequenceReader::interpolatedPose(double stamp_s) const {
  const auto& poses = recording_->poses;
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), stamp_s,
                       [](const RecordedPose& pose, double stamp) { return pose.stamp_s < stamp; });
  if (after == poses.begin() || after == poses.end()) return std::nullopt;
  const RecordedPose& a = *(after - 1);
  const RecordedPose& b = *after;
  const Pose step = a.T_map_camera.inverse() * b.T_map_camera;
  const PoseInterpolationLimits& limits = config_.interpolation;
  const bool is_near = b.stamp_s - a.stamp_s <= limits.max_gap_s &&
                       step.translation().norm() <= limits.max_gap_m &&
                       Eigen::AngleAxisd(step.linear()).angle() <= limits.max_gap_rad;
  if (!is_near) return std::nullopt;
  return between(a.T_map_camera, b.T_map_camera, (stamp_s - a.stamp_s) / (b.stamp_s - a.stamp_s));
}

Pose SequenceReader::poseAt(double stamp_s) const {
  const Recording& recording = *recording_;
  if (const auto* pose = nearest(recording.poses, stamp_s, config_.max_time_offset_s);
      pose != nullptr)
    return pose->T_map_camera;
  if (const auto* unusable = nearest(recording.unusable_poses, stamp_s, config_.max_time_offset_s);
      unusable != nullptr)
    throw Error(unusable->problem);
  if (const auto pose = interpolatedPose(stamp_s)) return *pose;
  const auto* any = nearest(recording.poses, stamp_s, std::numeric_limits<double>::infinity());
  throw refuse(recording.poses_path,
               "the pose nearest to " + seconds(stamp_s) + " is at " + seconds(any->stamp_s),
               "one within " + seconds(config_.max_time_offset_s) + " or two around it, at most " +
                   seconds(config_.interpolation.max_gap_s) + ", " +
                   toText(config_.interpolation.max_gap_m) + " m and " +
                   toText(config_.interpolation.max_gap_rad) + " rad apart, are needed");
}

std::optional<std::string> SequenceReader::truthPath() const {
  std::error_code failed;
  const std::string path = pathOf("rooms.json");
  if (!fs::exists(path, failed)) return std::nullopt;
  return path;
}

DepthImage SequenceReader::depthIn(const std::string& path) const {
  cv::Mat pixels = readDepthPng(path, recording_->camera);
  if (recording_->highest_value_is_no_return)
    pixels.setTo(0, pixels == std::numeric_limits<std::uint16_t>::max());
  if (recording_->rows_go_up) cv::flip(pixels, pixels, 0);
  return {pixels, recording_->depth_units_per_m};
}

Frame SequenceReader::read(std::size_t index) const {
  if (index >= size()) {
    throw refuse(folder_, "has no frame " + std::to_string(index),
                 "an index below " + std::to_string(size()) + " is needed");
  }
  const RecordedImage& entry = recording_->depth_images[index];
  if (!entry.problem.empty()) throw Error(entry.problem);
  Frame frame;
  frame.stamp_s = entry.stamp_s;
  frame.camera = recording_->camera;
  frame.depth_path = pathOf(entry.path);
  frame.T_map_camera = poseAt(entry.stamp_s);
  frame.depth = depthIn(frame.depth_path);
  const auto* color = nearest(recording_->color_images, entry.stamp_s, config_.max_time_offset_s);
  // A picture whose rows go up would not show what the turned depth image shows.
  if (color != nullptr && !recording_->rows_go_up) frame.color_path = pathOf(color->path);
  std::error_code failed;
  const std::string labels =
      pathOf((fs::path("labels") / fs::path(entry.path).filename()).string());
  if (fs::exists(labels, failed)) frame.label_path = labels;
  return frame;
}

std::string SequenceReader::pathOf(const std::string& name) const {
  return (fs::path(folder_) / name).string();
}

}  // namespace occusg
