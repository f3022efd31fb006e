// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/settled_free.hpp"

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
  for (unsigned i = 0; i < 8; ++i)
    if (tree.nodeChildExists(node, i))
      settled |= settledBelow(tree, tree.getNodeChild(node, i), part) << (i * part);
  return settled;
}

}  // namespace

std::array<std::uint64_t, 8> settledFree(const octomap::OcTree& tree, std::uint64_t code) {
  std::array<std::uint64_t, 8> settled{};
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
  for (unsigned i = 0; i < 8; ++i)
    if (tree.nodeChildExists(node, i))
      settled[i] = settledBelow(tree, tree.getNodeChild(node, i), 64);
  return settled;
}

}  // namespace occusg
