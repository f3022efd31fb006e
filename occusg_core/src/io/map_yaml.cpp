// SPDX-License-Identifier: BSD-3-Clause
#include "io/map_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"
#include "occusg/parameter.hpp"

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
    // A list in a list; "- -3.2" is a negative number in a list.
    const bool is_list_in_list = line.compare(first, 4, "- - ") == 0 || line.substr(first) == "- -";
    nests = first > kMaxIndent || is_list_in_list;
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

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
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

  /// x, y [m] and yaw [rad].
  [[nodiscard]] std::array<double, 3> origin() const {
    constexpr const char* kRight = "three numbers [x, y, yaw] are needed";
    const YAML::Node value = root_["origin"];
    if (!value) throw refuse(path_, "has no origin", kRight);
    if (!value.IsSequence() || value.size() != 3)
      throw wrong("origin", "not a list of three", kRight);
    std::array<double, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string written = value[i].IsScalar() ? value[i].Scalar() : "";
      const auto number = numberIn(written);
      if (!number) throw wrong("origin", "'" + shown(written) + "' in part", kRight);
      numbers[i] = *number;
    }
    constexpr double kFullTurn_rad = 6.3;
    if (std::abs(numbers[2]) > kFullTurn_rad) {
      throw wrong("origin", "turned by " + toText(numbers[2]) + " rad",
                  "a yaw within a full turn is needed");
    }
    return numbers;
  }

  [[nodiscard]] MapPolarity polarity() const {
    const std::string written = text("negate").value_or("0");
    const std::string word = lowerCase(written);
    const std::optional<double> number = numberIn(written);
    if (number == 0.0 || word == "false" || word == "no" || word == "off")
      return MapPolarity::kDarkIsOccupied;
    if (number == 1.0 || word == "true" || word == "yes" || word == "on")
      return MapPolarity::kDarkIsFree;
    throw wrong("negate", "'" + shown(written) + "'", "0 or 1 is needed");
  }

  [[nodiscard]] MapMode mode() const {
    const std::string written = text("mode").value_or("trinary");
    const std::string word = lowerCase(written);
    if (word == "trinary") return MapMode::kTrinary;
    if (word == "scale") return MapMode::kScale;
    if (word == "raw") return MapMode::kRaw;
    throw wrong("mode", "'" + shown(written) + "'", "trinary, scale or raw is needed");
  }

  /// Tells the keys that `map_server` does not know and those that are written twice.
  void tellOddKeys(std::vector<std::string>& assumptions) const {
    const std::vector<std::string> known = {"image", "resolution",      "origin",     "negate",
                                            "mode",  "occupied_thresh", "free_thresh"};
    std::vector<std::string> seen;
    for (const auto& entry : root_) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
      if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
        assumptions.push_back(shown(key) + " is written twice; the first value counts");
      } else if (std::find(known.begin(), known.end(), key) == known.end()) {
        const std::string suggestion = suggestionFor(key, known);
        assumptions.push_back("the key '" + shown(key) +
                              "' is none of map_server's and was ignored" +
                              (suggestion.empty() ? "" : "; " + suggestion));
      }
      seen.push_back(key);
    }
  }

  /// Where the picture is: as the file says, else beside the file, which may have been moved.
  [[nodiscard]] std::string picturePath(std::vector<std::string>& assumptions) const {
    const std::string name = text("image").value_or("");
    if (name.empty()) throw refuse(path_, "names no image", "the file name of a picture is needed");
    if (std::any_of(name.begin(), name.end(), isControl))
      throw wrong("image", "'" + shown(name) + "'", "a plain file name is needed");
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(path_).parent_path();
    // An absolute name replaces the folder.
    const fs::path written = folder / name;
    const fs::path beside = folder / fs::path(name).filename();
    std::error_code ignored;
    if (fs::exists(written, ignored)) return written.string();
    if (!fs::exists(beside, ignored)) {
      throw wrong("image", "'" + shown(name) + "', which does not exist",
                  "the picture of the map is needed");
    }
    assumptions.push_back("the image " + shown(name) +
                          " is not there; the picture of that name beside " + path_ + " was read");
    return beside.string();
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

MapDescription readMapYaml(const std::string& path, const MapReaderOptions& given,
                           std::vector<std::string>& assumptions) {
  const Reader reader(path);
  const auto threshold = [&](const std::optional<double>& wanted, const char* key) {
    return wanted ? *wanted : reader.number(key, "a threshold from 0 to 1 is needed");
  };
  reader.tellOddKeys(assumptions);
  MapDescription map;
  map.picture_path = reader.picturePath(assumptions);
  map.resolution_m = given.resolution_m ? *given.resolution_m
                                        : reader.number("resolution", "metres a pixel are needed");
  if (given.origin) {
    map.origin = *given.origin;
  } else {
    const std::array<double, 3> origin = reader.origin();
    map.origin = {origin[0], origin[1]};
    map.yaw_rad = origin[2];
  }
  map.occupied_threshold = threshold(given.occupied_threshold, "occupied_thresh");
  map.free_threshold = threshold(given.free_threshold, "free_thresh");
  map.polarity = given.polarity ? *given.polarity : reader.polarity();
  map.mode = given.mode ? *given.mode : reader.mode();
  return map;
}

}  // namespace occusg
