// SPDX-License-Identifier: BSD-3-Clause
#include "io/map_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "io/json_text.hpp"
#include "occusg/mapping/free_space_cells.hpp"
#include "occusg/mapping/occupancy_thresholds.hpp"

namespace occusg {
namespace {

constexpr int kNone = -1;
using GreyCounts = std::array<std::size_t, 256>;

/// The pixels as map_server averages them: in trinary mode alpha counts as a channel of its own.
cv::Mat averaged(const MapPicture& picture, MapMode mode) {
  if (picture.alpha.empty() || mode != MapMode::kTrinary) return picture.grey;
  cv::Mat mean = picture.grey.clone();
  for (int row = 0; row < mean.rows; ++row) {
    auto* grey = mean.ptr<std::uint8_t>(row);
    const auto* alpha = picture.alpha.ptr<std::uint8_t>(row);
    // The colours weigh three times as much, as in a colour picture.
    for (int x = 0; x < mean.cols; ++x)
      grey[x] = static_cast<std::uint8_t>((3 * grey[x] + alpha[x]) / 4);
  }
  return mean;
}

double occupancy(int grey, MapPolarity polarity) {
  return (polarity == MapPolarity::kDarkIsFree ? grey : 255 - grey) / 255.0;
}

GreyCounts countGreys(const cv::Mat& pixels) {
  GreyCounts counts{};
  for (int row = 0; row < pixels.rows; ++row) {
    const auto* grey = pixels.ptr<std::uint8_t>(row);
    for (int x = 0; x < pixels.cols; ++x) ++counts[grey[x]];
  }
  return counts;
}

std::string shareOf(std::size_t part, const GreyCounts& counts) {
  const std::size_t all = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  return std::to_string(static_cast<int>(
             std::lround(100.0 * static_cast<double>(part) / static_cast<double>(all)))) +
         " %";
}

/// The middle grey of a picture that map_saver may have written: free is white, occupied black, and
/// one grey lies between, or only its own 205 and one of the others are there.
int middleOfThree(const GreyCounts& counts, MapPolarity polarity) {
  constexpr int kSaversUnknown = 205;
  constexpr double kSurelyFree = 0.02;
  constexpr double kSurelyOccupied = 0.96;
  // A grey nearer to white or black was drawn by hand.
  constexpr double kLightest = 0.1;
  constexpr double kDarkest = 0.9;
  std::vector<int> between;
  bool has_free = false;
  bool has_occupied = false;
  for (int grey = 0; grey < 256; ++grey) {
    if (counts[static_cast<std::size_t>(grey)] == 0) continue;
    const double p = occupancy(grey, polarity);
    if (p <= kSurelyFree) {
      has_free = true;
    } else if (p < kLightest || p > kDarkest) {
      if (p < kSurelyOccupied) return kNone;
      has_occupied = true;
    } else {
      between.push_back(grey);
    }
  }
  if (between.size() != 1) return kNone;
  if ((has_free && has_occupied) || between.front() == kSaversUnknown) return between.front();
  return kNone;
}

/// Whether a picture holds probabilities; its most frequent grey near one half is taken for
/// unknown.
bool holdsProbabilities(const GreyCounts& counts, MapPolarity polarity) {
  std::size_t most = 0;
  for (std::size_t grey = 96; grey < 160; ++grey) most = std::max(most, counts[grey]);
  OccupancyHistogram histogram{};
  bool unknown_left_out = false;
  for (int grey = 0; grey < 256; ++grey) {
    const std::size_t count = counts[static_cast<std::size_t>(grey)];
    if (!unknown_left_out && count == most && grey >= 96 && grey < 160) {
      unknown_left_out = true;
      continue;
    }
    // map_saver's unknown, which is no probability either.
    if (grey == 205 && polarity == MapPolarity::kDarkIsOccupied && most == 0) continue;
    histogram[static_cast<std::size_t>(std::lround(100.0 * occupancy(grey, polarity)))] += count;
  }
  return occupancyKind(histogram) == OccupancyKind::kProbability;
}

/// What each grey stands for.
std::array<std::int8_t, 256> valuesOf(const MapDescription& map, double free_below,
                                      double occupied_above) {
  std::array<std::int8_t, 256> values{};
  for (int grey = 0; grey < 256; ++grey) {
    std::int8_t& value = values[static_cast<std::size_t>(grey)];
    const double p = occupancy(grey, map.polarity);
    if (map.mode == MapMode::kRaw) {
      const int raw = map.polarity == MapPolarity::kDarkIsFree ? 255 - grey : grey;
      value = raw <= kFullObstacle ? static_cast<std::int8_t>(raw) : kUnknown;
      continue;
    }
    value = decidedCell(100.0 * p, {100.0 * free_below, 100.0 * occupied_above});
    if (value != kUnknown || map.mode == MapMode::kTrinary) continue;
    const double share = (p - free_below) / (occupied_above - free_below);
    value = static_cast<std::int8_t>(1 + static_cast<int>(98.0 * share));
  }
  return values;
}

}  // namespace

Grid<std::int8_t> mapCells(const MapPicture& picture, const MapDescription& map,
                           const GivenThresholds& given, const CellBox& box,
                           std::vector<std::string>& assumptions) {
  const cv::Mat pixels = averaged(picture, map.mode);
  const GreyCounts counts = countGreys(pixels);
  double free_below = map.free_threshold;
  double occupied_above = map.occupied_threshold;
  const bool decides = map.mode == MapMode::kTrinary && !given.free && !given.occupied;
  const int middle = decides ? middleOfThree(counts, map.polarity) : kNone;
  if (decides && middle == kNone && holdsProbabilities(counts, map.polarity)) {
    constexpr double kHalf = 0.5;
    // Half a grey on both sides stays unknown.
    free_below = kHalf - 0.5 / 255.0;
    occupied_above = kHalf + 0.5 / 255.0;
    assumptions.emplace_back(
        "the picture holds probabilities, not three greys: cells below one half count as free, "
        "above it as occupied "
        "(--free-thresh and --occupied-thresh choose other thresholds)");
  }
  std::array<std::int8_t, 256> values = valuesOf(map, free_below, occupied_above);
  if (middle != kNone && values[static_cast<std::size_t>(middle)] != kUnknown) {
    const auto grey = static_cast<std::size_t>(middle);
    const bool was_free = values[grey] == kFree;
    values[grey] = kUnknown;
    assumptions.push_back("grey " + std::to_string(middle) + " (" + shareOf(counts[grey], counts) +
                          " of the pixels) counts as unknown, as map_saver writes it, not as " +
                          (was_free ? "free, though free_thresh is " + toText(map.free_threshold) +
                                          " (--free-thresh decides otherwise)"
                                    : "occupied, though occupied_thresh is " +
                                          toText(map.occupied_threshold) +
                                          " (--occupied-thresh decides otherwise)"));
  }
  Grid<std::int8_t> cells(box, kUnknown);
  for (int row = 0; row < pixels.rows; ++row) {
    const auto* source = pixels.ptr<std::uint8_t>(row);
    std::int8_t* target = &cells.at({box.min.x, box.max.y - 1 - row});
    const auto* alpha = picture.alpha.empty() ? nullptr : picture.alpha.ptr<std::uint8_t>(row);
    for (int x = 0; x < pixels.cols; ++x)
      target[x] = alpha != nullptr && alpha[x] == 0 ? kUnknown : values[source[x]];
  }
  return cells;
}

}  // namespace occusg
