// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/map_files.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "io/json_text.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr unsigned char kFreeGrey = 254;
constexpr unsigned char kObstacleGrey = 0;
constexpr unsigned char kUnknownGrey = 205;

unsigned char greyOf(std::int8_t value) {
  if (value == kFree) return kFreeGrey;
  return value == kUnknown ? kUnknownGrey : kObstacleGrey;
}

std::string pgmOf(const Grid<std::int8_t>& cells) {
  const CellBox& box = cells.box();
  std::string pgm =
      "P5\n" + std::to_string(box.width()) + " " + std::to_string(box.height()) + "\n255\n";
  pgm.reserve(pgm.size() + cells.values().size());
  for (int y = box.max.y - 1; y >= box.min.y; --y) {
    for (int x = box.min.x; x < box.max.x; ++x)
      pgm.push_back(static_cast<char>(greyOf(cells.at({x, y}))));
  }
  return pgm;
}

/// A multiple of the resolution without the digits its multiplication adds (0.15000000000000002).
std::string metres(double value) { return toText(rounded(value, 9)); }

std::string yamlOf(const Point2& origin, double resolution_m, const std::string& picture_name) {
  // 205 is (255 - 205) / 255 = 0.19608 occupied: just above free_thresh, hence unknown.
  return "image: " + picture_name + "\nresolution: " + metres(resolution_m) + "\norigin: [" +
         metres(origin.x) + ", " + metres(origin.y) +
         ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n";
}

bool needsNoQuotes(const std::string& name) {
  return !name.empty() && name.front() != '-' &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-';
         });
}

}  // namespace

MapFiles toMapFiles(const FreeSpace& layer, const std::string& picture_name) {
  const double resolution_m = layer.frame.resolution_m;
  if (!std::isfinite(resolution_m) || resolution_m <= 0.0) {
    throw refuse("map", "resolution is " + toText(resolution_m) + " m",
                 "a positive number is needed");
  }
  if (!needsNoQuotes(picture_name)) {
    throw refuse("map", "picture name \"" + shown(picture_name) + "\"",
                 "letters, digits, '.', '_' and '-' are needed");
  }
  if (layer.cells.empty()) {
    return {pgmOf(Grid<std::int8_t>({{0, 0}, {1, 1}}, kUnknown)),
            yamlOf({0.0, 0.0}, resolution_m, picture_name)};
  }
  return {pgmOf(layer.cells.dense()),
          yamlOf(layer.frame.corner(layer.cells.box().min), resolution_m, picture_name)};
}

}  // namespace occusg
