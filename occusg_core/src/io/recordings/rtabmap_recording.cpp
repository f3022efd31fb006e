// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "io/recordings/camera_file.hpp"
#include "io/recordings/folder_names.hpp"
#include "io/recordings/recording_layouts.hpp"
#include "io/recordings/trajectory_file.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr double kRtabmapUnitsPerM = 1000.0;

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The first name in the folder that ends so.
std::optional<std::string> nameEndingIn(const std::string& folder, const std::string& end) {
  for (const std::string& name : namesIn(folder))
    if (endsWith(name, end)) return name;
  return std::nullopt;
}

/// Poses of the camera where they were exported, else of the robot.
std::optional<std::string> posesIn(const std::string& folder) {
  if (auto camera = nameEndingIn(folder, "camera_poses.txt")) return camera;
  return nameEndingIn(folder, "poses.txt");
}

/// An image's name without its ending: its stamp or its id.
std::optional<double> valueOf(const std::string& name) {
  return numberIn(std::filesystem::path(name).stem().string());
}

std::vector<RecordedImage> imagesIn(const std::string& folder, const std::string& subfolder) {
  std::vector<RecordedImage> images;
  for (const std::string& name : namesIn(joined(folder, subfolder))) {
    if (const auto value = valueOf(name))
      images.push_back({*value, (std::filesystem::path(subfolder) / name).string(), ""});
  }
  std::stable_sort(
      images.begin(), images.end(),
      [](const RecordedImage& a, const RecordedImage& b) { return a.stamp_s < b.stamp_s; });
  return images;
}

/// Images named by id take the stamp of the pose that has the id.
void stampById(const Trajectory& trajectory, std::vector<RecordedImage>& images) {
  std::map<long, double> stamp_of;
  for (std::size_t i = 0; i < trajectory.ids.size(); ++i)
    stamp_of[trajectory.ids[i]] = trajectory.poses[i].stamp_s;
  for (RecordedImage& image : images) {
    const auto known = stamp_of.find(static_cast<long>(image.stamp_s));
    if (known != stamp_of.end()) {
      image.stamp_s = known->second;
    } else {
      image.problem =
          refuse(image.path, "has no pose of its id", "a line with the id is needed").what();
    }
  }
}

bool areNamedById(const std::vector<RecordedImage>& images) {
  constexpr double kLargestId = 1e9;
  return std::all_of(images.begin(), images.end(), [](const RecordedImage& image) {
    return image.stamp_s < kLargestId &&
           image.stamp_s == static_cast<double>(static_cast<long>(image.stamp_s));
  });
}

}  // namespace

bool isRtabmapRecording(const std::string& folder) {
  const auto depth = nameEndingIn(folder, "depth");
  return depth && isFolderIn(folder, *depth) && nameEndingIn(folder, "calib") && posesIn(folder);
}

Recording readRtabmapRecording(const std::string& folder, const SequenceReaderConfig& config) {
  Recording recording;
  recording.layout = "RTAB-Map export";
  const std::string depth = *nameEndingIn(folder, "depth");
  const std::string calibration = *nameEndingIn(folder, "calib");
  recording.depth_images = imagesIn(folder, depth);
  if (recording.depth_images.empty()) {
    throw refuse(joined(folder, depth), "holds no depth image",
                 "PNGs named by stamp or id are needed");
  }
  if (const auto color = nameEndingIn(folder, "rgb"))
    recording.color_images = imagesIn(folder, *color);

  std::string camera = config.camera_path;
  if (camera.empty()) {
    const auto file = nameEndingIn(joined(folder, calibration), ".yaml");
    if (!file)
      throw refuse(joined(folder, calibration), "holds no .yaml", "a calibration is needed");
    camera = joined(joined(folder, calibration), *file);
  }
  const CameraFile file = readCameraFile(camera);
  recording.camera = completed(file.camera, sizeOfFirst(folder, recording.depth_images), camera);
  recording.depth_units_per_m = file.depth_units_per_m.value_or(kRtabmapUnitsPerM);

  const std::string own = *posesIn(folder);
  const std::string path = config.poses_path.empty() ? joined(folder, own) : config.poses_path;
  Trajectory trajectory = readTrajectory(path, config);
  if (trajectory.is_numbered) {
    throw refuse(path, "holds matrices without time stamps",
                 "poses with stamps are needed: rtabmap-export --poses_camera --poses_format 11");
  }
  if (areNamedById(recording.depth_images) && !trajectory.ids.empty()) {
    stampById(trajectory, recording.depth_images);
    stampById(trajectory, recording.color_images);
  }
  if (config.poses_path.empty() && !endsWith(own, "camera_poses.txt") &&
      config.pose_frame == PoseFrame::kOptical) {
    recording.assumptions.push_back(
        path +
        ": the poses are taken as the camera's optical frame's; those of the robot come "
        "from --poses, those of the camera from --poses_camera of rtabmap-export");
  }
  adopt(std::move(trajectory), path, recording);
  return recording;
}

}  // namespace occusg
