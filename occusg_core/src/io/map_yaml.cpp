// SPDX-License-Identifier: BSD-3-Clause
#include "io/map_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/io/file_bytes.hpp"

namespace occusg {
namespace {

constexpr std::size_t kMaxYamlBytes = std::size_t{64} << 10U;
constexpr const char* kFlatIsNeeded = "map_server's flat 'key: value' form is needed";

// Old yaml-cpp recurses as deep as a file nests: no map nests, so nesting is kept away from it.
void refuseNesting(const std::string& yaml, const std::string& path) {
  const auto opening = std::count_if(yaml.begin(), yaml.end(),
                                     [](char c) { return c == '[' || c == '{' || c == '?'; });
  constexpr int kEnough = 16;
  bool nests = opening > kEnough;
  std::istringstream stream(yaml);
  constexpr std::size_t kMaxIndent = 64;
  for (std::string line; std::getline(stream, line) && !nests;) {
    const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    nests = first > kMaxIndent || line.compare(first, 3, "- -") == 0;
  }
  if (nests) throw refuse(path, "is nested deeply", kFlatIsNeeded);
}

YAML::Node loaded(const std::string& path) {
  const std::string yaml = readFile(path, kMaxYamlBytes);
  refuseNesting(yaml, path);
  YAML::Node root;
  try {
    root = YAML::Load(yaml);
  } catch (const YAML::Exception& error) {
    throw refuse(path + ":" + std::to_string(error.mark.line + 1),
                 "this is not YAML (" + error.msg + ")", kFlatIsNeeded);
  }
  if (!root.IsMap()) throw refuse(path, "holds no keys", kFlatIsNeeded);
  return root;
}

/// The values of one file.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), root_(loaded(path)) {}

  /// The text of `key`; nothing when it is absent.
  [[nodiscard]] std::optional<std::string> text(const std::string& key) const {
    const YAML::Node value = root_[key];
    if (!value) return std::nullopt;
    if (!value.IsScalar()) throw wrong(key, "not a single value", "one value is needed");
    return value.Scalar();
  }

  [[nodiscard]] double number(const std::string& key, const std::string& right) const {
    const auto written = text(key);
    if (!written) throw refuse(path_, "has no " + key, right);
    const auto value = numberIn(*written);
    if (!value) throw wrong(key, "'" + shown(*written) + "'", right);
    return *value;
  }

  [[nodiscard]] Point2 origin() const {
    constexpr const char* kRight = "three numbers [x, y, yaw] are needed";
    const YAML::Node value = root_["origin"];
    if (!value) throw refuse(path_, "has no origin", kRight);
    if (!value.IsSequence() || value.size() != 3)
      throw wrong("origin", "not a list of three", kRight);
    double numbers[3] = {0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string written = value[i].IsScalar() ? value[i].Scalar() : "";
      const auto number = numberIn(written);
      if (!number) throw wrong("origin", "'" + shown(written) + "' in part", kRight);
      numbers[i] = *number;
    }
    constexpr double kNoYaw_rad = 1e-6;
    if (std::abs(numbers[2]) > kNoYaw_rad) {
      throw refuse(path_, "has an origin turned by " + value[2].Scalar() + " rad",
                   "a yaw of 0 is needed: rotate the picture first");
    }
    return {numbers[0], numbers[1]};
  }

  [[nodiscard]] MapPolarity polarity() const {
    const std::string written = text("negate").value_or("0");
    if (written == "0" || written == "false") return MapPolarity::kDarkIsOccupied;
    if (written == "1" || written == "true") return MapPolarity::kDarkIsFree;
    throw wrong("negate", "'" + shown(written) + "'", "0 or 1 is needed");
  }

  [[nodiscard]] MapMode mode() const {
    const std::string written = text("mode").value_or("trinary");
    if (written == "trinary") return MapMode::kTrinary;
    if (written == "scale") return MapMode::kScale;
    if (written == "raw") return MapMode::kRaw;
    throw wrong("mode", "'" + shown(written) + "'", "trinary, scale or raw is needed");
  }

  [[nodiscard]] std::string picturePath() const {
    const std::string name = text("image").value_or("");
    if (name.empty()) throw refuse(path_, "names no image", "the file name of a picture is needed");
    if (std::any_of(name.begin(), name.end(), isControl))
      throw wrong("image", "'" + shown(name) + "'", "a plain file name is needed");
    // An absolute name replaces the folder.
    return (std::filesystem::path(path_).parent_path() / name).string();
  }

 private:
  [[nodiscard]] Error wrong(const std::string& key, const std::string& what,
                            const std::string& right) const {
    const std::string line = std::to_string(root_[key].Mark().line + 1);
    return refuse(path_ + ":" + line, key + " is " + what, right);
  }

  std::string path_;
  const YAML::Node root_;
};

}  // namespace

MapDescription readMapYaml(const std::string& path, const MapReaderOptions& given) {
  const Reader reader(path);
  const auto threshold = [&](const std::optional<double>& wanted, const char* key) {
    return wanted ? *wanted : reader.number(key, "a threshold from 0 to 1 is needed");
  };
  MapDescription map;
  map.picture_path = reader.picturePath();
  map.resolution_m = given.resolution_m ? *given.resolution_m
                                        : reader.number("resolution", "metres a pixel are needed");
  map.origin = given.origin ? *given.origin : reader.origin();
  map.occupied_threshold = threshold(given.occupied_threshold, "occupied_thresh");
  map.free_threshold = threshold(given.free_threshold, "free_thresh");
  map.polarity = given.polarity ? *given.polarity : reader.polarity();
  map.mode = given.mode ? *given.mode : reader.mode();
  return map;
}

}  // namespace occusg
