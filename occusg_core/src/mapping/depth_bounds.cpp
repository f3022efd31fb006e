// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/depth_bounds.hpp"

#include <Eigen/Core>
#include <algorithm>

namespace occusg {
namespace {

constexpr float kSteps = 32000.0F;
constexpr float kSmallestDepth = 1e-6F;

constexpr auto smaller = [](std::int16_t a, std::int16_t b) { return std::min(a, b); };
constexpr auto larger = [](std::int16_t a, std::int16_t b) { return std::max(a, b); };

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

}  // namespace

void DepthBounds::build(const std::vector<float>& depth, int width, int height, Workers& workers) {
  width_ = width;
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t level = 0; level < kLevels; ++level) {
    nearest_[level].resize(count);
    farthest_[level].resize(count);
  }
  const Eigen::Map<const Eigen::ArrayXf> depths(depth.data(), static_cast<Eigen::Index>(count));
  largest_ = count == 0 ? 0.0F : depths.maxCoeff();
  unit_ = std::max(largest_, kSmallestDepth) / kSteps;
  workers.run(2, [&](int table) {
    table == 0 ? quantizeNearest(depth) : quantizeFarthest(depth);
    for (std::size_t level = 1; level < kLevels; ++level) {
      if (table == 0) {
        combine(nearest_[level - 1], nearest_[level], level, width, height, smaller);
      } else {
        combine(farthest_[level - 1], farthest_[level], level, width, height, larger);
      }
    }
  });
}

void DepthBounds::quantizeNearest(const std::vector<float>& depth) {
  const float steps = 1.0F / unit_;
  std::int16_t* nearest = nearest_[0].data();
  // Rounding of the product is below half a step.
  for (std::size_t i = 0; i < nearest_[0].size(); ++i)
    nearest[i] = static_cast<std::int16_t>(std::max(depth[i] * steps - 0.5F, 0.0F));
}

void DepthBounds::quantizeFarthest(const std::vector<float>& depth) {
  const float steps = 1.0F / unit_;
  std::int16_t* farthest = farthest_[0].data();
  for (std::size_t i = 0; i < farthest_[0].size(); ++i)
    farthest[i] = static_cast<std::int16_t>(depth[i] * steps + (depth[i] > 0.0F ? 1.5F : 0.0F));
}

float DepthBounds::nearest(const PixelBox& box) const {
  const std::size_t level = levelFor(box, kLevels);
  return unit_ * static_cast<float>(bestOver(nearest_[level].data(), box, level, width_, smaller));
}

float DepthBounds::farthest(const PixelBox& box) const {
  const std::size_t level = levelFor(box, kLevels);
  return unit_ * static_cast<float>(bestOver(farthest_[level].data(), box, level, width_, larger));
}

}  // namespace occusg
