// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/sequence_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "io/json_text.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/io/file_bytes.hpp"
#include "occusg/io/png_check.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxUnusableLines = 100;
constexpr std::size_t kMaxCameraFileBytes = std::size_t{1} << 20U;
constexpr std::size_t kMaxImageBytes = std::size_t{1} << 30U;

std::string at(const std::string& path, const TextLine& line) {
  return path + ":" + std::to_string(line.number);
}

std::string seconds(double value) { return toText(value) + " s"; }

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
std::string formProblem(const TextLine& line, const std::string& where, const char* form,
                        std::size_t min_words, std::size_t max_words) {
  if (line.text.size() > kMaxLineLength) {
    return refuse(where, "is longer than " + std::to_string(kMaxLineLength) + " characters",
                  std::string("\"") + form + "\" is needed")
        .what();
  }
  const std::size_t words = wordsOf(line.text).size();
  if (words < min_words || words > max_words) {
    return refuse(where, "\"" + shown(line.text) + "\" has " + std::to_string(words) + " fields",
                  std::string("\"") + form + "\" is needed")
        .what();
  }
  return "";
}

std::string numberProblem(const std::string& where, const char* field, const std::string& word) {
  return refuse(where, std::string(field) + " is \"" + shown(word) + "\"",
                "a finite number is needed")
      .what();
}

constexpr std::array<const char*, 8> kPoseFields = {"timestamp", "tx", "ty", "tz",
                                                    "qx",        "qy", "qz", "qw"};

/// Pose from the numbers of a line, or the reason why not.
std::string readPose(const std::vector<std::string>& words, const std::string& where, Pose& pose) {
  std::array<double, kPoseFields.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto number = numberIn(words[i]);
    if (!number) return numberProblem(where, kPoseFields[i], words[i]);
    values[i] = *number;
  }
  const Eigen::Quaterniond rotation(values[7], values[4], values[5], values[6]);
  const double norm = rotation.norm();
  if (!(std::abs(norm - 1.0) <= kUnitQuaternionTolerance)) {
    return refuse(where, "the quaternion has norm " + toText(norm),
                  "1 within " + toText(kUnitQuaternionTolerance) + " is needed")
        .what();
  }
  pose = Pose::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(values[1], values[2], values[3]);
  return "";
}

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

template <typename Entry>
void sortByTime(std::vector<Entry>& entries) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.stamp_s < b.stamp_s; });
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
        "camera.json says " + std::to_string(camera.width) + " x " + std::to_string(camera.height));
  }
  cv::Mat pixels = decoded(bytes);
  if (pixels.type() != CV_16UC1 || pixels.cols != camera.width || pixels.rows != camera.height)
    throw refuse(path, "cannot be decoded", "a complete PNG is needed");
  return pixels;
}

}  // namespace

SequenceReader::SequenceReader(const std::string& folder, const SequenceReaderConfig& config)
    : folder_(folder), config_(config) {
  if (!(config.max_time_offset_s >= 0.0 && config.max_time_offset_s <= 1.0)) {
    throw refuse("max_time_offset_s", "is " + toText(config.max_time_offset_s),
                 "a value from 0 to 1 s is needed");
  }
  std::error_code failed;
  if (!fs::is_directory(folder_, failed))
    throw refuse(folder_, "is not a folder that can be read", "the folder of a sequence is needed");
  const fs::path absolute = fs::absolute(folder_, failed).lexically_normal();
  scene_ = (absolute.has_filename() ? absolute : absolute.parent_path()).filename().string();
  readCamera();
  readDepthList();
  readPoses();
  readColorList();
}

void SequenceReader::readCamera() {
  const std::string path = pathOf("camera.json");
  const nlohmann::json document = parseJson(readFile(path, kMaxCameraFileBytes), path);
  const auto number = [&](const char* key) {
    return numberOf(member(document, key, path), path + ": " + key);
  };
  const auto integer = [&](const char* key) {
    return integerOf(member(document, key, path), path + ": " + key);
  };
  camera_ = {integer("width"), integer("height"), number("fx"),
             number("fy"),     number("cx"),      number("cy")};
  check(camera_, path);
  depth_units_per_m_ = number("depth_scale");
  if (!(depth_units_per_m_ > 0.0 && depth_units_per_m_ <= 1e6)) {
    throw refuse(path + ": depth_scale", "is " + toText(depth_units_per_m_),
                 "the pixel value of one metre, above 0 and at most 1e6, is needed");
  }
}

void SequenceReader::readDepthList() {
  const std::string path = pathOf("depth.txt");
  std::optional<double> last_stamp_s;
  std::size_t last_line = 0;
  for (const TextLine& line : readLines(path)) {
    const std::string where = at(path, line);
    ImageEntry entry;
    entry.problem = formProblem(line, where, "timestamp path", 2, kMaxLineLength);
    const auto stamp = entry.problem.empty() ? numberIn(wordsOf(line.text)[0]) : std::nullopt;
    if (entry.problem.empty() && !stamp)
      entry.problem = numberProblem(where, "timestamp", wordsOf(line.text)[0]);
    if (entry.problem.empty()) {
      entry.stamp_s = *stamp;
      const ListedPath listed = pathIn(line, where);
      entry.path = listed.path;
      entry.problem = listed.problem;
    }
    if (entry.problem.empty() && last_stamp_s && *stamp <= *last_stamp_s) {
      entry.problem = refuse(where,
                             "time goes back to " + seconds(*stamp) + " after " +
                                 seconds(*last_stamp_s) + " in line " + std::to_string(last_line),
                             "stamps must increase")
                          .what();
    }
    if (entry.problem.empty()) {
      last_stamp_s = stamp;
      last_line = line.number;
    }
    frames_.push_back(std::move(entry));
  }
  if (frames_.empty()) throw refuse(path, "lists no image", "\"timestamp path\" lines are needed");
}

void SequenceReader::readColorList() {
  const std::string path = pathOf("rgb.txt");
  std::error_code failed;
  if (!fs::exists(path, failed)) return;
  for (const TextLine& line : readLines(path)) {
    const std::string where = at(path, line);
    ImageEntry entry;
    entry.problem = formProblem(line, where, "timestamp path", 2, kMaxLineLength);
    if (entry.problem.empty()) {
      const std::string word = wordsOf(line.text)[0];
      const ListedPath listed = pathIn(line, where);
      const auto stamp = numberIn(word);
      entry = {stamp.value_or(0.0), listed.path,
               stamp ? listed.problem : numberProblem(where, "timestamp", word)};
    }
    if (entry.problem.empty()) {
      color_images_.push_back(std::move(entry));
    } else if (unusable_lines_.size() < kMaxUnusableLines) {
      unusable_lines_.push_back(std::move(entry.problem));
    }
  }
  sortByTime(color_images_);
}

void SequenceReader::readPoses() {
  const std::string path = pathOf("groundtruth.txt");
  for (const TextLine& line : readLines(path)) {
    const std::string where = at(path, line);
    const std::vector<std::string> words = wordsOf(line.text);
    PoseEntry entry;
    entry.problem = formProblem(line, where, "timestamp tx ty tz qx qy qz qw", kPoseFields.size(),
                                kPoseFields.size());
    if (entry.problem.empty()) entry.problem = readPose(words, where, entry.T_map_camera);
    const auto stamp = words.empty() ? std::nullopt : numberIn(words[0]);
    entry.stamp_s = stamp.value_or(0.0);
    if (entry.problem.empty()) {
      poses_.push_back(std::move(entry));
      continue;
    }
    if (unusable_lines_.size() < kMaxUnusableLines) unusable_lines_.push_back(entry.problem);
    if (stamp) unusable_poses_.push_back(std::move(entry));
  }
  if (poses_.empty() && unusable_lines_.empty())
    throw refuse(path, "holds no pose", "\"timestamp tx ty tz qx qy qz qw\" lines are needed");
  if (poses_.empty()) throw Error(unusable_lines_.front() + " (no other line is usable either)");
  sortByTime(poses_);
  sortByTime(unusable_poses_);
}

Pose SequenceReader::poseAt(double stamp_s) const {
  if (const auto* pose = nearest(poses_, stamp_s, config_.max_time_offset_s); pose != nullptr)
    return pose->T_map_camera;
  if (const auto* unusable = nearest(unusable_poses_, stamp_s, config_.max_time_offset_s);
      unusable != nullptr)
    throw Error(unusable->problem);
  const auto* any = nearest(poses_, stamp_s, std::numeric_limits<double>::infinity());
  throw refuse(pathOf("groundtruth.txt"),
               "the pose nearest to " + seconds(stamp_s) + " is at " + seconds(any->stamp_s),
               "one within " + seconds(config_.max_time_offset_s) + " is needed");
}

std::optional<std::string> SequenceReader::truthPath() const {
  std::error_code failed;
  const std::string path = pathOf("rooms.json");
  if (!fs::exists(path, failed)) return std::nullopt;
  return path;
}

Frame SequenceReader::read(std::size_t index) const {
  if (index >= frames_.size()) {
    throw refuse(folder_, "has no frame " + std::to_string(index),
                 "an index below " + std::to_string(frames_.size()) + " is needed");
  }
  const ImageEntry& entry = frames_[index];
  if (!entry.problem.empty()) throw Error(entry.problem);
  Frame frame;
  frame.stamp_s = entry.stamp_s;
  frame.camera = camera_;
  frame.depth_path = pathOf(entry.path);
  frame.T_map_camera = poseAt(entry.stamp_s);
  frame.depth = {readDepthPng(frame.depth_path, camera_), depth_units_per_m_};
  if (const auto* color = nearest(color_images_, entry.stamp_s, config_.max_time_offset_s);
      color != nullptr)
    frame.color_path = pathOf(color->path);
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
