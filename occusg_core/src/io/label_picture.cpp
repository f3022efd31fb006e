// SPDX-License-Identifier: BSD-3-Clause
#include "io/label_picture.hpp"

#include <cmath>
#include <map>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>

#include "geometry/cell_outline.hpp"
#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "io/overview_picture.hpp"
#include "occusg/error.hpp"
#include "occusg/io/png_check.hpp"
#include "occusg/io/rooms_file.hpp"

namespace occusg {
namespace {

constexpr std::size_t kMaxLabelFileBytes = std::size_t{1} << 30U;

cv::Mat labelPixels(const std::string& path) {
  const std::string bytes = readFile(path, kMaxLabelFileBytes);
  const PngHeader header = checkPng(bytes, path);
  if (header.bit_depth != 16 || header.channels != 1) {
    throw refuse(path,
                 "has " + std::to_string(header.bit_depth) + " bits and " +
                     std::to_string(header.channels) + " channels",
                 "a picture of labels has 16 bits and one channel");
  }
  const std::vector<unsigned char> buffer(bytes.begin(), bytes.end());
  cv::Mat pixels;
  try {
    pixels = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    pixels = cv::Mat();
  }
  if (pixels.type() != CV_16UC1 || pixels.cols != header.width || pixels.rows != header.height)
    throw refuse(path, "cannot be decoded", "a complete PNG is needed");
  return pixels;
}

}  // namespace

std::string labelPng(const Grid<std::int32_t>& labels, const CellBox& box) {
  cv::Mat pixels(box.height(), box.width(), CV_16UC1);
  for (int row = 0; row < pixels.rows; ++row) {
    for (int column = 0; column < pixels.cols; ++column) {
      const std::int32_t label = labels.valueOr({box.min.x + column, box.max.y - 1 - row}, 0);
      if (label < 0 || label > kMaxPictureLabel) {
        throw refuse("labels", "a room has the id " + std::to_string(label),
                     "a picture holds ids from 0 to " + std::to_string(kMaxPictureLabel));
      }
      pixels.at<std::uint16_t>(row, column) = static_cast<std::uint16_t>(label);
    }
  }
  return encodePng(pixels);
}

std::vector<LabelledRoom> readLabelledRooms(const std::string& path, double resolution_m) {
  if (!std::isfinite(resolution_m) || resolution_m <= 0.0) {
    throw refuse(path, "has a resolution of " + toText(resolution_m) + " m",
                 "a positive number is needed");
  }
  const cv::Mat pixels = labelPixels(path);
  Grid<std::int32_t> labels({{0, 0}, {pixels.cols, pixels.rows}}, 0);
  std::map<std::int32_t, CellBox> boxes;
  for (int row = 0; row < pixels.rows; ++row) {
    for (int column = 0; column < pixels.cols; ++column) {
      const Cell cell{column, pixels.rows - 1 - row};
      const std::int32_t label = pixels.at<std::uint16_t>(row, column);
      labels.at(cell) = label;
      if (label == 0) continue;
      CellBox& box = boxes[label];
      if (!box.contains(cell)) box = box.including(cell);
    }
  }
  if (boxes.size() > kMaxRooms) {
    throw refuse(path, "holds " + std::to_string(boxes.size()) + " rooms",
                 "at most " + std::to_string(kMaxRooms) + " are read");
  }
  std::vector<LabelledRoom> rooms;
  for (const auto& [label, box] : boxes) {
    LabelledRoom& room = rooms.emplace_back(LabelledRoom{label, {}});
    for (const CellOutline& outline : outlinesOf(labels, label, box))
      room.parts.push_back(toPolygon(outline, GridFrame{resolution_m}));
  }
  return rooms;
}

}  // namespace occusg
