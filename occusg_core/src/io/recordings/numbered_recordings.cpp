// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "io/recordings/camera_file.hpp"
#include "io/recordings/folder_names.hpp"
#include "io/recordings/recording_layouts.hpp"
#include "io/recordings/trajectory_file.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

// The makers' own numbers.
constexpr CameraModel kSevenScenesCamera{640, 480, 585.0, 585.0, 320.0, 240.0};
constexpr double kMillimetresPerM = 1000.0;
constexpr double kIclNuimUnitsPerM = 5000.0;
// The published focal length in y is negative, as the pictures' rows go up; with the rows turned
// over it is positive, and the centre, in the middle, stays.
constexpr CameraModel kIclNuimCamera{640, 480, 481.2, 480.0, 319.5, 239.5};

/// What --camera and --depth-scale say goes before what the layout says.
void setCamera(const CameraModel& of_layout, double units_per_m, const std::string& folder,
               const SequenceReaderConfig& config, Recording& recording) {
  recording.camera = of_layout;
  recording.depth_units_per_m = units_per_m;
  if (config.camera_path.empty()) return;
  const CameraFile file = readCameraFile(config.camera_path);
  recording.camera =
      completed(file.camera, sizeOfFirst(folder, recording.depth_images), config.camera_path);
  if (file.depth_units_per_m)
    recording.depth_units_per_m = checkedDepthUnits(*file.depth_units_per_m, config.camera_path);
}

/// The poses of --poses, or else of the layout's own file, which has no stamps: the n-th pose is
/// that of the n-th image.
void setPoses(const std::string& own_path, const SequenceReaderConfig& config,
              Recording& recording) {
  const std::string path = config.poses_path.empty() ? own_path : config.poses_path;
  Trajectory trajectory = readTrajectory(path, config);
  if (trajectory.is_numbered) {
    const std::size_t images = recording.depth_images.size();
    const auto beyond = [&](const RecordedPose& pose) {
      return pose.stamp_s >= static_cast<double>(images);
    };
    const auto cut = [&](std::vector<RecordedPose>& poses) {
      poses.erase(std::remove_if(poses.begin(), poses.end(), beyond), poses.end());
      for (RecordedPose& pose : poses)
        pose.stamp_s = recording.depth_images[static_cast<std::size_t>(pose.stamp_s)].stamp_s;
    };
    cut(trajectory.poses);
    cut(trajectory.unusable);
  }
  adopt(std::move(trajectory), path, recording);
}

std::vector<std::string> poseFilesOf(const std::vector<NumberedFile>& depth,
                                     const std::vector<NumberedFile>& poses) {
  std::vector<std::string> paths;
  for (const NumberedFile& image : depth) {
    const auto pose = std::lower_bound(
        poses.begin(), poses.end(), image.number,
        [](const NumberedFile& file, long number) { return file.number < number; });
    const bool has_pose = pose != poses.end() && pose->number == image.number;
    paths.push_back(has_pose ? pose->path : image.path + ": its pose file");
  }
  return paths;
}

/// The poses of --poses, or else of a file for each image.
void setPosesOfFiles(const std::string& folder, const std::vector<NumberedFile>& depth,
                     const std::vector<NumberedFile>& poses, const SequenceReaderConfig& config,
                     Recording& recording) {
  if (config.poses_path.empty()) {
    adoptPoseFiles(folder, poseFilesOf(depth, poses), recording);
  } else {
    setPoses(config.poses_path, config, recording);
  }
}

/// Files named by number alone say nothing of time.
void tellStamps(Recording& recording) {
  recording.assumptions.emplace_back("the images have no stamps: 30 a second are assumed");
}

void requireImages(const std::vector<NumberedFile>& depth, const std::string& where) {
  if (depth.empty()) throw refuse(where, "holds no depth image", "numbered PNGs are needed");
}

}  // namespace

bool isSevenScenesRecording(const std::string& folder) {
  const std::vector<std::string> names = namesIn(folder);
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return numberInName(name, "frame-", ".depth.png").has_value();
  });
}

Recording readSevenScenesRecording(const std::string& folder, const SequenceReaderConfig& config) {
  Recording recording;
  recording.layout = "7-Scenes";
  const auto depth = numberedFiles(folder, "", "frame-", ".depth.png");
  recording.depth_images = imagesOf(depth);
  recording.color_images = imagesOf(numberedFiles(folder, "", "frame-", ".color.png"));
  recording.highest_value_is_no_return = true;
  setCamera(kSevenScenesCamera, kMillimetresPerM, folder, config, recording);
  if (config.camera_path.empty()) {
    recording.assumptions.emplace_back(
        "the camera is taken as that of 7-Scenes: focal length 585, centre (320, 240), "
        "millimetres (--camera)");
  }
  tellStamps(recording);
  setPosesOfFiles(folder, depth, numberedFiles(folder, "", "frame-", ".pose.txt"), config,
                  recording);
  return recording;
}

bool isScanNetRecording(const std::string& folder) {
  return isFolderIn(folder, "depth") && isFolderIn(folder, "pose");
}

Recording readScanNetRecording(const std::string& folder, const SequenceReaderConfig& config) {
  Recording recording;
  recording.layout = "ScanNet export";
  const auto depth = numberedFiles(folder, "depth", "", ".png");
  requireImages(depth, joined(folder, "depth"));
  recording.depth_images = imagesOf(depth);
  recording.color_images = imagesOf(numberedFiles(folder, "color", "", ".jpg"));
  const std::string own = existsIn(folder, "intrinsic/intrinsic_depth.txt")
                              ? joined(folder, "intrinsic/intrinsic_depth.txt")
                              : joined(folder, "intrinsic_depth.txt");
  SequenceReaderConfig with_own = config;
  if (with_own.camera_path.empty()) with_own.camera_path = own;
  setCamera({}, kMillimetresPerM, folder, with_own, recording);
  tellStamps(recording);
  setPosesOfFiles(folder, depth, numberedFiles(folder, "pose", "", ".txt"), config, recording);
  return recording;
}

bool isReplicaRecording(const std::string& folder) {
  return isFolderIn(folder, "results") && existsIn(folder, "traj.txt");
}

Recording readReplicaRecording(const std::string& folder, const SequenceReaderConfig& config) {
  Recording recording;
  recording.layout = "Replica of NICE-SLAM";
  const auto depth = numberedFiles(folder, "results", "depth", ".png");
  requireImages(depth, joined(folder, "results"));
  recording.depth_images = imagesOf(depth);
  recording.color_images = imagesOf(numberedFiles(folder, "results", "frame", ".jpg"));
  SequenceReaderConfig with_own = config;
  if (with_own.camera_path.empty()) {
    const bool is_inside = existsIn(folder, "cam_params.json");
    with_own.camera_path = joined(folder, is_inside ? "cam_params.json" : "../cam_params.json");
  }
  setCamera({}, kMillimetresPerM, folder, with_own, recording);
  tellStamps(recording);
  setPoses(joined(folder, "traj.txt"), config, recording);
  return recording;
}

namespace {

std::optional<std::string> freiburgTrajectoryIn(const std::string& folder) {
  for (const std::string& name : namesIn(folder)) {
    const std::size_t at = name.find(".gt.freiburg");
    if (at != std::string::npos) return name;
  }
  return std::nullopt;
}

}  // namespace

bool isIclNuimRecording(const std::string& folder) {
  return isFolderIn(folder, "depth") && freiburgTrajectoryIn(folder).has_value();
}

Recording readIclNuimRecording(const std::string& folder, const SequenceReaderConfig& config) {
  Recording recording;
  recording.layout = "ICL-NUIM";
  const auto depth = numberedFiles(folder, "depth", "", ".png");
  requireImages(depth, joined(folder, "depth"));
  recording.depth_images = imagesOf(depth);
  recording.color_images = imagesOf(numberedFiles(folder, "rgb", "", ".png"));
  recording.rows_go_up = config.camera_path.empty();
  setCamera(kIclNuimCamera, kIclNuimUnitsPerM, folder, config, recording);
  if (config.camera_path.empty()) {
    recording.assumptions.emplace_back(
        "the camera is taken as that of ICL-NUIM: focal lengths 481.2 and -480, 5000 units a "
        "metre (--camera)");
  }
  tellStamps(recording);
  setPoses(joined(folder, *freiburgTrajectoryIn(folder)), config, recording);
  // The trajectory counts images, from 0 or 1.
  if (config.poses_path.empty()) {
    for (auto* poses : {&recording.poses, &recording.unusable_poses})
      for (RecordedPose& pose : *poses) pose.stamp_s /= kNumberedImagesPerSecond;
  }
  return recording;
}

}  // namespace occusg
