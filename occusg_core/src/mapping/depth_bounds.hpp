// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace occusg {

/// Pixels [left, right] x [top, bottom], both ends included.
struct PixelBox {
  int left = 0;
  int right = -1;
  int top = 0;
  int bottom = -1;

  [[nodiscard]] bool empty() const { return right < left || bottom < top; }
};

/// Smallest and largest depth over any box of pixels, in a few look-ups (a sparse table: the
/// extremes over the 2^k x 2^k cells from each cell on, a cell being 2 x 2 pixels: so the tables
/// fit into the cache). Bounds are never too narrow: a box grows to whole cells, and depths are
/// held in 16 bits, rounded outwards by at most 1/32000 of the frame's largest depth.
class DepthBounds {
 public:
  /// Begins anew; then the two tables, which may be built at the same time, are all that is needed.
  /// @param largest of the depths.
  void begin(int width, int height, float largest);
  /// @param depth row-major, width * height, not negative; 0 where there is none.
  void buildNearest(const std::vector<float>& depth);
  void buildFarthest(const std::vector<float>& depth);

  [[nodiscard]] float largest() const { return largest_; }
  /// @param box not empty, inside the image.
  [[nodiscard]] float nearest(const PixelBox& box) const;
  [[nodiscard]] float farthest(const PixelBox& box) const;

 private:
  using Table = std::vector<std::int16_t>;
  static constexpr std::size_t kLevels = 5;

  template <typename Better, typename Quantize>
  void reduce(const std::vector<float>& depth, Better better, Quantize quantize,
              Table& cells) const;

  int width_ = 0;  ///< [pixels]
  int height_ = 0;
  float largest_ = 0.0F;
  float unit_ = 1.0F;  ///< Depth of one step.
  std::array<Table, kLevels> nearest_;
  std::array<Table, kLevels> farthest_;
};

}  // namespace occusg
