// SPDX-License-Identifier: BSD-3-Clause
#include "io/recordings/trajectory_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "io/recordings/folder_names.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr std::size_t kMaxPoseFileBytes = std::size_t{1} << 16U;
constexpr std::size_t kMaxHeaderBytes = 4096;
constexpr std::size_t kPoseFieldCount = 8;
constexpr std::size_t kMatrix34 = 12;
constexpr std::size_t kMatrix44 = 16;
constexpr double kRotationTolerance = 1e-2;
constexpr const char* kForm = "timestamp tx ty tz qx qy qz qw";
constexpr std::array<const char*, kPoseFieldCount> kFieldsXyzw = {"timestamp", "tx", "ty", "tz",
                                                                  "qx",        "qy", "qz", "qw"};
constexpr std::array<const char*, kPoseFieldCount> kFieldsWxyz = {"timestamp", "tx", "ty", "tz",
                                                                  "qw",        "qx", "qy", "qz"};

/// How the lines of a file are to be read.
struct Format {
  bool w_first = false;
  bool has_id = false;
  bool has_further_columns = false;    ///< Only the first eight count.
  std::optional<double> stamp_unit_s;  ///< Where the header states it.
  std::string odd_column;              ///< One the header names that is no part of a pose.
};

/// What may be why a line cannot be read, for the end of a sentence; empty for nothing.
std::string oddColumn(const Format& format) {
  if (format.odd_column.empty()) return "";
  return ", and the header's column \"" + shown(format.odd_column) + "\" is no part of that";
}

std::string withSpaces(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  return text;
}

/// The names of the columns in the first line that names them: lower case, without units.
std::vector<std::string> columnsOf(const std::string& beginning) {
  for (std::size_t start = 0; start < beginning.size();) {
    const std::size_t end = std::min(beginning.find('\n', start), beginning.size());
    std::string line = beginning.substr(start, end - start);
    start = end + 1;
    std::transform(line.begin(), line.end(), line.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const std::size_t hash = line.find('#');
    if (hash != std::string::npos) line.erase(0, hash + 1);
    std::vector<std::string> columns;
    for (std::string& word : wordsOf(withSpaces(line))) {
      const std::size_t unit = word.find('[');
      word.erase(std::min(unit, word.size()));
      if (!word.empty()) columns.push_back(std::move(word));
    }
    const bool names = columns.size() >= kPoseFieldCount && !numberIn(columns[0]);
    if (names) return columns;
  }
  return {};
}

/// The unit that the name of the first column has in square brackets, as in "#timestamp [ns],".
std::optional<double> statedUnit_s(const std::string& beginning) {
  const std::string head = beginning.substr(0, beginning.find_first_of(",\n"));
  for (const auto& [unit, seconds] : {std::pair{"[ns]", 1e-9}, std::pair{"[us]", 1e-6},
                                      std::pair{"[ms]", 1e-3}, std::pair{"[s]", 1.0}})
    if (head.find(unit) != std::string::npos) return seconds;
  return std::nullopt;
}

std::size_t placeOfQuaternionPart(const std::vector<std::string>& columns, char part) {
  const auto found = std::find_if(columns.begin(), columns.end(), [part](const auto& name) {
    return name.front() == 'q' && name.back() == part;
  });
  return static_cast<std::size_t>(found - columns.begin());
}

/// The first column of a header that no pose has; empty where there is none, and for a comment in
/// words.
std::string oddOneOf(const std::vector<std::string>& columns) {
  constexpr std::ptrdiff_t kFewestAxes = 3;
  const auto is_axis = [](const std::string& name) {
    return name.find_last_of("xyzw") == name.size() - 1;
  };
  const auto is_known = [&](const std::string& name) {
    const auto has = [&name](const char* part) { return name.find(part) != std::string::npos; };
    return is_axis(name) || has("time") || has("stamp") || has("sec") || name == "t" ||
           name == "id";
  };
  if (std::count_if(columns.begin(), columns.end(), is_axis) < kFewestAxes) return "";
  const auto odd = std::find_if_not(columns.begin(), columns.end(), is_known);
  return odd == columns.end() ? "" : *odd;
}

Format formatOf(const std::string& path, const SequenceReaderConfig& config) {
  Format format;
  const std::string beginning = readBeginning(path, kMaxHeaderBytes);
  const std::vector<std::string> columns = columnsOf(beginning);
  const std::size_t w = placeOfQuaternionPart(columns, 'w');
  const std::size_t x = placeOfQuaternionPart(columns, 'x');
  format.w_first = config.w_first || (w < columns.size() && x < columns.size() && w < x);
  format.has_id = columns.size() == kPoseFieldCount + 1 && columns.back() == "id";
  format.has_further_columns = columns.size() > kPoseFieldCount + 1;
  format.stamp_unit_s = statedUnit_s(beginning);
  format.odd_column = oddOneOf(columns);
  return format;
}

/// Pose from the numbers of a line, or the reason why not.
std::string readPose(const std::vector<std::string>& words, const std::string& where,
                     const Format& format, Pose& pose) {
  const auto& fields = format.w_first ? kFieldsWxyz : kFieldsXyzw;
  std::array<double, kPoseFieldCount> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto number = numberIn(words[i]);
    if (!number) return numberProblem(where, fields[i], words[i]);
    v[i] = *number;
  }
  const Eigen::Quaterniond rotation = format.w_first ? Eigen::Quaterniond(v[4], v[5], v[6], v[7])
                                                     : Eigen::Quaterniond(v[7], v[4], v[5], v[6]);
  const double norm = rotation.norm();
  if (!(std::abs(norm - 1.0) <= kUnitQuaternionTolerance)) {
    return refuse(where, "the quaternion has norm " + toText(norm),
                  "1 within " + toText(kUnitQuaternionTolerance) + " is needed" + oddColumn(format))
        .what();
  }
  pose = Pose::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[1], v[2], v[3]);
  return "";
}

/// What a line is wrong about before its fields are looked at; empty when nothing.
std::string formProblem(const TextLine& line, std::size_t words, const std::string& where,
                        const Format& format) {
  const std::string needed = std::string("\"") + kForm + "\" is needed";
  if (line.text.size() > kMaxLineLength) {
    return refuse(where, "is longer than " + std::to_string(kMaxLineLength) + " characters", needed)
        .what();
  }
  const std::size_t exact = format.has_id ? kPoseFieldCount + 1 : kPoseFieldCount;
  const bool fits = words == exact || (format.has_further_columns && words > kPoseFieldCount);
  if (fits) return "";
  return refuse(where, "\"" + shown(line.text) + "\" has " + counted(words, "field"),
                needed + oddColumn(format))
      .what();
}

/// A pose from a matrix of 3 x 4 or more, row by row; the reason why not.
std::string poseFromMatrix(const std::vector<double>& values, const std::string& where,
                           Pose& pose) {
  Pose read = Pose::Identity();
  auto value = values.begin();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) read.matrix()(row, column) = *value++;
  }
  if (!isFinite(read))
    return refuse(where, "the pose is not finite: tracking was lost", "a pose is needed").what();
  const Eigen::Matrix3d rotation = read.linear();
  const Eigen::Matrix3d error = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
  if (!(error.cwiseAbs().maxCoeff() <= kRotationTolerance) || rotation.determinant() < 0.0)
    return refuse(where, "the matrix is no rotation", "a rigid transform is needed").what();
  read.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  pose = read;
  return "";
}

/// The values of a line of a matrix; infinities and NaN are values here, for a lost pose.
std::optional<std::vector<double>> matrixIn(const std::vector<std::string>& words) {
  std::vector<double> values;
  for (const std::string& word : words) {
    std::string bare = word;
    bare.erase(0, bare.find_first_not_of("+-"));
    std::transform(bare.begin(), bare.end(), bare.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool is_lost = bare.rfind("inf", 0) == 0 || bare.rfind("nan", 0) == 0;
    const auto number = is_lost ? std::optional<double>(std::nan("")) : numberIn(word);
    if (!number) return std::nullopt;
    values.push_back(*number);
  }
  return values;
}

void note(std::vector<std::string>& sentences, const std::string& sentence) {
  if (sentences.size() < kMaxUnusableLines) sentences.push_back(sentence);
}

bool isMatrixList(const std::vector<TextLine>& lines) {
  if (lines.empty()) return false;
  const std::size_t words = wordsOf(withSpaces(lines.front().text)).size();
  return words == kMatrix34 || words == kMatrix44;
}

Trajectory readMatrices(const std::vector<TextLine>& lines, const std::string& path) {
  Trajectory trajectory;
  trajectory.is_numbered = true;
  double number = 0.0;
  for (const TextLine& line : lines) {
    const std::string where = placeOf(path, line);
    RecordedPose pose;
    pose.stamp_s = number++;
    const auto values = matrixIn(wordsOf(withSpaces(line.text)));
    if (!values || (values->size() != kMatrix34 && values->size() != kMatrix44)) {
      pose.problem = refuse(where, "is no matrix", "12 or 16 numbers are needed").what();
    } else {
      pose.problem = poseFromMatrix(*values, where, pose.T_map_camera);
    }
    if (!pose.problem.empty()) note(trajectory.unusable_lines, pose.problem);
    (pose.problem.empty() ? trajectory.poses : trajectory.unusable).push_back(pose);
  }
  return trajectory;
}

void readLine(const TextLine& line, const std::string& path, const Format& format,
              Trajectory& trajectory) {
  const std::string where = placeOf(path, line);
  const std::vector<std::string> words = wordsOf(withSpaces(line.text));
  RecordedPose entry;
  entry.problem = formProblem(line, words.size(), where, format);
  if (entry.problem.empty()) entry.problem = readPose(words, where, format, entry.T_map_camera);
  std::optional<double> id = 0.0;
  if (entry.problem.empty() && format.has_id) {
    id = numberIn(words[kPoseFieldCount]);
    if (!id || std::abs(*id) > 1e9)
      entry.problem = numberProblem(where, "id", words[kPoseFieldCount]);
  }
  const auto stamp = words.empty() ? std::nullopt : numberIn(words[0]);
  entry.stamp_s = stamp.value_or(0.0);
  if (entry.problem.empty()) {
    if (format.has_id) trajectory.ids.push_back(std::lround(*id));
    trajectory.poses.push_back(std::move(entry));
    return;
  }
  note(trajectory.unusable_lines, entry.problem);
  if (stamp) trajectory.unusable.push_back(std::move(entry));
}

/// A first line without '#' that names the columns.
bool namesColumns(const TextLine& line) {
  const std::vector<std::string> words = wordsOf(withSpaces(line.text));
  return words.size() >= kPoseFieldCount &&
         std::none_of(words.begin(), words.end(),
                      [](const std::string& word) { return numberIn(word).has_value(); });
}

void toSeconds(Trajectory& trajectory, const std::string& path, const Format& format) {
  double largest = 0.0;
  for (const RecordedPose& pose : trajectory.poses) largest = std::max(largest, pose.stamp_s);
  const double unit_s = format.stamp_unit_s.value_or(secondsPerUnit(largest));
  if (unit_s == 1.0) return;
  for (RecordedPose& pose : trajectory.poses) pose.stamp_s *= unit_s;
  for (RecordedPose& pose : trajectory.unusable) pose.stamp_s *= unit_s;
  if (format.stamp_unit_s) return;
  trajectory.assumptions.push_back(path + ": stamps are taken as multiples of " + toText(unit_s) +
                                   " s, because of their size");
}

}  // namespace

std::string numberProblem(const std::string& where, const std::string& field,
                          const std::string& word) {
  return refuse(where, field + " is \"" + shown(word) + "\"", "a finite number is needed").what();
}

double secondsPerUnit(double largest_stamp) {
  constexpr double kLargestSeconds = 1e11;
  double unit_s = 1.0;
  while (largest_stamp * unit_s > kLargestSeconds && unit_s > 1e-9) unit_s /= 1000.0;
  return unit_s == 1.0 ? 1.0 : std::pow(10.0, std::round(std::log10(unit_s)));
}

Trajectory readTrajectory(const std::string& path, const SequenceReaderConfig& config) {
  std::vector<TextLine> lines = readLines(path);
  if (isMatrixList(lines)) {
    Trajectory trajectory = readMatrices(lines, path);
    if (trajectory.poses.empty())
      throw Error(trajectory.unusable_lines.front() + " (no other line is usable either)");
    return trajectory;
  }
  if (!lines.empty() && namesColumns(lines.front())) lines.erase(lines.begin());
  const Format format = formatOf(path, config);
  Trajectory trajectory;
  for (const TextLine& line : lines) readLine(line, path, format, trajectory);
  if (trajectory.poses.empty() && trajectory.unusable_lines.empty())
    throw refuse(path, "holds no pose", std::string("\"") + kForm + "\" lines are needed");
  if (trajectory.poses.empty())
    throw Error(trajectory.unusable_lines.front() + " (no other line is usable either)");
  toSeconds(trajectory, path, format);
  return trajectory;
}

Pose readPoseFile(const std::string& path) {
  std::string text = readFile(path, kMaxPoseFileBytes);
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto values = matrixIn(wordsOf(withSpaces(text)));
  if (!values || values->size() != kMatrix44)
    throw refuse(path, "is no matrix of 4 x 4", "16 numbers are needed");
  Pose pose;
  const std::string problem = poseFromMatrix(*values, path, pose);
  if (!problem.empty()) throw Error(problem);
  return pose;
}

void adopt(Trajectory trajectory, const std::string& path, Recording& recording) {
  const auto earlier = [](const RecordedPose& a, const RecordedPose& b) {
    return a.stamp_s < b.stamp_s;
  };
  std::stable_sort(trajectory.poses.begin(), trajectory.poses.end(), earlier);
  std::stable_sort(trajectory.unusable.begin(), trajectory.unusable.end(), earlier);
  recording.poses = std::move(trajectory.poses);
  recording.unusable_poses = std::move(trajectory.unusable);
  recording.unusable_lines.insert(recording.unusable_lines.end(), trajectory.unusable_lines.begin(),
                                  trajectory.unusable_lines.end());
  recording.assumptions.insert(recording.assumptions.end(), trajectory.assumptions.begin(),
                               trajectory.assumptions.end());
  recording.poses_path = path;
}

void adoptPoseFiles(const std::string& folder, const std::vector<std::string>& pose_paths,
                    Recording& recording) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < pose_paths.size(); ++i) {
    RecordedPose entry;
    entry.stamp_s = recording.depth_images[i].stamp_s;
    try {
      entry.T_map_camera = readPoseFile(joined(folder, pose_paths[i]));
    } catch (const Error& error) {
      entry.problem = error.what();
    }
    (entry.problem.empty() ? trajectory.poses : trajectory.unusable).push_back(std::move(entry));
  }
  if (trajectory.poses.empty() && !trajectory.unusable.empty())
    throw Error(trajectory.unusable.front().problem + " (no other pose is usable either)");
  adopt(std::move(trajectory), folder, recording);
}

}  // namespace occusg
