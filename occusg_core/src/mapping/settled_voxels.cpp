// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/settled_voxels.hpp"

#include <algorithm>
#include <cstddef>

namespace occusg {
namespace {

constexpr unsigned kLevelsAboveBlocks = 13;

/// @param voxels below the node: 64, 8 or 1.
std::uint64_t settledBelow(const octomap::OcTree& tree, const octomap::OcTreeNode* node,
                           unsigned voxels) {
  if (!tree.nodeHasChildren(node)) {
    if (node->getLogOdds() > tree.getClampingThresMinLog()) return 0;
    return voxels == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << voxels) - 1;
  }
  const unsigned part = voxels / 8;
  std::uint64_t settled = 0;
  for (unsigned i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(node, i))
      settled |= settledBelow(tree, tree.getNodeChild(node, i), part) << (i * part);
  }
  return settled;
}

SettledVoxels::Bits settledIn(const octomap::OcTree& tree, std::uint64_t code) {
  SettledVoxels::Bits settled{};
  const octomap::OcTreeNode* node = tree.getRoot();
  if (node == nullptr) return settled;
  for (unsigned depth = 0; depth < kLevelsAboveBlocks && tree.nodeHasChildren(node); ++depth) {
    const auto child = static_cast<unsigned>(code >> (3 * (kLevelsAboveBlocks - 1 - depth))) & 7U;
    if (!tree.nodeChildExists(node, child)) return settled;
    node = tree.getNodeChild(node, child);
  }
  if (!tree.nodeHasChildren(node)) {
    settled.fill(settledBelow(tree, node, 64));
    return settled;
  }
  for (unsigned i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(node, i))
      settled[i] = settledBelow(tree, tree.getNodeChild(node, i), 64);
  }
  return settled;
}

}  // namespace

SettledVoxels::Bits SettledVoxels::of(std::uint64_t code, const octomap::OcTree& tree) {
  const auto found = blocks_.find(code);
  if (found == blocks_.end()) return {};
  Block& block = found->second;
  if (block.updates >= block.patience) {
    const Bits settled = settledIn(tree, code);
    block.patience =
        settled == block.free ? std::min(2 * block.patience, kLongestPatience) : kFirstPatience;
    block.free = settled;
    block.updates = 0;
  }
  return block.free;
}

void SettledVoxels::update(const std::vector<VoxelBlock>& blocks) {
  for (const VoxelBlock& updated : blocks) {
    Block& block = blocks_[updated.code];
    ++block.updates;
    for (std::size_t i = 0; i < block.free.size(); ++i) block.free[i] &= ~updated.occupied[i];
  }
}

std::size_t SettledVoxels::memoryBytes() const {
  constexpr std::size_t kNode = sizeof(std::uint64_t) + sizeof(Block) + sizeof(void*);
  return blocks_.size() * kNode + blocks_.bucket_count() * sizeof(void*);
}

}  // namespace occusg
