// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/frame_voxels.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "mapping/morton.hpp"

namespace occusg {
namespace {

constexpr std::uint64_t kNoAddress = std::numeric_limits<std::uint64_t>::max();
constexpr std::size_t kInitialSlots = 4096;

/// A number of the block that is cheaper to get than its Morton code.
std::uint64_t addressOf(const octomap::OcTreeKey& key) {
  return static_cast<std::uint64_t>(key[0] >> kBlockLevels) << 26 |
         static_cast<std::uint64_t>(key[1] >> kBlockLevels) << 13 |
         static_cast<std::uint64_t>(key[2] >> kBlockLevels);
}

std::uint64_t mortonCode(const octomap::OcTreeKey& key) {
  return occusg::mortonCode(key[0] >> kBlockLevels, key[1] >> kBlockLevels, key[2] >> kBlockLevels);
}

unsigned placeOf(const octomap::OcTreeKey& key) { return placeInBlock(key[0], key[1], key[2]); }

void mark(std::array<std::uint64_t, 8>& words, unsigned place) {
  words[place >> 6] |= std::uint64_t{1} << (place & 63U);
}

}  // namespace

FrameVoxels::FrameVoxels() : slots_(kInitialSlots, 0), last_address_(kNoAddress) {}

void FrameVoxels::clear() {
  blocks_.clear();
  std::fill(slots_.begin(), slots_.end(), 0U);
  last_address_ = kNoAddress;
}

void FrameVoxels::markFree(const octomap::OcTreeKey& key) { mark(blockOf(key).free, placeOf(key)); }

void FrameVoxels::markOccupied(const octomap::OcTreeKey& key) {
  mark(blockOf(key).occupied, placeOf(key));
}

const std::vector<VoxelBlock>& FrameVoxels::settled() {
  for (VoxelBlock& block : blocks_)
    for (std::size_t i = 0; i < block.free.size(); ++i) block.free[i] &= ~block.occupied[i];
  std::sort(blocks_.begin(), blocks_.end(),
            [](const VoxelBlock& a, const VoxelBlock& b) { return a.code < b.code; });
  return blocks_;
}

VoxelBlock& FrameVoxels::blockOf(const octomap::OcTreeKey& key) {
  const std::uint64_t address = addressOf(key);
  if (address == last_address_) return blocks_[last_block_];
  const std::uint64_t code = mortonCode(key);
  std::size_t slot = find(code);
  if (slots_[slot] == 0) {
    if (2 * (blocks_.size() + 1) > slots_.size()) {
      grow();
      slot = find(code);
    }
    blocks_.emplace_back();
    blocks_.back().code = code;
    slots_[slot] = static_cast<std::uint32_t>(blocks_.size());
  }
  last_address_ = address;
  last_block_ = slots_[slot] - 1;
  return blocks_[last_block_];
}

/// The slot that holds `code`, or the empty one where it belongs.
std::size_t FrameVoxels::find(std::uint64_t code) {
  const std::size_t mask = slots_.size() - 1;
  // Neighbouring blocks have neighbouring codes; Fibonacci hashing scatters them.
  std::size_t slot = static_cast<std::size_t>((code * 0x9E3779B97F4A7C15U) >> 32) & mask;
  while (slots_[slot] != 0 && blocks_[slots_[slot] - 1].code != code) slot = (slot + 1) & mask;
  return slot;
}

void FrameVoxels::grow() {
  slots_.assign(2 * slots_.size(), 0);
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    slots_[find(blocks_[i].code)] = static_cast<std::uint32_t>(i + 1);
}

}  // namespace occusg
