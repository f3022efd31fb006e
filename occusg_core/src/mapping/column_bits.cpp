// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/column_bits.hpp"

#include <algorithm>

namespace occusg {
namespace {

constexpr int kWordVoxels = 64;

/// @pre bits != 0
int lowestBit(std::uint64_t bits) { return __builtin_ctzll(bits); }

int countOf(std::uint64_t bits) { return __builtin_popcountll(bits); }

/// Bits of the voxels of `word` that lie between the heights.
std::uint64_t maskOf(const ColumnWord& word, const VoxelRun& heights) {
  const int from = std::max(0, heights.bottom - word.bottom);
  const int to = std::min(kWordVoxels, heights.top - word.bottom);
  if (from >= to) return 0;
  const std::uint64_t below_top =
      to == kWordVoxels ? ~std::uint64_t{0} : (std::uint64_t{1} << to) - 1;
  return below_top & (~std::uint64_t{0} << from);
}

VoxelRun cutAt(const VoxelRun& heights, const VoxelRun& run) {
  return {std::max(run.bottom, heights.bottom), std::min(run.top, heights.top)};
}

}  // namespace

void ColumnBits::addByte(int bottom, std::uint8_t free, std::uint8_t occupied) {
  if (words_.empty() || bottom >= words_.back().bottom + kWordVoxels)
    words_.push_back({bottom, 0, 0});
  ColumnWord& word = words_.back();
  word.free |= static_cast<std::uint64_t>(free) << (bottom - word.bottom);
  word.occupied |= static_cast<std::uint64_t>(occupied) << (bottom - word.bottom);
}

void ColumnBits::keep(const VoxelRun& heights) {
  std::size_t kept = 0;
  for (ColumnWord word : words_) {
    const std::uint64_t mask = maskOf(word, heights);
    word.free &= mask;
    word.occupied &= mask;
    if ((word.free | word.occupied) != 0) words_[kept++] = word;
  }
  words_.resize(kept);
}

VoxelRun ColumnBits::nextFree(int from) const {
  VoxelRun run;
  for (const ColumnWord& word : words_) {
    if (!run.empty() && run.top != word.bottom) return run;  // unknown voxels between the words
    const int first = run.empty() ? from : word.bottom;
    std::uint64_t free = word.free & maskOf(word, {first, kAllHeights.top});
    if (free == 0) {
      if (!run.empty()) return run;
      continue;
    }
    const int start = lowestBit(free);
    if (!run.empty() && start != 0) return run;
    const std::uint64_t ended = ~(free >> start);  // zeros come in from above
    const int length = ended == 0 ? kWordVoxels : lowestBit(ended);
    if (run.empty()) run.bottom = word.bottom + start;
    run.top = word.bottom + start + length;
    if (run.top != word.bottom + kWordVoxels) return run;
  }
  return run;
}

VoxelRun ColumnBits::lowestFree(const VoxelRun& heights, int needed) const {
  for (VoxelRun run = nextFree(heights.bottom); !run.empty(); run = nextFree(run.top)) {
    if (run.bottom >= heights.top) break;
    const VoxelRun cut = cutAt(heights, run);
    if (cut.length() >= needed) return cut;
  }
  return {};
}

VoxelRun ColumnBits::longestFree(const VoxelRun& beginning, const VoxelRun& within) const {
  VoxelRun longest;
  for (VoxelRun run = nextFree(beginning.bottom); !run.empty(); run = nextFree(run.top)) {
    if (run.bottom >= beginning.top) break;
    const VoxelRun cut = cutAt(within, run);
    if (cut.length() > longest.length()) longest = cut;
  }
  return longest;
}

int ColumnBits::freeIn(const VoxelRun& heights) const {
  int count = 0;
  for (const ColumnWord& word : words_) count += countOf(word.free & maskOf(word, heights));
  return count;
}

int ColumnBits::occupiedIn(const VoxelRun& heights) const {
  int count = 0;
  for (const ColumnWord& word : words_) count += countOf(word.occupied & maskOf(word, heights));
  return count;
}

}  // namespace occusg
