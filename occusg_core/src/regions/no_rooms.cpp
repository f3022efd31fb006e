// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/no_rooms.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <locale>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <vector>

namespace occusg {
namespace {

/// The cells of each 4-connected piece of free space.
std::vector<std::size_t> freePieces(const Grid<std::int8_t>& cells) {
  cv::Mat free(cells.box().height(), cells.box().width(), CV_8U);
  std::transform(
      cells.values().begin(), cells.values().end(), free.ptr<std::uint8_t>(),
      [](std::int8_t value) { return static_cast<std::uint8_t>(value == kFree ? 1 : 0); });
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(free, labels, stats, centroids, 4, CV_32S);
  std::vector<std::size_t> pieces;
  for (int label = 1; label < count; ++label)
    pieces.push_back(static_cast<std::size_t>(stats.at<int>(label, cv::CC_STAT_AREA)));
  return pieces;
}

std::string squareMetres(double area_m2) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(2) << area_m2 << " m2";
  return text.str();
}

}  // namespace

std::string whyNoRooms(const FreeSpace& layer, double min_region_area_m2) {
  if (layer.cells.empty()) return "there is no free-space layer yet";
  const Grid<std::int8_t> cells = layer.cells.dense();
  const double cell_m2 = layer.frame.cellArea();
  const auto count = [&](auto is) {
    return static_cast<double>(std::count_if(cells.values().begin(), cells.values().end(), is)) *
           cell_m2;
  };
  const double free_m2 = count([](std::int8_t value) { return value == kFree; });
  const double unknown_m2 = count([](std::int8_t value) { return value == kUnknown; });
  const double occupied_m2 =
      static_cast<double>(cells.values().size()) * cell_m2 - free_m2 - unknown_m2;
  const std::string rest =
      squareMetres(occupied_m2) + " are occupied and " + squareMetres(unknown_m2) + " unknown";
  const std::vector<std::size_t> pieces = freePieces(cells);
  if (pieces.empty()) return "no cell is free; " + rest;
  const double largest_m2 =
      static_cast<double>(*std::max_element(pieces.begin(), pieces.end())) * cell_m2;
  return squareMetres(free_m2) + " are free in " + std::to_string(pieces.size()) +
         (pieces.size() == 1 ? " piece" : " pieces") + ", the largest of " +
         squareMetres(largest_m2) + "; a region needs " + squareMetres(min_region_area_m2) +
         " in which a robot fits; " + rest;
}

}  // namespace occusg
