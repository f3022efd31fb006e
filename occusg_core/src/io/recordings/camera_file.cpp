// SPDX-License-Identifier: BSD-3-Clause
#include "io/recordings/camera_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr std::size_t kMaxCameraFileBytes = std::size_t{1} << 20U;
constexpr std::size_t kMatrix3 = 9;
constexpr std::size_t kMatrix4 = 16;

using Json = nlohmann::json;

bool anyButZero(const Json& value) {
  if (value.is_number()) return value.get<double>() != 0.0;
  return value.is_array() && std::any_of(value.begin(), value.end(), anyButZero);
}

bool hasDistortion(const Json& document) {
  constexpr std::array<const char*, 9> kNames = {
      "distortion", "distortion_coefficients", "D", "d", "k1", "k2", "p1", "p2", "k3"};
  return std::any_of(kNames.begin(), kNames.end(), [&](const char* name) {
    return document.contains(name) && anyButZero(document[name]);
  });
}

CameraFile fromNiceSlam(const Json& camera, const std::string& where) {
  const auto number = [&](const char* key) {
    return numberOf(member(camera, key, where), where + ": " + key);
  };
  CameraFile file;
  file.camera = {integerOf(member(camera, "w", where), where + ": w"),
                 integerOf(member(camera, "h", where), where + ": h"),
                 number("fx"),
                 number("fy"),
                 number("cx"),
                 number("cy")};
  file.depth_units_per_m = number("scale");
  return file;
}

/// Open3D writes the matrix column by column.
CameraFile fromOpen3d(const Json& document, const std::string& where) {
  const std::string matrix_where = where + ": intrinsic_matrix";
  const Json& matrix = arrayOf(document["intrinsic_matrix"], matrix_where);
  if (matrix.size() != kMatrix3)
    throw refuse(matrix_where, "has " + std::to_string(matrix.size()) + " values", "9 are needed");
  const auto at = [&](std::size_t i) { return numberOf(matrix[i], matrix_where); };
  CameraFile file;
  file.camera = {integerOf(member(document, "width", where), where + ": width"),
                 integerOf(member(document, "height", where), where + ": height"),
                 at(0),
                 at(4),
                 at(6),
                 at(7)};
  return file;
}

CameraFile fromJson(const std::string& text, const std::string& path) {
  const Json document = parseJson(text, path);
  if (document.is_object() && document.contains("camera"))
    return fromNiceSlam(document["camera"], path + ": camera");
  if (document.is_object() && document.contains("intrinsic_matrix"))
    return fromOpen3d(document, path);
  const auto number = [&](const char* key) {
    return numberOf(member(document, key, path), path + ": " + key);
  };
  const auto integer = [&](const char* key) {
    return integerOf(member(document, key, path), path + ": " + key);
  };
  CameraFile file;
  file.camera = {integer("width"), integer("height"), number("fx"),
                 number("fy"),     number("cx"),      number("cy")};
  check(file.camera, path);
  file.depth_units_per_m = checkedDepthUnits(number("depth_scale"), path + ": depth_scale");
  file.has_distortion = hasDistortion(document);
  return file;
}

std::vector<double> numbersIn(const YAML::Node& matrix, const std::string& where) {
  const YAML::Node data = matrix.IsMap() ? matrix["data"] : matrix;
  std::vector<double> numbers;
  if (!data || !data.IsSequence()) throw refuse(where, "has no list 'data'", "one is needed");
  for (const YAML::Node& value : data) {
    const auto number = value.IsScalar() ? numberIn(value.Scalar()) : std::nullopt;
    if (!number) throw refuse(where, "holds what is no number", "finite numbers are needed");
    numbers.push_back(*number);
  }
  return numbers;
}

CameraModel fromMatrix(const std::vector<double>& matrix, const std::string& where) {
  if (matrix.size() != kMatrix3 && matrix.size() != kMatrix4) {
    throw refuse(where, "has " + std::to_string(matrix.size()) + " values",
                 "a matrix of 3 x 3 or 4 x 4 is needed");
  }
  const std::size_t row = matrix.size() == kMatrix3 ? 3 : 4;
  return {0, 0, matrix[0], matrix[row + 1], matrix[2], matrix[row + 2]};
}

CameraFile fromYaml(std::string text, const std::string& path) {
  // OpenCV's first line, "%YAML:1.0", is not what YAML's own standard allows.
  if (text.rfind("%YAML", 0) == 0) text.erase(0, std::min(text.find('\n'), text.size()));
  try {
    const YAML::Node document = YAML::Load(text);
    if (!document.IsMap() || !document["camera_matrix"])
      throw refuse(path, "has no 'camera_matrix'", "a camera file is needed");
    CameraFile file;
    file.camera = fromMatrix(numbersIn(document["camera_matrix"], path + ": camera_matrix"), path);
    if (document["image_width"]) file.camera.width = document["image_width"].as<int>();
    if (document["image_height"]) file.camera.height = document["image_height"].as<int>();
    if (const YAML::Node distortion = document["distortion_coefficients"]) {
      const auto numbers = numbersIn(distortion, path + ": distortion_coefficients");
      file.has_distortion =
          std::any_of(numbers.begin(), numbers.end(), [](double value) { return value != 0.0; });
    }
    return file;
  } catch (const YAML::Exception& error) {
    throw refuse(path + ":" + std::to_string(error.mark.line + 1), error.msg,
                 "the YAML of a camera calibration is needed");
  }
}

/// The numbers of a text that holds nothing else; empty for any other text.
std::vector<double> onlyNumbers(const std::string& text) {
  std::string one_line = text;
  std::replace_if(
      one_line.begin(), one_line.end(), [](char c) { return c == '\n' || c == ','; }, ' ');
  std::vector<double> numbers;
  for (const std::string& word : wordsOf(one_line)) {
    const auto number = numberIn(word);
    if (!number || numbers.size() == kMatrix4) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

double checkedDepthUnits(double units_per_m, const std::string& where) {
  if (!(units_per_m > 0.0 && units_per_m <= 1e6)) {
    throw refuse(where, "is " + toText(units_per_m),
                 "the pixel value of one metre, above 0 and at most 1e6, is needed");
  }
  return units_per_m;
}

CameraFile readCameraFile(const std::string& path) {
  const std::string text = readFile(path, kMaxCameraFileBytes);
  const std::vector<double> numbers = onlyNumbers(text);
  if (!numbers.empty()) return {fromMatrix(numbers, path), std::nullopt, false};
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool is_yaml = text.find("camera_matrix") != std::string::npos &&
                       first != std::string::npos && text[first] != '{';
  return is_yaml ? fromYaml(text, path) : fromJson(text, path);
}

CameraModel completed(CameraModel camera, const ImageSize& size, const std::string& where) {
  if (camera.width == 0) camera.width = size.width;
  if (camera.height == 0) camera.height = size.height;
  check(camera, where);
  return camera;
}

}  // namespace occusg
