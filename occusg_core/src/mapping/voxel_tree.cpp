// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxel_tree.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <tuple>

namespace occusg {
namespace {

constexpr unsigned kTreeDepth = 16;
constexpr unsigned kBlockDepth = kTreeDepth - kBlockLevels;
constexpr int kBlockSide = 1 << kBlockLevels;

/// Every third bit of a Morton code from the lowest on, packed: one coordinate of the block.
int compact(std::uint64_t code) {
  int coordinate = 0;
  for (unsigned i = 0; i < kBlockDepth; ++i)
    coordinate |= static_cast<int>((code >> (3 * i)) & 1U) << i;
  return coordinate;
}

unsigned childIndex(std::uint64_t code, unsigned depth) {
  return static_cast<unsigned>(code >> (3 * (kBlockDepth - 1 - depth))) & 7U;
}

/// Asks for what is at an address, to have it in the cache when it is needed.
void prefetch(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

/// Bits of the first `voxels` voxels.
std::uint64_t lowest(unsigned voxels) {
  return voxels == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << voxels) - 1;
}

}  // namespace

std::vector<Cell> VoxelTree::integrate(const std::vector<VoxelBlock>& blocks) {
  changed_.clear();
  if (blocks.empty()) return {};
  Place top{root, Age::kOld};
  if (root == nullptr) {
    root = new Node();  // owned by the base class, which offers no other way to make a root
    ++tree_size;
    size_changed = true;
    top = {root, Age::kNew};
  }
  updateAbove(top, 0, blocks.begin(), blocks.end());
  return changedColumns();
}

void VoxelTree::updateAbove(const Place& place, unsigned depth, BlockIterator first,
                            BlockIterator last) {
  if (depth == kBlockDepth) {
    updateBlock(place, *first);
    return;
  }
  if (isLeaf(place) && ignores(place, allMarks(first, last))) return;
  while (first != last) {
    const unsigned index = childIndex(first->code, depth);
    const BlockIterator next = std::find_if(first, last, [&](const VoxelBlock& block) {
      return childIndex(block.code, depth) != index;
    });
    updateAbove(child(place, index), depth + 1, first, next);
    first = next;
  }
  finish(place.node);
}

void VoxelTree::updateBlock(const Place& place, const VoxelBlock& block) {
  fetch(place, block);
  BlockChange change;
  bool any = false;
  for (unsigned i = 0; i < block.free.size(); ++i) {
    const Marks marks{block.free[i], block.occupied[i]};
    if ((marks.free | marks.occupied) == 0 || ignores(place, marks)) continue;
    const Change below = updateBelow(child(place, i), 64, marks);
    change.changed[i] = below.free | below.occupied;
    change.occupied[i] = below.occupied;
    any = any || change.changed[i] != 0;
  }
  finish(place.node);
  if (any) note(block, change);
}

/// What any of the blocks asks for.
VoxelTree::Marks VoxelTree::allMarks(BlockIterator first, BlockIterator last) {
  Marks marks;
  for (; first != last; ++first) {
    for (unsigned i = 0; i < first->free.size(); ++i) {
      marks.free |= first->free[i];
      marks.occupied |= first->occupied[i];
    }
  }
  return marks;
}

/// Nodes are scattered over the heap, and one is known only from the one above: waiting for each in
/// turn would take most of an update. So those of a block are asked for level by level.
void VoxelTree::fetch(const Place& place, const VoxelBlock& block) const {
  if (place.age == Age::kNew || !nodeHasChildren(place.node)) return;
  for (unsigned i = 0; i < 8; ++i)
    if (nodeChildExists(place.node, i)) prefetch(getNodeChild(place.node, i));
  for (unsigned i = 0; i < 8; ++i) {
    const std::uint64_t marks = block.free[i] | block.occupied[i];
    if (marks != 0 && nodeChildExists(place.node, i))
      fetchVoxels(getNodeChild(place.node, i), marks);
  }
}

void VoxelTree::fetchVoxels(const Node* word, std::uint64_t marks) const {
  if (!nodeHasChildren(word)) return;
  for (unsigned i = 0; i < 8; ++i)
    if (nodeChildExists(word, i)) prefetch(getNodeChild(word, i));
  for (unsigned i = 0; i < 8; ++i) {
    if (((marks >> (8 * i)) & lowest(8)) == 0 || !nodeChildExists(word, i)) continue;
    const Node* family = getNodeChild(word, i);
    if (!nodeHasChildren(family)) continue;
    for (unsigned j = 0; j < 8; ++j)
      if (nodeChildExists(family, j)) prefetch(getNodeChild(family, j));
  }
}

/// @param voxels number of voxels below the node: 64 or 8.
/// @return the voxels that became free or occupied, in the bits of `marks`.
VoxelTree::Change VoxelTree::updateBelow(const Place& place, unsigned voxels, const Marks& marks) {
  if (ignores(place, marks)) return {};
  const std::uint64_t all = lowest(voxels);
  if (isLeaf(place) || place.age == Age::kNew) {
    if (marks.free == all) return updateLeaf(place, all, prob_miss_log);
    if (marks.occupied == all) return updateLeaf(place, all, prob_hit_log);
  }
  if (voxels == 8) return updateVoxels(place, marks);
  const unsigned part = voxels / 8;
  Change change;
  for (unsigned i = 0; i < 8; ++i) {
    const Marks below{(marks.free >> (i * part)) & lowest(part),
                      (marks.occupied >> (i * part)) & lowest(part)};
    if ((below.free | below.occupied) == 0) continue;
    const Change of_child = updateBelow(child(place, i), part, below);
    change.free |= of_child.free << (i * part);
    change.occupied |= of_child.occupied << (i * part);
  }
  finish(place.node);
  return change;
}

/// Of a node of eight voxels: what `updateLeaf` and `finish` do, in one pass over the children.
VoxelTree::Change VoxelTree::updateVoxels(const Place& place, const Marks& marks) {
  if (isLeaf(place)) expandNode(place.node);
  Change change;
  float lowest_log_odds = std::numeric_limits<float>::max();
  float highest_log_odds = std::numeric_limits<float>::lowest();
  unsigned known = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    if (((marks.free | marks.occupied) & bit) != 0) {
      const float update = (marks.free & bit) != 0 ? prob_miss_log : prob_hit_log;
      const Change of_voxel = updateLeaf(child(place, i), bit, update);
      change.free |= of_voxel.free;
      change.occupied |= of_voxel.occupied;
    } else if (!nodeChildExists(place.node, i)) {
      continue;
    }
    ++known;
    const float log_odds = getNodeChild(place.node, i)->getLogOdds();
    lowest_log_odds = std::min(lowest_log_odds, log_odds);
    highest_log_odds = std::max(highest_log_odds, log_odds);
  }
  place.node->setLogOdds(highest_log_odds);
  if (known == 8 && !(lowest_log_odds < highest_log_odds)) (void)pruneNode(place.node);
  return change;
}

VoxelTree::Change VoxelTree::updateLeaf(const Place& place, std::uint64_t all, float log_odds) {
  const bool was_occupied = isNodeOccupied(place.node);
  updateNodeLogOdds(place.node, log_odds);
  const bool is_occupied = isNodeOccupied(place.node);
  if (place.age == Age::kOld && is_occupied == was_occupied) return {};
  return is_occupied ? Change{0, all} : Change{all, 0};
}

VoxelTree::Place VoxelTree::child(const Place& parent, unsigned index) {
  if (isLeaf(parent)) expandNode(parent.node);
  if (nodeChildExists(parent.node, index)) return {getNodeChild(parent.node, index), Age::kOld};
  return {createNodeChild(parent.node, index), Age::kNew};
}

/// A node that stands for all voxels below it; a node this frame made stands for none yet.
bool VoxelTree::isLeaf(const Place& place) const {
  return place.age == Age::kOld && !nodeHasChildren(place.node);
}

/// True when the marks leave the voxels of a leaf as they are: clamped values do not move further.
bool VoxelTree::ignores(const Place& place, const Marks& marks) const {
  if (!isLeaf(place)) return false;
  const float log_odds = place.node->getLogOdds();
  return (marks.occupied == 0 && log_odds <= clamping_thres_min) ||
         (marks.free == 0 && log_odds >= clamping_thres_max);
}

void VoxelTree::finish(Node* node) {
  if (!nodeHasChildren(node)) return;
  if (!pruneNode(node)) node->updateOccupancyChildren();
}

void VoxelTree::note(const VoxelBlock& block, const BlockChange& change) {
  constexpr int kZeroBlock = kZeroKey / kBlockSide;
  const Cell tile{compact(block.code) - kZeroBlock, compact(block.code >> 1) - kZeroBlock};
  const std::uint64_t columns = columns_.apply(tile, compact(block.code >> 2) - kZeroBlock, change);
  changed_.push_back({tile.x, tile.y, columns});
}

void VoxelTree::clear() {
  octomap::OcTree::clear();
  columns_.clear();
}

void VoxelTree::rebuildColumns() { columns_ = VoxelColumns::of(*this); }

std::vector<Cell> VoxelTree::changedColumns() {
  std::sort(changed_.begin(), changed_.end(), [](const BlockColumns& a, const BlockColumns& b) {
    return std::tie(a.y, a.x) < std::tie(b.y, b.x);
  });
  // Blocks above each other share their columns.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    const bool same =
        kept > 0 && changed_[kept - 1].x == changed_[i].x && changed_[kept - 1].y == changed_[i].y;
    if (same) {
      changed_[kept - 1].columns |= changed_[i].columns;
    } else {
      changed_[kept++] = changed_[i];
    }
  }
  changed_.resize(kept);

  std::vector<Cell> columns;
  for (auto row = changed_.begin(); row != changed_.end();) {
    const auto end = std::find_if(row, changed_.end(),
                                  [&](const BlockColumns& block) { return block.y != row->y; });
    for (int y = 0; y < kBlockSide; ++y) {
      for (auto block = row; block != end; ++block) {
        for (int x = 0; x < kBlockSide; ++x) {
          if ((block->columns >> (kBlockSide * y + x)) & 1U)
            columns.push_back({block->x * kBlockSide + x, block->y * kBlockSide + y});
        }
      }
    }
    row = end;
  }
  return columns;
}

}  // namespace occusg
