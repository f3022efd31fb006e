// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/depth_bounds.hpp"

#include <Eigen/Core>
#include <algorithm>

namespace occusg {
namespace {

constexpr float kSteps = 32000.0F;
constexpr float kSmallestDepth = 1e-6F;

constexpr auto smaller = [](auto a, auto b) { return std::min(a, b); };
constexpr auto larger = [](auto a, auto b) { return std::max(a, b); };

constexpr int kLargestSide = 64;

/// Largest k with 2^k at most the index.
constexpr std::array<std::uint8_t, kLargestSide + 1> floorLog2() {
  std::array<std::uint8_t, kLargestSide + 1> table{};
  for (std::size_t i = 2; i < table.size(); ++i)
    table[i] = static_cast<std::uint8_t>(table[i / 2] + 1);
  return table;
}

std::size_t levelFor(const PixelBox& box, std::size_t levels) {
  static constexpr auto kFloorLog2 = floorLog2();
  const int side = std::min(box.right - box.left, box.bottom - box.top) + 1;
  const std::size_t level = kFloorLog2[static_cast<std::size_t>(std::min(side, kLargestSide))];
  return std::min(level, levels - 1);
}

/// The best of `table` over windows of 2^level x 2^level that cover the box exactly.
template <typename Better>
std::int16_t bestOver(const std::int16_t* table, const PixelBox& box, std::size_t level, int width,
                      Better&& better) {
  const int side = 1 << level;
  const int last_x = box.right + 1 - side;
  const int last_y = box.bottom + 1 - side;
  const auto at = [&](int x, int y) { return table[static_cast<std::ptrdiff_t>(y) * width + x]; };
  std::int16_t best = better(better(at(box.left, box.top), at(last_x, box.top)),
                             better(at(box.left, last_y), at(last_x, last_y)));
  if (last_x - box.left <= side && last_y - box.top <= side) return best;
  for (int y = box.top;; y = std::min(y + side, last_y)) {
    for (int x = box.left; x < last_x; x += side) best = better(best, at(x, y));
    best = better(best, at(last_x, y));
    if (y == last_y) return best;
  }
}

/// From windows of half the side those of one level.
template <typename Better>
void combine(const std::vector<std::int16_t>& halves, std::vector<std::int16_t>& level_table,
             std::size_t level, int width, int height, Better&& better) {
  const int half = 1 << (level - 1);
  const int columns = width - 2 * half + 1;
  for (int y = 0; y + 2 * half <= height; ++y) {
    const auto row = static_cast<std::ptrdiff_t>(y) * width;
    const std::int16_t* above = halves.data() + row;
    const std::int16_t* below = above + static_cast<std::ptrdiff_t>(half) * width;
    std::int16_t* result = level_table.data() + row;
    for (int x = 0; x < columns; ++x)
      result[x] = better(better(above[x], above[x + half]), better(below[x], below[x + half]));
  }
}

/// Of a number of pixels along a side.
int cellsOver(int pixels) { return (pixels + 1) / 2; }

PixelBox cellsOf(const PixelBox& pixels) {
  return {pixels.left / 2, pixels.right / 2, pixels.top / 2, pixels.bottom / 2};
}

}  // namespace

void DepthBounds::begin(int width, int height, float largest) {
  width_ = width;
  height_ = height;
  largest_ = largest;
  unit_ = std::max(largest_, kSmallestDepth) / kSteps;
  const auto count =
      static_cast<std::size_t>(cellsOver(width)) * static_cast<std::size_t>(cellsOver(height));
  for (std::size_t level = 0; level < kLevels; ++level) {
    nearest_[level].resize(count);
    farthest_[level].resize(count);
  }
}

void DepthBounds::buildNearest(const std::vector<float>& depth) {
  const float steps = 1.0F / unit_;
  // Rounding of the product is below half a step.
  reduce(
      depth, smaller, [steps](float value) { return std::max(value * steps - 0.5F, 0.0F); },
      nearest_[0]);
  for (std::size_t level = 1; level < kLevels; ++level) {
    combine(nearest_[level - 1], nearest_[level], level, cellsOver(width_), cellsOver(height_),
            smaller);
  }
}

void DepthBounds::buildFarthest(const std::vector<float>& depth) {
  const float steps = 1.0F / unit_;
  reduce(
      depth, larger, [steps](float value) { return value * steps + (value > 0.0F ? 1.5F : 0.0F); },
      farthest_[0]);
  for (std::size_t level = 1; level < kLevels; ++level) {
    combine(farthest_[level - 1], farthest_[level], level, cellsOver(width_), cellsOver(height_),
            larger);
  }
}

/// The best depth of each cell, rounded outwards.
template <typename Better, typename Quantize>
void DepthBounds::reduce(const std::vector<float>& depth, Better better, Quantize quantize,
                         Table& cells) const {
  const int columns = cellsOver(width_);
  const std::ptrdiff_t whole = width_ / 2;
  for (int row = 0; row < cellsOver(height_); ++row) {
    const float* above = depth.data() + static_cast<std::ptrdiff_t>(2 * row) * width_;
    const float* below = 2 * row + 1 < height_ ? above + width_ : above;
    std::int16_t* cell = cells.data() + static_cast<std::ptrdiff_t>(row) * columns;
    for (std::ptrdiff_t i = 0; i < whole; ++i) {
      cell[i] = static_cast<std::int16_t>(quantize(
          better(better(above[2 * i], above[2 * i + 1]), better(below[2 * i], below[2 * i + 1]))));
    }
    if (whole < columns)
      cell[whole] = static_cast<std::int16_t>(quantize(better(above[2 * whole], below[2 * whole])));
  }
}

float DepthBounds::nearest(const PixelBox& box) const {
  const PixelBox cells = cellsOf(box);
  const std::size_t level = levelFor(cells, kLevels);
  return unit_ * static_cast<float>(
                     bestOver(nearest_[level].data(), cells, level, cellsOver(width_), smaller));
}

float DepthBounds::farthest(const PixelBox& box) const {
  const PixelBox cells = cellsOf(box);
  const std::size_t level = levelFor(cells, kLevels);
  return unit_ * static_cast<float>(
                     bestOver(farthest_[level].data(), cells, level, cellsOver(width_), larger));
}

}  // namespace occusg
