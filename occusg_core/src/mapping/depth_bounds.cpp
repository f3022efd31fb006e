// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/depth_bounds.hpp"

#include <algorithm>
#include <limits>

namespace occusg {
namespace {

constexpr float kSteps = 32000.0F;

std::size_t levelFor(const PixelBox& box, std::size_t levels) {
  const int side = std::min(box.right - box.left, box.bottom - box.top) + 1;
  std::size_t level = 0;
  while (level + 1 < levels && (2 << level) <= side) ++level;
  return level;
}

/// Calls `visit` with the first pixel of windows of 2^level x 2^level that cover the box exactly.
template <typename Visit>
void coverWithWindows(const PixelBox& box, std::size_t level, int width, Visit&& visit) {
  const int side = 1 << level;
  const int last_x = box.right + 1 - side;
  const int last_y = box.bottom + 1 - side;
  for (int y = box.top;; y = std::min(y + side, last_y)) {
    for (int x = box.left;; x = std::min(x + side, last_x)) {
      visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(x));
      if (x == last_x) break;
    }
    if (y == last_y) break;
  }
}

}  // namespace

void DepthBounds::build(const std::vector<float>& depth, int width, int height) {
  width_ = width;
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t level = 0; level < kLevels; ++level) {
    nearest_[level].resize(count);
    farthest_[level].resize(count);
  }
  quantize(depth);
  for (std::size_t level = 1; level < kLevels; ++level) buildLevel(level, height);
}

void DepthBounds::quantize(const std::vector<float>& depth) {
  const std::size_t count = nearest_[0].size();
  largest_ = 0.0F;
  for (std::size_t i = 0; i < count; ++i) largest_ = std::max(largest_, depth[i]);
  unit_ = std::max(largest_, std::numeric_limits<float>::min()) / kSteps;
  const float steps = 1.0F / unit_;
  for (std::size_t i = 0; i < count; ++i) {
    // Rounding of the division is below half a step.
    const auto down = static_cast<std::int16_t>(std::max(depth[i] * steps - 0.5F, 0.0F));
    nearest_[0][i] = down;
    farthest_[0][i] = static_cast<std::int16_t>(depth[i] > 0.0F ? down + 2 : 0);
  }
}

void DepthBounds::buildLevel(std::size_t level, int height) {
  const int half = 1 << (level - 1);
  const int columns = width_ - 2 * half + 1;
  for (int y = 0; y + 2 * half <= height; ++y) {
    const auto row = static_cast<std::ptrdiff_t>(y) * width_;
    const auto below = row + static_cast<std::ptrdiff_t>(half) * width_;
    const std::int16_t* near_above = nearest_[level - 1].data() + row;
    const std::int16_t* near_below = nearest_[level - 1].data() + below;
    const std::int16_t* far_above = farthest_[level - 1].data() + row;
    const std::int16_t* far_below = farthest_[level - 1].data() + below;
    std::int16_t* nearest = nearest_[level].data() + row;
    std::int16_t* farthest = farthest_[level].data() + row;
    for (int x = 0; x < columns; ++x) {
      nearest[x] = std::min(std::min(near_above[x], near_above[x + half]),
                            std::min(near_below[x], near_below[x + half]));
    }
    for (int x = 0; x < columns; ++x) {
      farthest[x] = std::max(std::max(far_above[x], far_above[x + half]),
                             std::max(far_below[x], far_below[x + half]));
    }
  }
}

float DepthBounds::nearest(const PixelBox& box) const {
  const std::size_t level = levelFor(box, kLevels);
  std::int16_t bound = std::numeric_limits<std::int16_t>::max();
  coverWithWindows(box, level, width_, [&](std::size_t i) {
    bound = std::min(bound, nearest_[level][i]);
  });
  return unit_ * static_cast<float>(bound);
}

float DepthBounds::farthest(const PixelBox& box) const {
  const std::size_t level = levelFor(box, kLevels);
  std::int16_t bound = 0;
  coverWithWindows(box, level, width_, [&](std::size_t i) {
    bound = std::max(bound, farthest_[level][i]);
  });
  return unit_ * static_cast<float>(bound);
}

}  // namespace occusg
