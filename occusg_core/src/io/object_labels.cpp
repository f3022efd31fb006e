// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/object_labels.hpp"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "occusg/error.hpp"
#include "occusg/io/png_check.hpp"

namespace occusg {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 26U;
constexpr std::size_t kMaxImageBytes = std::size_t{1} << 28U;
constexpr std::size_t kMaxLabelBytes = 200;

}  // namespace

std::map<int, std::string> readObjectLabels(const std::string& path) {
  const nlohmann::json document = parseJson(readFile(path, kMaxFileBytes), path);
  std::map<int, std::string> labels;
  const nlohmann::json* const objects = optionalMember(document, "objects", path);
  if (objects == nullptr) return labels;
  if (arrayOf(*objects, path + ": objects").size() > kMaxLabelledObjects) {
    throw refuse(path + ": objects", "has " + std::to_string(objects->size()) + " members",
                 "at most " + std::to_string(kMaxLabelledObjects) + " are needed");
  }
  for (std::size_t i = 0; i < objects->size(); ++i) {
    const std::string where = path + ": objects[" + std::to_string(i) + "]";
    const int id = integerOf(member((*objects)[i], "id", where), where + ": id");
    const std::string label = stringOf(member((*objects)[i], "label", where), where + ": label");
    if (id < 1 || id > static_cast<int>(kMaxLabelledObjects))
      throw refuse(where + ": id", "is " + std::to_string(id), "a value in 1..65535 is needed");
    if (label.empty() || label.size() > kMaxLabelBytes) {
      throw refuse(where + ": label", "has " + std::to_string(label.size()) + " bytes",
                   "1 to " + std::to_string(kMaxLabelBytes) + " are needed");
    }
    if (!labels.emplace(id, label).second)
      throw refuse(where + ": id", "is " + std::to_string(id) + " again", "ids must differ");
  }
  return labels;
}

cv::Mat readLabelImage(const std::string& path) {
  const std::string bytes = readFile(path, kMaxImageBytes);
  const PngHeader header = checkPng(bytes, path);
  if (header.bit_depth != 16 || header.channels != 1) {
    throw refuse(path,
                 "has " + std::to_string(header.bit_depth) + " bits and " +
                     std::to_string(header.channels) + " channels",
                 "a label image has 16 bits and one channel");
  }
  const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8UC1,
                     const_cast<char*>(bytes.data()));  // cv::Mat has no view of const data
  cv::Mat pixels;
  try {
    pixels = cv::imdecode(view, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // a limit of the decoder
    pixels.release();
  }
  if (pixels.type() != CV_16UC1 || pixels.cols != header.width || pixels.rows != header.height)
    throw refuse(path, "cannot be decoded", "a complete PNG is needed");
  return pixels;
}

}  // namespace occusg
