// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "io/json_text.hpp"
#include "io/recordings/camera_file.hpp"
#include "io/recordings/folder_names.hpp"
#include "io/recordings/recording_layouts.hpp"
#include "io/recordings/trajectory_file.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;

constexpr double kTumDepthUnitsPerM = 5000.0;
constexpr std::size_t kAssociationFields = 4;

/// The path in a line of a list, or the reason why it cannot be used.
struct ListedPath {
  std::string path;
  std::string problem;
};

bool leavesFolder(const fs::path& path) {
  return path.is_absolute() || std::find(path.begin(), path.end(), fs::path("..")) != path.end();
}

ListedPath pathIn(const TextLine& line, const std::string& where) {
  // A path may hold spaces: it is all that follows the stamp.
  constexpr const char* kSpace = " \t\r";
  const std::size_t stamp = line.text.find_first_not_of(kSpace);
  const std::size_t gap = line.text.find_first_of(kSpace, stamp);
  const std::size_t begin = line.text.find_first_not_of(kSpace, gap);
  const std::size_t end = line.text.find_last_not_of(kSpace) + 1;
  const std::string path = line.text.substr(begin, end - begin);
  if (std::any_of(path.begin(), path.end(), isControl)) {
    return {"", refuse(where, "path \"" + shown(path) + "\" holds a control character",
                       "a path inside the folder is needed")
                    .what()};
  }
  if (leavesFolder(path)) {
    return {"", refuse(where, "path \"" + shown(path) + "\" leaves the folder of the sequence",
                       "a relative path without \"..\" is needed")
                    .what()};
  }
  return {path, ""};
}

/// What a line is wrong about before its fields are looked at; empty when nothing.
std::string formProblem(const TextLine& line, const std::string& where) {
  constexpr const char* kNeeded = "\"timestamp path\" is needed";
  if (line.text.size() > kMaxLineLength) {
    return refuse(where, "is longer than " + std::to_string(kMaxLineLength) + " characters",
                  kNeeded)
        .what();
  }
  const std::size_t words = wordsOf(line.text).size();
  if (words >= 2) return "";
  return refuse(where, "\"" + shown(line.text) + "\" has " + counted(words, "field"), kNeeded)
      .what();
}

RecordedImage imageIn(const TextLine& line, const std::string& where) {
  RecordedImage entry;
  entry.problem = formProblem(line, where);
  if (!entry.problem.empty()) return entry;
  const std::string word = wordsOf(line.text)[0];
  const auto stamp = numberIn(word);
  if (!stamp) {
    entry.problem = numberProblem(where, "timestamp", word);
    return entry;
  }
  const ListedPath listed = pathIn(line, where);
  return {*stamp, listed.path, listed.problem};
}

void toSeconds(std::vector<RecordedImage>& images) {
  double largest = 0.0;
  for (const RecordedImage& image : images) largest = std::max(largest, image.stamp_s);
  const double unit_s = secondsPerUnit(largest);
  if (unit_s == 1.0) return;
  for (RecordedImage& image : images) image.stamp_s *= unit_s;
}

std::vector<RecordedImage> readDepthList(const std::vector<TextLine>& lines,
                                         const std::string& path) {
  std::vector<RecordedImage> images;
  std::optional<double> last_stamp_s;
  std::size_t last_line = 0;
  for (const TextLine& line : lines) {
    const std::string where = placeOf(path, line);
    RecordedImage entry = imageIn(line, where);
    if (entry.problem.empty() && last_stamp_s && entry.stamp_s <= *last_stamp_s) {
      entry.problem =
          refuse(where,
                 "time goes back to " + toText(entry.stamp_s) + " s" + " after " +
                     toText(*last_stamp_s) + " s" + " in line " + std::to_string(last_line),
                 "stamps must increase")
              .what();
    }
    if (entry.problem.empty()) {
      last_stamp_s = entry.stamp_s;
      last_line = line.number;
    }
    images.push_back(std::move(entry));
  }
  if (images.empty()) throw refuse(path, "lists no image", "\"timestamp path\" lines are needed");
  toSeconds(images);
  return images;
}

void readColorList(const std::vector<TextLine>& lines, const std::string& path,
                   Recording& recording) {
  for (const TextLine& line : lines) {
    RecordedImage entry = imageIn(line, placeOf(path, line));
    if (entry.problem.empty()) {
      recording.color_images.push_back(std::move(entry));
    } else if (recording.unusable_lines.size() < kMaxUnusableLines) {
      recording.unusable_lines.push_back(std::move(entry.problem));
    }
  }
  toSeconds(recording.color_images);
  std::stable_sort(
      recording.color_images.begin(), recording.color_images.end(),
      [](const RecordedImage& a, const RecordedImage& b) { return a.stamp_s < b.stamp_s; });
}

/// associations.txt, "stamp path stamp path", as two lists; which is depth is seen from the paths.
struct Associations {
  std::vector<TextLine> depth;
  std::vector<TextLine> color;
};

Associations splitAssociations(const std::string& path) {
  Associations lists;
  for (const TextLine& line : readLines(path)) {
    const std::vector<std::string> words = wordsOf(line.text);
    if (words.size() != kAssociationFields) {
      throw refuse(placeOf(path, line), "has " + counted(words.size(), "field"),
                   "\"timestamp path timestamp path\" is needed");
    }
    TextLine first{line.number, words[0] + " " + words[1]};
    TextLine second{line.number, words[2] + " " + words[3]};
    if (words[1].find("depth") == std::string::npos) std::swap(first, second);
    lists.depth.push_back(std::move(first));
    lists.color.push_back(std::move(second));
  }
  return lists;
}

std::optional<std::string> associationsIn(const std::string& folder) {
  for (const char* name : {"associations.txt", "association.txt", "associate.txt"})
    if (existsIn(folder, name)) return joined(folder, name);
  return std::nullopt;
}

void readImages(const std::string& folder, Recording& recording) {
  const auto associations = associationsIn(folder);
  if (!existsIn(folder, "depth.txt") && associations) {
    const Associations lists = splitAssociations(*associations);
    recording.depth_images = readDepthList(lists.depth, *associations);
    readColorList(lists.color, *associations, recording);
    return;
  }
  const std::string path = joined(folder, "depth.txt");
  recording.depth_images = readDepthList(readLines(path), path);
}

struct KnownCamera {
  const char* name;
  CameraModel camera;
};

/// The calibrations the benchmark's page gives for its three Kinects' colour cameras, into which
/// the depth images are registered.
constexpr std::array<KnownCamera, 3> kTumCameras = {{
    {"freiburg1", {640, 480, 517.3, 516.5, 318.6, 255.3}},
    {"freiburg2", {640, 480, 520.9, 521.0, 325.1, 249.7}},
    {"freiburg3", {640, 480, 535.4, 539.2, 320.1, 247.6}},
}};

const KnownCamera* knownCameraOf(const std::string& folder) {
  std::error_code failed;
  const std::string path = fs::absolute(folder, failed).lexically_normal().string();
  const auto known = std::find_if(
      kTumCameras.begin(), kTumCameras.end(),
      [&](const KnownCamera& camera) { return path.find(camera.name) != std::string::npos; });
  return known == kTumCameras.end() ? nullptr : &*known;
}

void readCamera(const std::string& folder, const SequenceReaderConfig& config,
                Recording& recording) {
  const KnownCamera* known = knownCameraOf(folder);
  const std::string own = joined(folder, "camera.json");
  if (config.camera_path.empty() && !existsIn(folder, "camera.json") && known != nullptr) {
    recording.camera = known->camera;
    recording.depth_units_per_m = kTumDepthUnitsPerM;
    recording.assumptions.push_back(std::string("no camera.json; the camera is taken as ") +
                                    known->name +
                                    " of the TUM RGB-D benchmark, with 5000 units a metre");
    return;
  }
  const std::string path = config.camera_path.empty() ? own : config.camera_path;
  const CameraFile file = readCameraFile(path);
  const bool needs_size = file.camera.width == 0 || file.camera.height == 0;
  recording.camera = completed(
      file.camera, needs_size ? sizeOfFirst(folder, recording.depth_images) : ImageSize{}, path);
  if (file.depth_units_per_m) {
    recording.depth_units_per_m = checkedDepthUnits(*file.depth_units_per_m, path);
  } else if (!config.depth_units_per_m) {
    recording.assumptions.push_back(path +
                                    " has no depth scale; 1000 units a metre are taken "
                                    "(--depth-scale)");
  }
  if (file.has_distortion) {
    recording.assumptions.push_back(
        path + " has distortion coefficients; the depth images are taken as rectified");
  }
}

/// Names of files beside the recording that may hold its poses.
std::string trajectoriesIn(const std::string& folder) {
  std::string found;
  for (const std::string& name : namesIn(folder)) {
    const bool is_one = name.find("rajectory") != std::string::npos ||
                        name.find("poses") != std::string::npos || name == "traj.txt" ||
                        name == "data.csv";
    if (is_one && !isFolderIn(folder, name)) found += (found.empty() ? "'" : ", '") + name + "'";
  }
  return found;
}

void readPoses(const std::string& folder, const SequenceReaderConfig& config,
               Recording& recording) {
  const std::string own = joined(folder, "groundtruth.txt");
  const std::string path = config.poses_path.empty() ? own : config.poses_path;
  const std::string others = trajectoriesIn(folder);
  if (config.poses_path.empty() && !existsIn(folder, "groundtruth.txt") && !others.empty())
    throw refuse(own, "does not exist", "name the poses with --poses; the folder holds " + others);
  Trajectory trajectory = readTrajectory(path, config);
  if (trajectory.is_numbered) {
    const std::size_t poses = trajectory.poses.size() + trajectory.unusable.size();
    const std::size_t images = recording.depth_images.size();
    if (poses != images) {
      throw refuse(path,
                   "holds " + std::to_string(poses) +
                       " matrices without time stamps, and there "
                       "are " +
                       std::to_string(images) + " depth images",
                   "one for each image is needed");
    }
    const auto stamp = [&](RecordedPose& pose) {
      pose.stamp_s = recording.depth_images[static_cast<std::size_t>(pose.stamp_s)].stamp_s;
    };
    for (RecordedPose& pose : trajectory.poses) stamp(pose);
    for (RecordedPose& pose : trajectory.unusable) stamp(pose);
  }
  adopt(std::move(trajectory), path, recording);
}

}  // namespace

bool isTumRecording(const std::string& folder) {
  return existsIn(folder, "depth.txt") || existsIn(folder, "groundtruth.txt") ||
         existsIn(folder, "camera.json");
}

Recording readTumRecording(const std::string& folder, const SequenceReaderConfig& config) {
  Recording recording;
  recording.layout = "TUM RGB-D";
  // The camera first, as a file that is missing there is the commonest fault; its size may need
  // the images.
  if (config.camera_path.empty()) readCamera(folder, config, recording);
  readImages(folder, recording);
  if (!config.camera_path.empty()) readCamera(folder, config, recording);
  readPoses(folder, config, recording);
  if (recording.color_images.empty() && existsIn(folder, "rgb.txt")) {
    const std::string path = joined(folder, "rgb.txt");
    readColorList(readLines(path), path, recording);
  }
  return recording;
}

}  // namespace occusg
